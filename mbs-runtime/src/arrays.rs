//! Steps of mechanisms with long vectors. Named components are a detour where loops
//! compute: the stages of these mechanisms are given arrays and return arrays, and a
//! step converts its state once.

use mbs_interface::Stabilization;

use crate::explicit::{self, Slopes, Span, correct, project};
use crate::{Accelerations, Components, Gains, Mechanism, Method, Real, Scheme, Stabilized, State};

/// The coordinates of a mechanism as an array.
pub type Coordinates<M> = <<M as Mechanism>::Coordinates as Components>::Array;
/// The coordinates that are integrated as an array.
pub type States<M> = <<M as Mechanism>::States as Components>::Array;
/// One number per constraint as an array.
pub type Constraints<M> = <<M as Mechanism>::Constraints as Components>::Array;

/// Room for a step on arrays.
pub struct Room<M: OnArrays> {
    /// One vector of states.
    pub states: States<M>,
    /// One number per constraint.
    pub constraints: Constraints<M>,
    /// Results that loops hand to each other.
    pub slots: M::Slots,
}

/// The stages of a mechanism whose programs became loops.
pub trait OnArrays: Mechanism {
    /// An array for what loops hand to each other.
    type Slots;

    /// Room that is filled with zeros.
    fn room() -> Room<Self>;

    /// [`stabilized`](Mechanism::stabilized): q̈, the feedback, and as its value the growth.
    ///
    /// `feedback` is given as zeros, or as this function left it: where it always is 0, as of rows
    /// that give a coordinate, nothing is written.
    #[allow(clippy::too_many_arguments, reason = "the arrays of one stage")]
    fn stabilized_on_arrays(
        &self,
        t: Self::Real,
        q: &States<Self>,
        v: &States<Self>,
        inputs: &Self::Inputs,
        gains: &Gains<Self::Real>,
        acceleration: &mut States<Self>,
        feedback: &mut Constraints<Self>,
        slots: &mut Self::Slots,
    ) -> Self::Real;

    /// [`constrained`](Mechanism::constrained): q̈, and as its value the growth.
    #[allow(clippy::too_many_arguments, reason = "the arrays of one stage")]
    fn constrained_on_arrays(
        &self,
        t: Self::Real,
        q: &States<Self>,
        v: &States<Self>,
        inputs: &Self::Inputs,
        feedback: &Constraints<Self>,
        acceleration: &mut States<Self>,
        slots: &mut Self::Slots,
    ) -> Self::Real;
}

/// [`Mechanism::stabilized`] of such a mechanism.
pub fn stabilized<M: OnArrays>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
) -> Stabilized<M::States, M::Constraints> {
    let Room { states: mut a, constraints: mut feedback, mut slots } = M::room();
    let (q, v) = (at.q.into_array(), at.v.into_array());
    let growth =
        mechanism.stabilized_on_arrays(at.t, &q, &v, inputs, gains, &mut a, &mut feedback, &mut slots);
    let (acceleration, feedback) = (Components::from_array(a), Components::from_array(feedback));
    Stabilized { acceleration, feedback, growth }
}

/// [`Mechanism::constrained`] of such a mechanism.
pub fn constrained<M: OnArrays>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    feedback: &M::Constraints,
) -> Accelerations<M::States> {
    let Room { states: mut a, mut slots, .. } = M::room();
    let (q, v, feedback) = (at.q.into_array(), at.v.into_array(), feedback.into_array());
    let growth = mechanism.constrained_on_arrays(at.t, &q, &v, inputs, &feedback, &mut a, &mut slots);
    Accelerations { acceleration: Components::from_array(a), growth }
}

/// A step in place, in the operations of the stages one by one, and the growths of all
/// stages, added. If that is over the alarm, or something not finite, the state is left as it
/// was.
#[inline(never)]
pub fn step<M: OnArrays, X: Method>(
    mechanism: &M,
    state: &mut State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    h: M::Real,
    t_next: M::Real,
    alarm: M::Real,
) -> Option<M::Real> {
    let Room { states: zeros, constraints: mut feedback, mut slots } = M::room();
    let (mut q, mut there) = (zeros, zeros);
    let (mut velocities, mut accelerations) = (X::Scheme::stages(zeros), X::Scheme::stages(zeros));
    state.q.copy_to(&mut q);
    state.v.copy_to(velocities.as_mut().first_mut()?);
    let span = Span { t: state.t, h, t_next };
    let slopes = Slopes { velocities: velocities.as_mut(), accelerations: accelerations.as_mut() };
    let mut growth =
        explicit::step(X::Scheme::TABLEAU, &span, &mut q, slopes, &mut there, |stage, t, q, v, a| {
            match X::EXPLICIT.stabilization {
                Stabilization::Held if stage == 0 => {
                    mechanism.stabilized_on_arrays(t, q, v, inputs, gains, a, &mut feedback, &mut slots)
                }
                Stabilization::PerStage => {
                    mechanism.stabilized_on_arrays(t, q, v, inputs, gains, a, &mut feedback, &mut slots)
                }
                Stabilization::Held | Stabilization::Projection => {
                    mechanism.constrained_on_arrays(t, q, v, inputs, &feedback, a, &mut slots)
                }
            }
        });
    let v = velocities.as_mut().first_mut()?;
    if X::EXPLICIT.is_projected() {
        let projected = project(&mut q, v, &mut there, |at, delta| correct(mechanism, t_next, &at, delta));
        growth = growth + projected;
    }
    let is_finite = |array: &[M::Real]| array.iter().fold(true, |finite, x| finite & x.is_finite());
    // written so that a NaN fails the test
    let is_good = growth <= alarm && is_finite(q.as_ref()) & is_finite(v.as_ref());
    is_good.then(|| {
        state.t = t_next;
        state.q.copy_from(&q);
        state.v.copy_from(v);
        growth
    })
}
