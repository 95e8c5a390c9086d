//! Repeated parts of a program: the links of a chain give the same instructions
//! over and over, with other operands.
//!
//! Instructions are compared by what they do and by the kind of their operands;
//! where the sequence repeats itself with some period, it is cut into copies.
//!
//! # Why
//!
//! Elimination makes such parts of the links of a chain, because equally cheap pivots are taken in their
//! order. An operand of a repeated instruction is the same in all copies, a result of its own copy, a result
//! of the copy before, or another one each time.
//!
//! Loops over links are found in programs and not in declarations. So the language needs no rule for them,
//! and they cover everything that repeats itself. Code and compile time grow with the number of different
//! parts.

use std::collections::{BTreeMap, BinaryHeap};
use std::hash::Hash;
use std::ops::Range;

use rustc_hash::FxHashMap as HashMap;

use crate::arena::Symbol;
use crate::program::{Operand, Operation, Program};

/// A repetition has to save at least this many instructions.
const LEAST_SAVED: usize = 32;

/// A repetition has at least this many copies.
const FEWEST_COPIES: usize = 3;

/// Equal sequences of this length are the first hint of a period.
const WINDOW: usize = 8;

/// Instructions in order: each once, or copies of a few.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// These instructions, one after the other.
    Straight(Range<usize>),
    /// Copies of the same instructions.
    Repeated(Repetition),
}

/// `count` copies of `length` instructions from `start` on. They do the same on
/// operands of the same kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repetition {
    /// The first instruction of the first copy.
    pub start: usize,
    /// Instructions in a copy.
    pub length: usize,
    /// The number of copies.
    pub count: usize,
}

/// An operand over all copies of a repetition.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The same in every copy, and there before the first.
    Same(Operand),
    /// The result of an instruction of the same copy, counted from its first.
    Own(usize),
    /// The result of an instruction of the copy before, and what stands for it
    /// in the first copy.
    Carried(usize, Operand),
    /// Another one in every copy.
    Each(Vec<Operand>),
}

impl Block {
    /// The instructions of all copies.
    pub fn range(&self) -> Range<usize> {
        match self {
            Self::Straight(range) => range.clone(),
            Self::Repeated(repetition) => repetition.range(),
        }
    }

    /// How many instructions are left to write down.
    pub fn written(&self) -> usize {
        match self {
            Self::Straight(range) => range.len(),
            Self::Repeated(repetition) => repetition.length,
        }
    }
}

impl Repetition {
    /// The instructions of all copies.
    pub fn range(&self) -> Range<usize> {
        self.start..self.start + self.length * self.count
    }

    /// The two operands of instruction `at` of a copy, over all copies.
    pub fn sources(&self, program: &Program, at: usize) -> [Source; 2] {
        [|i: &crate::Instruction| i.a, |i: &crate::Instruction| i.b].map(|operand| {
            let copies = (0..self.count).map(|copy| self.start + copy * self.length + at);
            self.source(copies.map(|at| operand(&program.instructions[at])).collect())
        })
    }

    fn source(&self, operands: Vec<Operand>) -> Source {
        let start_of = |copy: usize| self.start + copy * self.length;
        // the place in copy `copy − back` that an operand of copy `copy` is computed at
        let place = |copy: usize, back: usize| match operands[copy] {
            Operand::Value(value) if copy >= back => {
                let first = start_of(copy - back);
                (first..first + self.length).contains(&value).then(|| value - first)
            }
            _ => None,
        };
        let alike = |from: usize, back: usize| {
            let first = place(from, back)?;
            (from + 1..self.count).all(|copy| place(copy, back) == Some(first)).then_some(first)
        };
        if let Some(own) = alike(0, 0) {
            return Source::Own(own);
        }
        if let Some(carried) = alike(1, 1) {
            return Source::Carried(carried, operands[0]);
        }
        let first = operands[0];
        let is_there_before = !matches!(first, Operand::Value(value) if value >= self.start);
        match is_there_before && operands.iter().all(|operand| *operand == first) {
            true => Source::Same(first),
            false => Source::Each(operands),
        }
    }
}

impl Program {
    /// The program in blocks, repeated parts found. Symbols of the same class,
    /// by `class`, may take each other's place.
    pub fn blocks<C: Eq + Hash>(&self, class: &dyn Fn(Symbol) -> C) -> Vec<Block> {
        let kinds = self.kinds(class);
        let mut runs: BinaryHeap<Run> =
            periods(&kinds).into_iter().flat_map(|period| runs(&kinds, period)).collect();
        // by their first instruction, none overlaps another
        let mut taken: BTreeMap<usize, Run> = BTreeMap::new();
        // A run is taken, or cut into parts that are shorter together than it.
        while let Some(run) = runs.pop() {
            let gaps = gaps(&taken, run.range());
            if gaps == [run.range()] {
                taken.insert(run.start, run);
            } else {
                let parts = gaps.into_iter().map(|gap| Run { start: gap.start, length: gap.len(), ..run });
                runs.extend(parts.filter(Run::is_worthwhile));
            }
        }
        let mut blocks = Vec::new();
        let mut done = 0;
        for repetition in taken.values().flat_map(|run| self.alike(self.cut(run))) {
            if done < repetition.start {
                blocks.push(Block::Straight(done..repetition.start));
            }
            done = repetition.range().end;
            blocks.push(Block::Repeated(repetition));
        }
        if done < kinds.len() {
            blocks.push(Block::Straight(done..kinds.len()));
        }
        blocks
    }

    /// Equal numbers for instructions that can be copies of each other.
    fn kinds<C: Eq + Hash>(&self, class: &dyn Fn(Symbol) -> C) -> Vec<usize> {
        #[derive(PartialEq, Eq, Hash)]
        enum Kind<C> {
            Number,
            Symbol(C),
            Hoisted,
            Value,
        }
        let kind = |operand: Operand| match operand {
            Operand::Number(_) => Kind::Number,
            Operand::Symbol(symbol) => Kind::Symbol(class(symbol)),
            Operand::Hoisted(_) => Kind::Hoisted,
            Operand::Value(_) => Kind::Value,
        };
        let mut numbers: HashMap<(Operation, Kind<C>, Kind<C>), usize> = HashMap::default();
        let number = self.instructions.iter().map(|instruction| {
            let next = numbers.len();
            *numbers.entry((instruction.operation, kind(instruction.a), kind(instruction.b))).or_insert(next)
        });
        number.collect()
    }

    /// The copies in which the same operands are results of the same copy.
    fn alike(&self, repetition: Repetition) -> Vec<Repetition> {
        let Repetition { start, length, count } = repetition;
        let own = |copy: usize, at: usize| {
            let first = start + copy * length;
            let instruction = &self.instructions[first + at];
            [instruction.a, instruction.b].map(|operand| match operand {
                Operand::Value(value) => value.checked_sub(first),
                _ => None,
            })
        };
        let mut found = Vec::new();
        let mut from = 0;
        for copy in 1..=count {
            if copy < count && (0..length).all(|at| own(copy, at) == own(copy - 1, at)) {
                continue;
            }
            let count = copy - from;
            if count >= FEWEST_COPIES && (count - 1) * length >= LEAST_SAVED {
                found.push(Repetition { start: start + from * length, length, count });
            }
            from = copy;
        }
        found
    }

    /// Cuts a run into copies where the fewest operands come from another copy.
    fn cut(&self, run: &Run) -> Repetition {
        let period = run.period;
        // of the instructions of one period in the middle, how many operands a
        // cut before each place separates from their use
        let middle = run.start + (run.length / period / 2) * period;
        let mut separated = vec![0_usize; period];
        for at in middle..middle + period {
            let instruction = &self.instructions[at];
            for operand in [instruction.a, instruction.b] {
                let Operand::Value(value) = operand else { continue };
                if value >= run.start && at - value < period {
                    (value + 1..=at).for_each(|place| separated[(place - run.start) % period] += 1);
                }
            }
        }
        let repetition = |offset: usize| Repetition {
            start: run.start + offset,
            length: period,
            count: (run.length - offset) / period,
        };
        let cost = |offset: &usize| {
            let cut = repetition(*offset);
            separated[*offset] * cut.count + run.length - cut.range().len()
        };
        repetition((0..period).min_by_key(cost).unwrap_or(0))
    }
}

/// `length` instructions, each of which repeats what is `period` before it,
/// except for the first ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Run {
    start: usize,
    period: usize,
    length: usize,
}

impl Run {
    fn range(&self) -> Range<usize> {
        self.start..self.start + self.length
    }

    /// Instructions that need not be written.
    fn saved(&self) -> usize {
        self.length - self.period.min(self.length)
    }

    fn is_worthwhile(&self) -> bool {
        self.saved() >= LEAST_SAVED && self.length >= FEWEST_COPIES * self.period
    }
}

/// By what they save; of equals, the shorter copies, then the earlier ones.
impl Ord for Run {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let key = |run: &Self| (run.saved(), std::cmp::Reverse((run.period, run.start)));
        key(self).cmp(&key(other))
    }
}

impl PartialOrd for Run {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// Distances at which windows recur often enough to be worth a look.
fn periods(kinds: &[usize]) -> Vec<usize> {
    let mut last: HashMap<&[usize], usize> = HashMap::default();
    let mut recurrences: BTreeMap<usize, usize> = BTreeMap::new();
    for (at, window) in kinds.windows(WINDOW).enumerate() {
        if let Some(before) = last.insert(window, at) {
            *recurrences.entry(at - before).or_insert(0) += 1;
        }
    }
    let is_frequent = |&(_, times): &(usize, usize)| times >= LEAST_SAVED / 2;
    recurrences.into_iter().filter(is_frequent).map(|(period, _)| period).collect()
}

/// The longest runs with a period.
fn runs(kinds: &[usize], period: usize) -> Vec<Run> {
    let mut found = Vec::new();
    let mut start = 0;
    for at in period..=kinds.len() {
        if at == kinds.len() || kinds[at] != kinds[at - period] {
            let run = Run { start, period, length: at - start };
            found.extend(run.is_worthwhile().then_some(run));
            start = at + 1 - period;
        }
    }
    found
}

/// The parts of a range that no run has taken.
fn gaps(taken: &BTreeMap<usize, Run>, range: Range<usize>) -> Vec<Range<usize>> {
    let before = taken.range(..range.start).next_back();
    let mut gaps = Vec::new();
    let mut from = range.start;
    for run in before.into_iter().chain(taken.range(range.clone())).map(|(_, run)| run.range()) {
        if from < run.start {
            gaps.push(from..run.start);
        }
        from = from.max(run.end);
    }
    if from < range.end {
        gaps.push(from..range.end);
    }
    gaps
}
