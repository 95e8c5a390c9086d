//! The number and the lengths of the steps of a run to a tolerance.

/// The number and the lengths of the steps that a method chose itself, as in a run to a tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Steps taken.
    pub steps: u64,
    /// Steps that were tried and not taken, because their error was too large.
    pub rejected: u64,
    /// The shortest step in s; 0 before the first one.
    pub shortest: f64,
    /// The longest one in s.
    pub longest: f64,
}

impl Effort {
    /// Before the first step.
    pub(crate) const NONE: Self = Self { steps: 0, rejected: 0, shortest: 0.0, longest: 0.0 };

    /// Counts a step of `h` seconds, which is the shortest one unless it leads over a corner that time passes.
    pub fn count(&mut self, h: f64, is_over_corner: bool) {
        if !is_over_corner {
            self.shortest = if self.shortest > 0.0 { self.shortest.min(h) } else { h };
        }
        self.longest = self.longest.max(h);
        self.steps += 1;
    }
}
