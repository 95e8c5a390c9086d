//! What is kept of a member of a sweep.

use crate::Unit;

/// The extents of all [`quantities`](super::quantities), or why the run did not reach its end.
pub type Member = Result<Vec<Extent>, mbs_runtime::Error>;

/// The extent of a quantity over all steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The smallest value.
    pub low: f64,
    /// The largest value.
    pub high: f64,
    /// The value at the end.
    pub last: f64,
}

impl Extent {
    /// Takes what each quantity is now; the first time there are none yet.
    pub(crate) fn see_all(extents: &mut Vec<Self>, now: impl Iterator<Item = f64>) {
        if extents.is_empty() {
            extents.extend(now.map(|x| Self { low: x, high: x, last: x }));
        } else {
            extents.iter_mut().zip(now).for_each(|(extent, x)| extent.see(x));
        }
    }

    fn see(&mut self, x: f64) {
        // NaN stays.
        if x < self.low || x.is_nan() {
            self.low = x;
        }
        if x > self.high || x.is_nan() {
            self.high = x;
        }
        self.last = x;
    }

    pub(super) fn shown_in(self, unit: &Unit) -> Self {
        let Self { low, high, last } = self;
        Self { low: unit.shown(low), high: unit.shown(high), last: unit.shown(last) }
    }
}
