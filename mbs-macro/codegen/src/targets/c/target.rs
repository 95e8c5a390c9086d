//! A mechanism to be printed, and the type of its numbers.

use std::cell::RefCell;

use mbs_symbolic::Inconsistency;

use super::names::Names;
use crate::compiled::Compiled;

/// The floating-point type that C computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// `double`
    Double,
    /// `float`
    Float,
}

/// A mechanism to be printed, with its names and its type of numbers.
pub struct Target<'a> {
    pub compiled: &'a Compiled,
    pub names: &'a Names,
    pub scalar: Scalar,
    /// Programs that were not written as they were checked.
    pub faults: RefCell<Vec<Inconsistency>>,
}

impl Target<'_> {
    /// C text of this target, in which `NAME` and `CAPS` stand for what names begin with, `SCALAR`
    /// for the type, `STATES` for what is integrated, `STAGE` for a moment of it, and `SQRT` and
    /// `FABS` for functions. No name of a declaration may be in it.
    pub fn fill(&self, text: &str) -> String {
        let states = self.names.states();
        let stage = if self.compiled.has_reduced_states() { "stage" } else { "state" };
        // names last, because they may be any word
        text.replace("STATE_COUNT", &format!("CAPS_{}", states.name.to_uppercase()))
            .replace("NAME_STATES", &format!("NAME_{}", states.name))
            .replace("NAME_STAGE", &format!("NAME_{stage}"))
            .replace("SCALAR", self.scalar.name())
            .replace("SCHEME", self.compiled.choices.scheme.title)
            .replace("SQRT", &self.scalar.of_math("sqrt"))
            .replace("FABS", &self.scalar.of_math("fabs"))
            .replace("NAME", &self.names.prefix)
            .replace("CAPS", &self.names.capitals)
    }
}

impl Scalar {
    /// The type.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Float => "float",
        }
    }

    /// The nearest number of the type as an expression that needs no parentheses.
    pub(super) fn literal(self, value: f64) -> String {
        let (value, text) = match self {
            Self::Double => (value, format!("{value:?}")),
            Self::Float => (f64::from(value as f32), format!("{:?}f", value as f32)),
        };
        match value {
            _ if value.is_nan() => "NAN".to_owned(),
            f64::INFINITY => "INFINITY".to_owned(),
            f64::NEG_INFINITY => "(-INFINITY)".to_owned(),
            _ if value.is_sign_negative() => format!("({text})"),
            _ => text,
        }
    }

    /// A function of `math.h`.
    pub(super) fn of_math(self, name: &str) -> String {
        match self {
            Self::Double => name.to_owned(),
            Self::Float => format!("{name}f"),
        }
    }
}
