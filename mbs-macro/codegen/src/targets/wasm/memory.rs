//! The memory below the heap: splines, slots of long programs, and the tables of their loops.

use std::rc::Rc;

use mbs_symbolic::Spline;
use wasm_encoder::{MemArg, MemArgTarget};

/// How many numbers stand before the segments of a spline.
pub const HEAD: usize = 3;
/// The length of a segment of a spline, in numbers.
pub const SEGMENT: usize = 5;

/// The memory of a module.
pub struct Memory {
    splines: Vec<u8>,
    addresses: Vec<usize>,
    /// Numbers that functions keep while they run. No function calls another one that has slots, so all have
    /// the same.
    slots: usize,
    tables: Vec<u8>,
}

impl Memory {
    /// With these splines and this many slots. Of a spline there are origin, period or 0, the number of segments
    /// as a number, and per segment where it begins and its coefficients.
    pub fn new(splines: &[Rc<Spline>], slots: usize) -> Self {
        let (mut bytes, mut addresses) = (Vec::new(), Vec::new());
        for spline in splines {
            addresses.push(bytes.len());
            let head = [spline.origin, spline.period.unwrap_or_default(), spline.segments.len() as f64];
            let segments = spline.segments.iter().flat_map(|it| [it.from].into_iter().chain(it.coefficients));
            bytes.extend(head.into_iter().chain(segments).flat_map(f64::to_le_bytes));
        }
        Self { splines: bytes, addresses, slots, tables: Vec::new() }
    }

    /// Where a spline is.
    pub fn spline(&self, spline: usize) -> Option<usize> {
        self.addresses.get(spline).copied()
    }

    /// Where the slots are.
    pub fn slots(&self) -> usize {
        self.splines.len()
    }

    /// Adds a table of numbers; gives its address.
    pub fn numbers(&mut self, numbers: impl Iterator<Item = f64>) -> usize {
        self.table(numbers.flat_map(f64::to_le_bytes))
    }

    /// Adds a table of places, each as the distance of its number in bytes, in 32 bits; gives its address.
    pub fn places(&mut self, places: &[usize]) -> usize {
        self.table(places.iter().flat_map(|place| (8 * *place as u32).to_le_bytes()))
    }

    fn table(&mut self, bytes: impl Iterator<Item = u8>) -> usize {
        let address = self.tables_at() + self.tables.len();
        self.tables.extend(bytes);
        self.tables.resize(self.tables.len().next_multiple_of(8), 0);
        address
    }

    fn tables_at(&self) -> usize {
        self.splines.len() + 8 * self.slots
    }

    /// Where the heap begins.
    pub fn heap(&self) -> usize {
        self.tables_at() + self.tables.len()
    }

    /// The contents of memory at the start, with addresses.
    pub fn data(&self) -> [(usize, &[u8]); 2] {
        [(0, &self.splines), (self.tables_at(), &self.tables)]
    }
}

/// The place of a number behind an address.
pub fn word(at: usize) -> MemArg {
    MemArg { offset: 8 * at as u64, align: 3, target: MemArgTarget::default(), ordering: None }
}
