//! Why there is no step.
//!
//! A step of a run fails or is too inaccurate, but does not say why. So steps on slices are taken from the
//! last good state, from a very short one on. The first that fails names the error.

use mbs_interface::Explicit;

use super::dense::Moment;
use crate::run::Run;
use crate::watch::Watch;
use crate::{Dynamics, Error, Gains, Real, Scheme};

/// From steps below so many seconds Newton's method finds the constraints again if they can be met.
const NEARBY: f64 = 1e-3;

/// The error of the shortest step from `now` that has one, of steps up to `longest` seconds with
/// projection; nothing where all of them can be taken. `next` is room for their ends.
pub fn cause<D: Dynamics, S: Scheme>(
    dynamics: &D,
    inputs: &mut D::Inputs,
    now: &Moment<D::Real, D::States>,
    next: &mut Moment<D::Real, D::States>,
    mut watch: Watch<D::Real>,
    longest: f64,
) -> Option<Error> {
    let (t, nothing) = (now.t.to_f64(), D::Real::default());
    let found = dynamics.with_inputs(inputs, |inputs| {
        dynamics.with_room::<S>(|room| {
            let mut h = 16.0 * D::Real::EPSILON.to_f64() * (1.0 + t.abs());
            while h < longest {
                let step = D::Real::from_f64(h);
                let run = Run {
                    equations: dynamics.equations(),
                    at: now.at(),
                    inputs,
                    gains: Gains { minus_two_alpha: nothing, minus_beta_squared: nothing },
                    step,
                    method: Explicit::projected(S::TABLEAU),
                    keeps_constraints: true,
                };
                run.step(now.t + step, [next.q.as_mut(), next.v.as_mut()], &mut watch, room)?;
                if h < NEARBY {
                    run.reaches(now.t + step, room)?;
                }
                h *= 4.0;
            }
            Ok(())
        })
    });
    found.err()
}
