//! Slots that are used again as soon as nobody reads them any more.

use std::collections::BTreeMap;

/// Slots in use and free ones.
#[derive(Default)]
pub(super) struct Space {
    /// Their number.
    pub length: usize,
    /// First slot, how many, and the last block that reads them.
    used: Vec<(usize, usize, usize)>,
    /// First slot → how many; no two touch.
    free: BTreeMap<usize, usize>,
}

impl Space {
    /// `count` slots side by side, until block `last` has read them.
    pub fn take(&mut self, count: usize, last: usize) -> usize {
        let tightest = self.free.iter().filter(|(_, free)| **free >= count).min_by_key(|(_, free)| **free);
        let first = match tightest.map(|(first, free)| (*first, *free)) {
            Some((first, free)) => {
                self.free.remove(&first);
                if free > count {
                    self.free.insert(first + count, free - count);
                }
                first
            }
            None => {
                self.length += count;
                self.length - count
            }
        };
        self.used.push((first, count, last));
        first
    }

    /// Frees what no block behind `block` reads.
    pub fn release(&mut self, block: usize) {
        let (done, used) = self.used.drain(..).partition::<Vec<_>, _>(|(.., last)| *last <= block);
        self.used = used;
        for (first, count, _) in done {
            self.give_back(first, count);
        }
    }

    fn give_back(&mut self, mut first: usize, mut count: usize) {
        if let Some((&before, &length)) = self.free.range(..first).next_back()
            && before + length == first
        {
            self.free.remove(&before);
            (first, count) = (before, length + count);
        }
        if let Some(length) = self.free.remove(&(first + count)) {
            count += length;
        }
        self.free.insert(first, count);
    }
}
