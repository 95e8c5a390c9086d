//! Rows of Φ_q: those that depend on others, and those that are solved for.

/// A row that is a combination of earlier ones, and of which.
pub type Dependent = (usize, Vec<usize>);

/// The constraints that are solved for, and those that are met with them.
#[derive(Clone, Debug)]
pub struct Rows {
    /// The number of all rows.
    pub count: usize,
    pub basis: Vec<usize>,
    pub redundant: Vec<usize>,
    /// Sets of rows of which one is spare, in every position another one, in the order of their elimination.
    pub sets: Vec<Vec<usize>>,
    /// The rows that the elimination leaves out: those that are redundant, unless sets take their part.
    pub left_out: Vec<usize>,
}

impl Rows {
    /// All of `count` rows but those that are redundant.
    pub fn without(count: usize, redundant: Vec<usize>) -> Self {
        let basis = (0..count).filter(|row| !redundant.contains(row)).collect();
        Self { count, basis, left_out: redundant.clone(), redundant, sets: Vec::new() }
    }

    /// The rows that the elimination takes.
    pub fn eliminated(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.count).filter(|row| !self.left_out.contains(row))
    }

    /// The rows that runs watch, as an elimination does not meet them by itself: the redundant ones, then the others of
    /// sets.
    pub fn watched(&self) -> Vec<usize> {
        let of_sets = self.sets.iter().flatten().filter(|row| !self.redundant.contains(row));
        self.redundant.iter().chain(of_sets).copied().collect()
    }

    /// The rows that are solved for each by itself.
    pub fn alone(&self) -> Vec<usize> {
        self.eliminated().filter(|row| self.sets.iter().all(|set| !set.contains(row))).collect()
    }
}
