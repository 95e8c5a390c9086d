//! Where results are kept between the blocks of a program.
//!
//! The results of one instruction of a loop lie side by side, one per copy, so
//! that most loops find their operands at a fixed distance from copy to copy.

use std::collections::HashMap;

use mbs_symbolic::{Block, Operand, Program, Repetition, Source};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// Where a result is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub array: Kind,
    pub at: usize,
}

/// The arrays that results are kept in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Reused as soon as nobody reads them any more.
    Slots,
    /// The result q̈ itself,
    Acceleration,
    /// and the feedback.
    Feedback,
}

impl Kind {
    pub fn ident(self) -> Ident {
        match self {
            Self::Slots => format_ident!("slots"),
            Self::Acceleration => format_ident!("acceleration"),
            Self::Feedback => format_ident!("feedback"),
        }
    }
}

/// The places of results that leave their block or their copy.
pub struct Slots {
    /// By instruction.
    places: HashMap<usize, Place>,
    length: usize,
}

/// Which results of the copies of an instruction are kept, and where.
pub enum Kept {
    /// They do not leave their copy, but for the next.
    No,
    Last(Place),
    Each(Kind, Vec<usize>),
}

impl Slots {
    /// Outputs are kept in `arrays` at once, where there are any: as many of them in each as
    /// it says, one array after the other.
    pub fn new(program: &Program, blocks: &[Block], arrays: &[(Kind, usize)]) -> Self {
        let readers = last_readers(program, blocks);
        let mut places = outputs(program, blocks, arrays);
        let mut space = Space::default();
        for (at, block) in blocks.iter().enumerate() {
            let groups: Vec<Vec<usize>> = match block {
                Block::Straight(range) => range.clone().map(|value| vec![value]).collect(),
                Block::Repeated(repetition) => results(repetition).collect(),
            };
            for mut group in groups {
                let is_read = |value: &usize| readers.contains_key(value);
                if let Some((last, before)) = group.split_last()
                    && !before.iter().any(is_read)
                {
                    group = vec![*last];
                }
                let Some(last) = group.iter().filter_map(|value| readers.get(value)).max() else { continue };
                if group.iter().all(|value| places.contains_key(value)) {
                    continue;
                }
                let first = space.take(group.len(), *last);
                let slots = (first..).map(|at| Place { array: Kind::Slots, at });
                places.extend(group.into_iter().zip(slots));
            }
            space.release(at);
        }
        Self { places, length: space.length }
    }

    #[cfg(test)]
    pub fn put(&mut self, value: usize, place: Place) {
        self.places.insert(value, place);
    }

    pub fn len(&self) -> usize {
        self.length
    }

    /// Where the result of an instruction is kept.
    pub fn of(&self, value: usize) -> Option<Place> {
        self.places.get(&value).copied()
    }

    /// Where the results of an instruction of a repetition are kept.
    pub fn of_copies(&self, repetition: &Repetition, at: usize) -> Kept {
        let Repetition { length, count, .. } = *repetition;
        let copies = (0..count).map(|copy| self.of(at + copy * length));
        match copies.collect::<Option<Vec<_>>>().as_deref() {
            // those of all copies are in one array
            Some(places @ [first, ..]) => {
                Kept::Each(first.array, places.iter().map(|place| place.at).collect())
            }
            _ => self.of(at + (count - 1) * length).map_or(Kept::No, Kept::Last),
        }
    }

    pub fn token(&self, value: usize) -> Option<TokenStream> {
        let Place { array, at } = self.of(value)?;
        let (array, at) = (array.ident(), Literal::usize_unsuffixed(at));
        Some(quote!(#array[#at]))
    }
}

/// The places of outputs in the arrays that are returned. A loop reads and writes one array
/// by one rule: where only some of the results would be outputs, none of them is
/// kept there; nor is one that is two outputs.
fn outputs(program: &Program, blocks: &[Block], arrays: &[(Kind, usize)]) -> HashMap<usize, Place> {
    let mut places = HashMap::new();
    let all = arrays.iter().flat_map(|&(array, length)| (0..length).map(move |at| Place { array, at }));
    let mut twice = Vec::new();
    for (output, place) in program.outputs.iter().zip(all) {
        if let Operand::Value(value) = *output
            && places.insert(value, place).is_some()
        {
            twice.push(value);
        }
    }
    places.retain(|value, _| !twice.contains(value));
    let value = |operand: &Operand| match operand {
        Operand::Value(value) => Some(*value),
        _ => None,
    };
    let mut together: Vec<Vec<usize>> = Vec::new();
    for block in blocks {
        let Block::Repeated(repetition) = block else { continue };
        together.extend(results(repetition));
        for source in (0..repetition.length).flat_map(|at| repetition.sources(program, at)) {
            if let Source::Each(operands) = source {
                together.push(operands.iter().filter_map(value).collect());
            }
        }
    }
    // places only become fewer
    loop {
        let before = places.len();
        for group in &together {
            let array = |value: &usize| places.get(value).map(|place: &Place| place.array);
            if group.iter().any(|value| array(value) != array(&group[0])) {
                places.retain(|value, _| !group.contains(value));
            }
        }
        if places.len() == before {
            return places;
        }
    }
}

/// The results of each instruction of a repetition, one per copy.
fn results(repetition: &Repetition) -> impl Iterator<Item = Vec<usize>> {
    let Repetition { start, length, count } = *repetition;
    (0..length).map(move |at| (0..count).map(|copy| start + copy * length + at).collect())
}

/// The last block that reads a result through its slot; `usize::MAX` of outputs.
fn last_readers(program: &Program, blocks: &[Block]) -> HashMap<usize, usize> {
    let mut readers: HashMap<usize, usize> = HashMap::new();
    let mut read = |operand: Operand, reader: usize| {
        if let Operand::Value(value) = operand {
            let last = readers.entry(value).or_insert(reader);
            *last = reader.max(*last);
        }
    };
    for (at, block) in blocks.iter().enumerate() {
        match block {
            Block::Straight(range) => {
                for instruction in &program.instructions[range.clone()] {
                    for operand in [instruction.a, instruction.b] {
                        let is_own = matches!(operand, Operand::Value(value) if range.contains(&value));
                        if !is_own {
                            read(operand, at);
                        }
                    }
                }
            }
            Block::Repeated(repetition) => {
                for source in (0..repetition.length).flat_map(|i| repetition.sources(program, i)) {
                    match source {
                        Source::Own(_) => {}
                        Source::Same(operand) | Source::Carried(_, operand) => read(operand, at),
                        Source::Each(operands) => operands.into_iter().for_each(|operand| read(operand, at)),
                    }
                }
            }
        }
    }
    program.outputs.iter().for_each(|&output| read(output, usize::MAX));
    readers
}

/// Slots in use and free ones.
#[derive(Default)]
struct Space {
    length: usize,
    /// First slot, how many, and the last block that reads them.
    used: Vec<(usize, usize, usize)>,
    /// First slot → how many; no two touch.
    free: std::collections::BTreeMap<usize, usize>,
}

impl Space {
    /// `count` slots side by side, until block `last` has read them.
    fn take(&mut self, count: usize, last: usize) -> usize {
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
    fn release(&mut self, block: usize) {
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
