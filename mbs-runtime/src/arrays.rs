//! Steps of mechanisms with long vectors. Named components are a detour where loops
//! compute: the stages of these mechanisms are given arrays and return arrays, and a
//! step converts its state once.

use mbs_interface::Stabilization;

use crate::explicit::{self, Slopes, Span, correct, project};
use crate::{Accelerations, Components, Mechanism, Method, Real, Scheme, Stabilized, State};

/// The coordinates of a mechanism as an array.
pub type Coordinates<M> = <<M as Mechanism>::Coordinates as Components>::Array;
/// The coordinates that are integrated as an array.
pub type States<M> = <<M as Mechanism>::States as Components>::Array;
/// One number per constraint as an array.
pub type Constraints<M> = <<M as Mechanism>::Constraints as Components>::Array;

/// Room for a step on arrays, filled with zeros. `L` is an array for results that loops hand to each other.
pub struct Room<M: Mechanism, L> {
    /// One vector of states.
    pub states: States<M>,
    /// One number per constraint.
    pub constraints: Constraints<M>,
    /// Results that loops hand to each other.
    pub slots: L,
}

/// The place of a stage: t, q and v of the states.
pub type Place<'a, M> = (<M as Mechanism>::Real, &'a States<M>, &'a States<M>);

/// [`Mechanism::stabilized`] by a stage on arrays, which writes q̈ and the feedback, and returns the growth.
///
/// The stage is given the feedback as zeros, or as it left it: where it always is 0, as of rows that give a
/// coordinate, nothing is written. Room is made here, since large arrays would be copied to it.
pub fn stabilized<M: Mechanism, L>(
    at: &State<M::States>,
    room: impl FnOnce() -> Room<M, L>,
    stage: impl FnOnce(Place<'_, M>, &mut States<M>, &mut Constraints<M>, &mut L) -> M::Real,
) -> Stabilized<M::States, M::Constraints> {
    let Room { states: mut a, constraints: mut feedback, mut slots } = room();
    let (q, v) = (at.q.into_array(), at.v.into_array());
    let growth = stage((at.t, &q, &v), &mut a, &mut feedback, &mut slots);
    let (acceleration, feedback) = (Components::from_array(a), Components::from_array(feedback));
    Stabilized { acceleration, feedback, growth }
}

/// [`Mechanism::constrained`] by a stage on arrays, which writes q̈ with some feedback, and returns the growth.
pub fn constrained<M: Mechanism, L>(
    at: &State<M::States>,
    feedback: &M::Constraints,
    room: impl FnOnce() -> Room<M, L>,
    stage: impl FnOnce(Place<'_, M>, &Constraints<M>, &mut States<M>, &mut L) -> M::Real,
) -> Accelerations<M::States> {
    let Room { states: mut a, mut slots, .. } = room();
    let (q, v, feedback) = (at.q.into_array(), at.v.into_array(), feedback.into_array());
    let growth = stage((at.t, &q, &v), &feedback, &mut a, &mut slots);
    Accelerations { acceleration: Components::from_array(a), growth }
}

/// A step in place, in the operations of the stages one by one, and the growths of all
/// stages, added. If that is over the alarm, or something not finite, the state is left as it
/// was.
#[inline(never)]
pub fn step<M: Mechanism, X: Method, L>(
    mechanism: &M,
    state: &mut State<M::States>,
    [h, t_next, alarm]: [M::Real; 3],
    room: impl FnOnce() -> Room<M, L>,
    mut stabilized: impl FnMut(Place<'_, M>, &mut States<M>, &mut Constraints<M>, &mut L) -> M::Real,
    mut constrained: impl FnMut(Place<'_, M>, &Constraints<M>, &mut States<M>, &mut L) -> M::Real,
) -> Option<M::Real> {
    let Room { states: zeros, constraints: mut feedback, mut slots } = room();
    let (mut q, mut there) = (zeros, zeros);
    let (mut velocities, mut accelerations) = (X::Scheme::stages(zeros), X::Scheme::stages(zeros));
    state.q.copy_to(&mut q);
    state.v.copy_to(velocities.as_mut().first_mut()?);
    let span = Span { t: state.t, h, t_next };
    let slopes = Slopes { velocities: velocities.as_mut(), accelerations: accelerations.as_mut() };
    let mut growth =
        explicit::step(X::Scheme::TABLEAU, &span, &mut q, slopes, &mut there, |stage, t, q, v, a| {
            match X::EXPLICIT.stabilization {
                Stabilization::Held if stage == 0 => stabilized((t, q, v), a, &mut feedback, &mut slots),
                Stabilization::PerStage => stabilized((t, q, v), a, &mut feedback, &mut slots),
                Stabilization::Held | Stabilization::Projection => {
                    constrained((t, q, v), &feedback, a, &mut slots)
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
