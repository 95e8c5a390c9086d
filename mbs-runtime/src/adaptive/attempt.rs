//! One step of some length, with an estimate of its error.

use mbs_interface::Estimate;

use super::dense::Moment;
use super::{AdaptiveScheme, Dynamics, Tolerances};
use crate::explicit::{Beside, Slopes, factor, subtract, sums};
use crate::mechanism::growth_limit;
use crate::{Real, vectors};

/// A correction of positions is repeated this often at most.
const CORRECTIONS: usize = 4;

/// The vectors of a step.
#[derive(Clone)]
pub struct Attempt<V, Stages> {
    /// v and q̈ of every stage,
    pub velocities: Stages,
    pub accelerations: Stages,
    /// and the position of one, or a correction.
    pub there: V,
    /// The absolute error that each component may have.
    pub atol: V,
}

impl<V: Clone, Stages: AsRef<[V]> + AsMut<[V]>> Attempt<V, Stages> {
    /// A step from `from` to `t_next` in stages, projected onto the constraints; `to` becomes its
    /// end. The growths of all that was solved, added; nothing if its end does not lead to the
    /// constraints.
    ///
    /// Positions are corrected by Newton's method until a correction is below √ε, so that what is
    /// left after it is a rounding; velocities once, in the position that was found. The slope at
    /// the end belongs to the estimate and is the first one of the next step.
    // one copy for all callers: the compiler inlines the stages into it
    #[inline(never)]
    pub fn step<D: Dynamics<States = V>, S: AdaptiveScheme>(
        &mut self,
        of: (&D, &D::Inputs),
        from: &Moment<D::Real, V>,
        t_next: D::Real,
        to: &mut Moment<D::Real, V>,
    ) -> Option<D::Real>
    where
        V: AsRef<[D::Real]> + AsMut<[D::Real]>,
    {
        let Self { velocities, accelerations, there, .. } = self;
        let (dynamics, accelerations) = (of.0, accelerations.as_mut());
        to.t = t_next;
        let slopes = Slopes { velocities: velocities.as_mut(), accelerations: &mut *accelerations };
        let mut growth = S::advance(of, from, slopes, there, to)?;
        let small = D::Real::EPSILON.sqrt();
        for correction in 1.. {
            growth = growth + dynamics.correction(t_next, &Beside { q: &to.q, v: None }, there);
            subtract(&mut to.q, there);
            let positions = dynamics.info().of_bodies(to.q.as_ref());
            let (size, of_positions) = (vectors::largest(there.as_ref()).1, vectors::largest(positions).1);
            if size <= small * (D::Real::from_f64(1.0) + of_positions) {
                break;
            }
            if correction == CORRECTIONS {
                return None;
            }
        }
        converge_partials(dynamics, t_next, &mut to.q, there);
        growth = growth + dynamics.correction(t_next, &Beside { q: &to.q, v: Some(&to.v) }, there);
        subtract(&mut to.v, there);
        Some(growth + S::finish(of, t_next - from.t, accelerations, there, to)?)
    }

    /// The estimated error of a step that was taken, over the allowed one.
    ///
    /// It is the root mean square over all components of q and v. With two differences e and ē
    /// it is ‖e‖²/√(‖e‖² + 0.01‖ē‖²) (Hairer, Nørsett, Wanner, II.10).
    #[inline(never)]
    pub fn error<T: Real>(
        &self,
        estimate: &Estimate,
        tolerances: &Tolerances,
        from: &Moment<T, V>,
        to: &Moment<T, V>,
    ) -> f64
    where
        V: AsRef<[T]> + AsMut<[T]>,
    {
        let (rtol, atol) = (T::from_f64(tolerances.rtol), self.atol.as_ref());
        let h = to.t - from.t;
        let pairs = [
            (self.velocities.as_ref(), &to.v, &from.q, &to.q),
            (self.accelerations.as_ref(), &to.a, &from.v, &to.v),
        ];
        let mut squares = [0.0; 2];
        for (row, square) in estimate.differences.iter().zip(&mut squares) {
            let factor = factor(row, h);
            let mut total = T::default();
            for (slopes, last, before, after) in pairs {
                let (last, before, after) = (last.as_ref(), before.as_ref(), after.as_ref());
                let of_last = T::from_f64(row.weights.get(slopes.len()).copied().unwrap_or(0.0));
                sums(row, slopes, after.len(), |at, sum| {
                    let (Some(before), Some(after), Some(last), Some(atol)) =
                        (before.get(at), after.get(at), last.get(at), atol.get(at))
                    else {
                        return;
                    };
                    let allowed = *atol + rtol * before.abs().max(after.abs());
                    let error = factor * (sum + of_last * *last) / allowed;
                    total = total + error * error;
                });
            }
            *square = total.to_f64();
        }
        let count = 2.0 * to.q.as_ref().len() as f64;
        let ratio = match (squares, estimate.differences.len()) {
            // nothing moves
            ([0.0, _], _) => 0.0,
            ([square, other], 2) => square / Real::sqrt((square + 0.01 * other) * count),
            ([square, _], _) => Real::sqrt(square / count),
        };
        if ratio.is_finite() { ratio } else { f64::NAN }
    }
}

/// Positions whose value has converged get the derivatives of the point on the constraints, an
/// order with each correction; nothing is done for scalars without derivatives.
#[inline(always)]
pub fn converge_partials<D: Dynamics>(dynamics: &D, t: D::Real, q: &mut D::States, delta: &mut D::States) {
    for _ in 0..D::Real::ORDER {
        dynamics.correction(t, &Beside { q, v: None }, delta);
        vectors::zip_map(q.as_mut(), delta.as_ref(), |q, delta| q.with_partials_of(q - delta));
    }
}

/// True if a step with this growth and end is one.
#[inline(always)]
pub fn is_healthy<T: Real, V: AsRef<[T]>>(growth: T, to: &Moment<T, V>) -> bool {
    let is_finite = |vector: &V| vectors::is_finite(vector.as_ref());
    growth < growth_limit() && is_finite(&to.q) & is_finite(&to.v) & is_finite(&to.a)
}
