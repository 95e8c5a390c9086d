//! Pairs that are tried out.

use super::kinds::Partner;
use super::steps::Lane;

/// Pairs in the order in which they came, and who is in them.
pub(super) struct Trial {
    pairs: Vec<(usize, usize)>,
    partners: Vec<Option<Partner>>,
}

impl Trial {
    /// For programs of that many instructions.
    pub fn new(length: usize) -> Self {
        Self { pairs: Vec::new(), partners: vec![None; length] }
    }

    pub fn pairs(&self) -> &[(usize, usize)] {
        &self.pairs
    }

    pub fn partner(&self, at: usize) -> Option<Partner> {
        self.partners[at]
    }

    pub fn push(&mut self, first: usize, second: usize) {
        self.pairs.push((first, second));
        self.partners[first] = Some(Partner { other: second, lane: Lane::First });
        self.partners[second] = Some(Partner { other: first, lane: Lane::Second });
    }

    /// Takes back all pairs but the first ones.
    pub fn truncate(&mut self, length: usize) {
        for (first, second) in self.pairs.drain(length..) {
            self.partners[first] = None;
            self.partners[second] = None;
        }
    }
}
