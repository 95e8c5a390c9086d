//! Where results are kept between the blocks of a program.
//!
//! The results of one instruction of a loop lie side by side, one per copy, so
//! that most loops find their operands at a fixed distance from copy to copy.

use std::collections::HashMap;

use mbs_symbolic::{Block, Operand, Program, Repetition, Source};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// The slots of results that leave their block or their copy.
pub struct Slots {
    /// By instruction.
    slots: HashMap<usize, usize>,
    length: usize,
}

/// Which results of the copies of an instruction are kept, and where.
pub enum Kept {
    /// They do not leave their copy, but for the next.
    No,
    Last(usize),
    Each(Vec<usize>),
}

impl Slots {
    pub fn new(program: &Program, blocks: &[Block]) -> Self {
        let readers = last_readers(program, blocks);
        let mut slots = HashMap::new();
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
                let first = space.take(group.len(), *last);
                slots.extend(group.into_iter().zip(first..));
            }
            space.release(at);
        }
        Self { slots, length: space.length }
    }

    pub fn len(&self) -> usize {
        self.length
    }

    /// Where the result of an instruction is kept.
    pub fn of(&self, value: usize) -> Option<usize> {
        self.slots.get(&value).copied()
    }

    /// Where the results of an instruction of a repetition are kept.
    pub fn of_copies(&self, repetition: &Repetition, at: usize) -> Kept {
        let Repetition { length, count, .. } = *repetition;
        let copies = (0..count).map(|copy| self.of(at + copy * length));
        match copies.collect::<Option<Vec<_>>>() {
            Some(places) => Kept::Each(places),
            None => self.of(at + (count - 1) * length).map_or(Kept::No, Kept::Last),
        }
    }

    pub fn token(&self, value: usize) -> Option<TokenStream> {
        let slot = Literal::usize_unsuffixed(self.of(value)?);
        Some(quote!(slots[#slot]))
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
