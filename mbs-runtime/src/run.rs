//! A run on slices: a step stage by stage, and what is done where a step or a result is not
//! healthy, finding out whether anything went wrong, and what.

use mbs_interface::{Explicit, Stabilization};

use crate::diagnosis::{Solution, check_defined, check_inputs, check_solution, singular, stage_error};
use crate::equations::{At, Equations};
use crate::explicit::{self, Beside, Slopes, Span};
use crate::mechanism::growth_limit;
use crate::reach::reach;
use crate::room::Room;
use crate::start::consistency::{check, check_feedback};
use crate::watch::Watch;
use crate::{Error, Gains, Info, Real, spare, vectors};

/// A run in its last good state.
#[derive(Clone, Copy)]
pub struct Run<'a, T> {
    /// The mechanism.
    pub equations: &'a dyn Equations<T>,
    /// The last good state: the coordinates that are integrated.
    pub at: At<'a, T>,
    /// The inputs, held over the step.
    pub inputs: &'a [T],
    /// The gains of the feedback.
    pub gains: Gains<T>,
    /// The step in s.
    pub step: T,
    /// The scheme, and what keeps the constraints.
    pub method: Explicit,
    /// True if violations of the constraints are meant to decay.
    pub keeps_constraints: bool,
}

impl<T: Real> Run<'_, T> {
    /// A step to `t_next`, stage by stage, of which the watch is told. With Heun's method
    /// (Jiang 2025, Eq. 9):
    ///
    /// ```text
    /// predict   q* = q + h v,            v* = v + h q̈(t, q, v)
    /// correct   q⁺ = q + h/2 (v + v*),   v⁺ = v + h/2 (q̈(t, q, v) + q̈(t + h, q*, v*))
    /// ```
    ///
    /// (q⁺, v⁺) is written to `next`; after an error, what stands there means nothing.
    /// Time is passed in so that it is k·h and not a sum of k roundings. The value is the growths of all
    /// stages, added.
    ///
    /// # Errors
    /// [`Error::OutOfReach`] if the constraints cannot be met any more at its end,
    /// [`Error::Singular`], [`Error::NonFinite`], or [`Error::Input`] if that is where they
    /// come from.
    pub fn step(
        &self,
        t_next: T,
        next: [&mut [T]; 2],
        watch: &mut Watch<T>,
        room: &mut Room<'_, T>,
    ) -> Result<T, Error> {
        let [q_next, v_next] = next;
        let growth = self
            .explicit(t_next, [&mut *q_next, &mut *v_next], room)
            .map_err(|error| self.cause(error, t_next, room))?;
        let next = At { t: t_next, q: q_next, v: v_next };
        if self.is_calm(next, growth, watch, room) {
            watch.note(growth);
        } else {
            let mut examine =
                |ends: [At<'_, T>; 2], room: &mut Room<'_, T>| self.examine_step(ends, growth, watch, room);
            completed(self.equations, [self.at, next], room, &mut examine)?;
            watch.note_examined(growth);
        }
        Ok(growth)
    }

    /// True if a step to `next` needs no examination: its growth has not risen, and
    /// redundant constraints, of which a step knows nothing, are met all the same. Whether
    /// the state is finite is another question.
    pub fn is_calm(&self, next: At<'_, T>, growth: T, watch: &Watch<T>, room: &mut Room<'_, T>) -> bool {
        if self.equations.info().redundant.is_empty() {
            return growth <= watch.alarm;
        }
        let ([phi, ..], [q, v, ..]) = (&mut room.constraints, &mut room.completed);
        self.equations.complete(next, q, v);
        let margin = spare::margin_on(self.equations, next.t, q, watch.length, phi);
        growth <= watch.alarm && margin >= T::default()
    }

    /// The step without examination, and the growths of its stages, added.
    fn explicit(&self, t_next: T, next: [&mut [T]; 2], room: &mut Room<'_, T>) -> Result<T, Error> {
        let [q_next, v_next] = next;
        let growth = self.stages(t_next, [&mut *q_next, &mut *v_next], room, |_, _, _| {});
        // One test per step; written so that a NaN fails it.
        if growth < growth_limit() && vectors::is_finite(q_next) && vectors::is_finite(v_next) {
            return Ok(growth);
        }
        // If only the sum of the growths is over the limit, the largest is over its share.
        let share = T::from_f64(1.0 / self.method.tableau.stage_count() as f64);
        let (mut error, mut t_last) = (None, self.at.t);
        let mut all = core::mem::take(&mut room.completed);
        self.stages(t_next, [q_next, v_next], room, |at, acceleration, growth| {
            t_last = at.t;
            if error.is_none() {
                let [q, v, ..] = all.each_mut().map(|vector| &mut **vector);
                let limit = share * growth_limit();
                error = stage_error(self.equations, at, acceleration, growth, limit, [q, v]);
            }
        });
        room.completed = all;
        // Where all stages are healthy, the sum that leaves them is not.
        Err(error.unwrap_or(Error::NonFinite { t: t_last.to_f64(), coordinate: "" }))
    }

    /// The stages of a step, one after the other; `look` sees each with its q̈ and growth.
    fn stages(
        &self,
        t_next: T,
        next: [&mut [T]; 2],
        room: &mut Room<'_, T>,
        mut look: impl FnMut(At<'_, T>, &[T], T),
    ) -> T {
        let Self { equations, at, inputs, gains, step: h, method, .. } = self;
        let [mut q_next, v_next] = next;
        vectors::copy(q_next, at.q);
        let [feedback, unread, ..] = &mut room.constraints;
        let mut there = &mut *room.there;
        let [velocities, accelerations] = room.slopes.each_mut();
        let [mut velocities, mut accelerations] =
            [velocities, accelerations].map(|stages| stages.each_mut().map(|vector| &mut **vector));
        let [v_first, ..] = &mut velocities;
        vectors::copy(v_first, at.v);
        let span = Span { t: at.t, h: *h, t_next };
        let slopes = Slopes { velocities: &mut velocities, accelerations: &mut accelerations };
        vectors::fill(feedback, T::default());
        let growth =
            explicit::step(method.tableau, &span, &mut q_next, slopes, &mut there, |stage, t, q, v, a| {
                let at = At { t, q, v };
                let growth = match (stage, method.stabilization) {
                    (0, Stabilization::Held) => equations.stabilized(at, inputs, gains, a, feedback),
                    (_, Stabilization::PerStage) => equations.stabilized(at, inputs, gains, a, unread),
                    (_, Stabilization::Held | Stabilization::Projection) => {
                        equations.constrained(at, inputs, feedback, a)
                    }
                };
                look(at, a, growth);
                growth
            });
        let [v_last, ..] = &velocities;
        vectors::copy(v_next, v_last);
        if !method.is_projected() {
            return growth;
        }
        let mut v_next = v_next;
        let ([q_all, v_all, ..], [all, ..]) = (&mut room.completed, &mut room.coordinates);
        let projected = explicit::project(&mut q_next, &mut v_next, &mut there, |Beside { q, v }, delta| {
            let room = Correction { all: [q_all, v_all, all], violation: feedback };
            correction(*equations, t_next, q, v.map(|v| &**v), room, delta)
        });
        growth + projected
    }

    /// Examines a step from `from` to `next`, with all coordinates of both, after which the growth has risen: whether its constraints
    /// can still be met, whether it has kept its digits, and which pivot it is, which the
    /// watch remembers.
    ///
    /// # Errors
    /// [`Error::OutOfReach`], [`Error::Singular`].
    fn examine_step(
        &self,
        [from, next]: [At<'_, T>; 2],
        growth: T,
        watch: &mut Watch<T>,
        room: &mut Room<'_, T>,
    ) -> Result<(), Error> {
        let Self { equations, inputs, step, .. } = *self;
        if self.keeps_constraints {
            reach(equations, next.t, next.q, inputs, step, room)?;
        }
        let [phi, ..] = &mut room.constraints;
        spare::check(equations, next.t, next.q, watch.length, phi)?;
        self.keeps_digits([from, next], growth, room)?;
        remember(equations, from, growth, watch);
        Ok(())
    }

    /// Refuses a step from which rounding has taken half of its digits, growth > 1/√ε, and
    /// that has left many times the violation of before, whose feedback would change the
    /// motion as a whole: within some steps it would leave every scale.
    fn keeps_digits(
        &self,
        [at, next]: [At<'_, T>; 2],
        growth: T,
        room: &mut Room<'_, T>,
    ) -> Result<(), Error> {
        let Self { equations, step, .. } = *self;
        let has_lost_half = T::EPSILON * growth * growth > T::from_f64(1.0);
        if !has_lost_half || !self.keeps_constraints || check(equations, at, step, room).is_err() {
            return Ok(());
        }
        let [before, after] = [at, next].map(|at| violations(equations, at, room));
        if before.iter().zip(after).all(|(&before, after)| after <= T::from_f64(32.0) * before) {
            return Ok(());
        }
        let [here, there] = [at, next].map(|at| equations.worst_pivot(at.t, at.q));
        let after = there.map_or(T::from_f64(1.0), |(_, growth)| growth);
        if check_feedback(equations, next, after, step, room).is_ok() {
            return Ok(());
        }
        let worst = match [here, there] {
            [Some(here), Some(there)] if there.1 > here.1 => Some(there),
            [here, there] => here.or(there),
        };
        let info = equations.info();
        Err(singular(info, at.t, worst.and_then(|(at, _)| info.pivots.get(at)), growth))
    }

    /// Why a step to `t_next` failed: an input, or a position that cannot be reached from
    /// one that was good, or what the step says.
    fn cause(&self, error: Error, t_next: T, room: &mut Room<'_, T>) -> Error {
        let Self { equations, at, inputs, step, .. } = *self;
        if let Err(input) = check_inputs(equations.info(), inputs) {
            return input;
        }
        if !self.keeps_constraints {
            return error;
        }
        let mut blocked = None;
        let mut look = |[from, _]: [At<'_, T>; 2], room: &mut Room<'_, T>| {
            if self.is_good(from, t_next, room)
                && reach(equations, from.t, from.q, inputs, step, room).is_ok()
            {
                blocked = reach(equations, t_next, from.q, inputs, step, room).err();
            }
            Ok(())
        };
        let looked = completed(equations, [at, at], room, &mut look);
        looked.err().or(blocked).unwrap_or(error)
    }

    /// Checks that the constraints can be met at `t_next`, from the positions before the step. A step beyond a dead end may
    /// end far away, where nothing tells that it left them.
    ///
    /// # Errors
    /// [`Error::OutOfReach`].
    pub fn reaches(&self, t_next: T, room: &mut Room<'_, T>) -> Result<(), Error> {
        let Self { equations, at, inputs, step, .. } = *self;
        let mut look = |[from, _]: [At<'_, T>; 2], room: &mut Room<'_, T>| {
            reach(equations, t_next, from.q, inputs, step, room)
        };
        completed(equations, [at, at], room, &mut look)
    }

    /// True if a state has accelerations, and its positions constraints at `t_next`.
    fn is_good(&self, from: At<'_, T>, t_next: T, room: &mut Room<'_, T>) -> bool {
        let Self { equations, inputs, .. } = self;
        let [acceleration, ..] = &mut room.coordinates;
        let [feedback, phi, ..] = &mut room.constraints;
        vectors::fill(feedback, T::default());
        let growth = equations.accelerations(from, inputs, feedback, acceleration);
        equations.phi(t_next, from.q, phi);
        growth < growth_limit() && vectors::is_finite(phi)
    }

    /// Examines q̈ and λ of a state with these positions.
    ///
    /// # Errors
    /// [`Error::Input`], [`Error::Singular`], [`Error::NonFinite`] of an acceleration,
    /// [`Error::Undefined`] of a multiplier.
    pub fn examine(&self, q: &[T], acceleration: &[T], multipliers: &[T], growth: T) -> Result<(), Error> {
        let Self { equations, at: At { t, .. }, inputs, .. } = *self;
        let info = equations.info();
        let solution = Solution { t, q, value: acceleration, growth, info, pivots: info.pivots };
        let name = |row| info.constraint_name(row);
        check_solution(&solution, || equations.worst_pivot(t, q))
            .and_then(|()| check_defined(t, "the multiplier of constraint", multipliers, name))
            // an input that is not finite is the cause of whatever failed after it
            .map_err(|error| check_inputs(info, inputs).err().unwrap_or(error))
    }
}

/// Room for [`correction`].
#[derive(Debug)]
pub struct Correction<'a, T> {
    /// All coordinates, velocities and corrections.
    pub all: [&'a mut [T]; 3],
    /// One number per constraint.
    pub violation: &'a mut [T],
}

/// Writes the correction Δ of the positions that are integrated, or of the velocities there, which
/// leads to the constraints; the growth of its solution. See [`explicit::project`].
pub fn correction<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &[T],
    v: Option<&[T]>,
    room: Correction<'_, T>,
    delta: &mut [T],
) -> T {
    let Correction { all: [q_all, v_all, all], violation } = room;
    // positions do not depend on velocities
    equations.complete(At { t, q, v: v.unwrap_or(q) }, q_all, v_all);
    match v {
        None => equations.phi(t, q_all, violation),
        Some(_) => equations.phi_dot(At { t, q: q_all, v: v_all }, violation),
    }
    let growth = equations.projection(t, q_all, violation, all);
    equations.states(all, delta);
    growth
}

/// A function of two states of which all coordinates are known.
type Look<'a, T> = dyn FnMut([At<'_, T>; 2], &mut Room<'_, T>) -> Result<(), Error> + 'a;

/// Does something with all coordinates of two states of a step.
///
/// # Errors
/// Those of what is done.
fn completed<T: Real>(
    equations: &dyn Equations<T>,
    [first, second]: [At<'_, T>; 2],
    room: &mut Room<'_, T>,
    look: &mut Look<'_, T>,
) -> Result<(), Error> {
    let mut all = core::mem::take(&mut room.completed);
    let [q, v, q_second, v_second] = all.each_mut().map(|vector| &mut **vector);
    equations.complete(first, q, v);
    equations.complete(second, q_second, v_second);
    let second = At { t: second.t, q: q_second, v: v_second };
    let result = look([At { t: first.t, q, v }, second], room);
    room.completed = all;
    result
}

/// Tells the watch of a growth, and of its pivot if it is worth a name.
fn remember<T: Real>(equations: &dyn Equations<T>, at: At<'_, T>, growth: T, watch: &mut Watch<T>) {
    if watch.is_new(growth) {
        let share = T::from_f64(0.125) * growth;
        let worst = equations.worst_pivot(at.t, at.q).filter(|(_, growth)| *growth > share);
        watch.remember(growth, at.t, worst.map(|(at, _)| at));
    }
}

/// Tells the watch of a step that was not calm, or of a mechanism whose redundant constraints
/// have to be looked at.
///
/// # Errors
/// [`Error::OutOfReach`] of a redundant constraint.
pub(crate) fn note_risen<T: Real>(
    equations: &dyn Equations<T>,
    [from, to]: [At<'_, T>; 2],
    growth: T,
    watch: &mut Watch<T>,
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    completed(equations, [from, to], room, &mut |[from, to], room| {
        let [phi, ..] = &mut room.constraints;
        spare::check(equations, to.t, to.q, watch.length, phi)?;
        if growth > watch.alarm {
            remember(equations, from, growth, watch);
            watch.note_examined(growth);
        } else {
            watch.note(growth);
        }
        Ok(())
    })
}

/// `Ok` if outputs are finite, at the time `t`.
///
/// # Example
/// ```
/// # use mbs_runtime::{Error, Mechanism, equations::check_outputs, mechanism};
/// # mechanism! { pub Fall { dof = 1; body ball (y) { mass = 1 [kg]; } output height [m] = y; } }
/// let info = Fall::<f64>::INFO;
/// assert!(check_outputs(info, 0.5, &[1.0]).is_ok());
/// let refused = check_outputs(info, 0.5, &[f64::NAN]);
/// assert!(matches!(refused, Err(Error::Undefined { name: "height", .. })));
/// ```
///
/// # Errors
/// [`Error::Undefined`] that names the first one that is not.
pub fn check_outputs<T: Real>(info: &Info, t: T, outputs: &[T]) -> Result<(), Error> {
    check_defined(t, "the output", outputs, |at| info.outputs.get(at).map_or("", |output| output.name))
}

/// ‖Φ‖ and ‖Φ̇‖
fn violations<T: Real>(equations: &dyn Equations<T>, at: At<'_, T>, room: &mut Room<'_, T>) -> [T; 2] {
    let [rows, ..] = &mut room.constraints;
    equations.phi(at.t, at.q, rows);
    let violation = vectors::norm(rows);
    equations.phi_dot(at, rows);
    [violation, vectors::norm(rows)]
}
