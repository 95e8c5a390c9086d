//! The error that ends a pass which breaks its own rule.

use std::fmt;

/// A pass has broken a rule that it keeps by itself, whatever it is given: a mistake
/// of this crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inconsistency {
    /// The pass at fault.
    pub pass: &'static str,
    /// The rule that it broke.
    pub rule: &'static str,
}

impl fmt::Display for Inconsistency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` breaks a rule: {}", self.pass, self.rule)
    }
}

impl std::error::Error for Inconsistency {}
