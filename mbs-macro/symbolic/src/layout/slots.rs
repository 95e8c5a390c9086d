//! Where results are kept between the blocks of a program.
//!
//! The results of one instruction of a loop lie side by side, one per copy, so
//! that most loops find their operands at a fixed distance from copy to copy.
//!
//! The others find them by a table. Slots are taken again when their results are read no more.

use rustc_hash::FxHashMap as HashMap;

use super::readers::last_readers;
use super::space::Space;
use crate::program::{Operand, Program};
use crate::repetition::{Block, Repetition, Source};

/// Where a result is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The array.
    pub array: Array,
    /// The position in it.
    pub at: usize,
}

/// The arrays that results are kept in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Array {
    /// Slots, used again as soon as nobody reads them any more.
    Slots,
    /// One of the arrays of outputs that were asked for, by position.
    Result(usize),
}

/// The places of results that leave their block or their copy.
pub(super) struct Slots {
    /// By instruction.
    places: HashMap<usize, Place>,
    length: usize,
}

impl Slots {
    /// Outputs are kept in arrays of results at once, where there are any: as many of them in
    /// each as `lengths` says, one array after the other.
    pub fn new(program: &Program, blocks: &[Block], lengths: &[usize]) -> Self {
        let readers = last_readers(program, blocks);
        let mut places = outputs(program, blocks, lengths);
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
                let slots = (first..).map(|at| Place { array: Array::Slots, at });
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
}

/// The places of outputs in the arrays that are returned. A loop reads and writes one array
/// by one rule: where only some of the results would be outputs, none of them is
/// kept there; nor is one that is two outputs.
fn outputs(program: &Program, blocks: &[Block], lengths: &[usize]) -> HashMap<usize, Place> {
    let mut places = HashMap::default();
    let all = lengths
        .iter()
        .enumerate()
        .flat_map(|(result, &length)| (0..length).map(move |at| Place { array: Array::Result(result), at }));
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
