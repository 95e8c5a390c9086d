//! Rows of Φ_q: those that depend on others, and those that are solved for.

/// A row that is a combination of earlier ones, and of which.
pub type Dependent = (usize, Vec<usize>);

/// The constraints that are solved for, and those that are met with them.
#[derive(Clone, Debug)]
pub struct Rows {
    pub basis: Vec<usize>,
    pub redundant: Vec<usize>,
}

impl Rows {
    /// All of `count` rows but those that are redundant.
    pub fn without(count: usize, redundant: Vec<usize>) -> Self {
        Self { basis: (0..count).filter(|row| !redundant.contains(row)).collect(), redundant }
    }
}
