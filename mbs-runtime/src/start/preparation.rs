//! The preparation of a state from which a run starts.

use super::consistency::{check_redundant_accelerations, length};
use super::jacobian::Jacobian;
use super::{assembly, consistency};
use crate::diagnosis::{check_finite, check_inputs};
use crate::equations::{At, Equations};
use crate::room::Room;
use crate::simulation::clock::check_time;
use crate::{Error, Real};

/// How a state becomes the start of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// The declared one is made consistent.
    Declared,
    /// A given one has to be consistent.
    Given,
    /// A given one may violate constraints.
    Unchecked,
}

/// The conditions under which a state becomes the start of a run.
#[derive(Clone, Copy, Debug)]
pub struct Preparation<'a, T> {
    /// How the state becomes the start.
    pub start: Start,
    /// The inputs of the first step.
    pub inputs: &'a [T],
    /// The step in s.
    pub step: T,
    /// True if violations of the constraints are meant to decay.
    pub keeps_constraints: bool,
}

impl<T: Real> Preparation<'_, T> {
    /// Makes (q, v) the start, or refuses it. The value is the size of the mechanism in m
    /// by which its redundant constraints are watched; infinite where they are not.
    ///
    /// # Errors
    /// [`Error::Input`], [`Error::Time`], [`Error::NonFinite`], [`Error::OutOfReach`] for redundant constraints that the
    /// motion will violate, and those of [`consistent`](crate::equations::consistent) or
    /// [`check`](crate::equations::check).
    pub fn prepare(
        &self,
        equations: &dyn Equations<T>,
        t: T,
        q: &mut [T],
        v: &mut [T],
        room: &mut Room<'_, T>,
    ) -> Result<T, Error> {
        check_inputs(equations.info(), self.inputs)?;
        check_time::<T>(t.to_f64(), self.step.to_f64())?;
        if self.start == Start::Declared {
            assembly::consistent(equations, t, q, v, room)?;
        }
        let at = At { t, q, v };
        check_finite(equations.info(), at)?;
        if self.start == Start::Given {
            consistency::check(equations, at, self.step, room)?;
        }
        let has_redundant = !equations.info().redundant.is_empty();
        if !has_redundant || !self.keeps_constraints || self.start == Start::Unchecked {
            return Ok(T::from_f64(f64::INFINITY));
        }
        check_redundant_accelerations(equations, at, self.inputs, self.step, room)?;
        let [direction, ..] = &mut room.coordinates;
        let [phi_t, entries, ..] = &mut room.constraints;
        Ok(length(&mut Jacobian::new(equations, t, at.q, direction, phi_t), entries))
    }
}
