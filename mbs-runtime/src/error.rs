//! What can go wrong at run time.

use core::fmt;

/// Why a mechanism could not be built, started or advanced.
///
/// Every variant names the thing in the words of the declaration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A parameter is not finite or violates a condition.
    Parameter {
        /// The parameter, or the body property computed from parameters.
        name: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// What has to hold.
        requirement: &'static str,
    },
    /// An input is not finite.
    Input {
        /// The input.
        name: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// A step that is not positive and finite.
    Step {
        /// The step in s.
        step: f64,
    },
    /// An end time that is not finite or lies before the current time.
    EndTime {
        /// The end time in s.
        end: f64,
        /// The current time in s.
        now: f64,
    },
    /// A gain that is negative or not finite.
    Gain {
        /// `alpha` or `beta`.
        name: &'static str,
        /// Its value in 1/s.
        value: f64,
    },
    /// Gains with which the constraint violation grows from step to step.
    UnstableGains {
        /// α in 1/s.
        alpha: f64,
        /// β in 1/s.
        beta: f64,
        /// The step in s.
        step: f64,
        /// `held` or `per-stage`.
        feedback: &'static str,
    },
    /// A pivot of the elimination vanished: constraints depend on each other
    /// in this position, or a massless coordinate is undetermined. Without
    /// names: friction jams, or no single pivot is to blame.
    Singular {
        /// When, in s.
        t: f64,
        /// The constraint of the pivot; empty for a pure mass pivot.
        constraint: &'static str,
        /// The coordinate of the pivot; empty for a pure constraint pivot.
        coordinate: &'static str,
        /// The pivot growth.
        growth: f64,
    },
    /// A coordinate, its velocity or its acceleration became infinite or NaN.
    NonFinite {
        /// When, in s.
        t: f64,
        /// The coordinate.
        coordinate: &'static str,
    },
    /// The positions could not be brought onto Φ = 0.
    NotAssembled {
        /// When, in s.
        t: f64,
        /// The constraint that is violated most.
        constraint: &'static str,
        /// By how much.
        violation: f64,
    },
    /// Kinematic analysis of a mechanism that the drives do not determine.
    NotDriven {
        /// Degrees of freedom that are left.
        dof: i32,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Parameter { name, value, requirement } => {
                write!(f, "`{name}` is {value}, but {requirement}")
            }
            Self::Input { name, value } => {
                write!(f, "input `{name}` is {value}, but it has to be finite")
            }
            Self::Step { step } => {
                write!(f, "the step is {step} s, but it has to be positive and finite")
            }
            Self::EndTime { end, now } => write!(
                f,
                "the end time is {end} s, but it has to be finite and not before the current {now} s"
            ),
            Self::Gain { name, value } => {
                write!(f, "the gain {name} is {value} 1/s, but it has to be finite and not negative")
            }
            Self::UnstableGains { alpha, beta, step, feedback } => write!(
                f,
                "the gains alpha = {alpha} 1/s, beta = {beta} 1/s are unstable with {feedback} feedback \
                 and a step of {step} s: the constraint violation would grow; reduce them or the step, \
                 or take `deadbeat({step})`"
            ),
            Self::Singular { t, constraint, coordinate, growth } => {
                write!(f, "singular position at t = {t} s: ")?;
                match (constraint, coordinate) {
                    ("", "") => write!(f, "the constrained system has no unique solution")?,
                    (c, "") => write!(f, "constraint `{c}` depends on the others there")?,
                    ("", q) => write!(f, "nothing determines the acceleration of `{q}` there")?,
                    (c, q) => write!(f, "constraint `{c}` does not determine `{q}` there")?,
                }
                write!(f, " (pivot growth {growth:.1e})")
            }
            Self::NonFinite { t, coordinate } => {
                write!(
                    f,
                    "the motion of `{coordinate}` is no longer finite at t = {t} s; if the mechanism can reach \
                 that position at all, take a smaller step or smaller gains"
                )
            }
            Self::NotAssembled { t, constraint, violation } => write!(
                f,
                "the mechanism cannot be assembled at t = {t} s: constraint `{constraint}` stays violated \
                 by {violation:.3e}; check the dimensions, or start from a closer guess"
            ),
            Self::NotDriven { dof } => write!(
                f,
                "the constraints leave {dof} degree(s) of freedom, so they do not determine the motion; \
                 add drives or integrate the equations of motion"
            ),
        }
    }
}

impl core::error::Error for Error {}
