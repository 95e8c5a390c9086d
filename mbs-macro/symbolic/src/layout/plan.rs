//! A loop over the copies of the same instructions: what every step reads, and what is
//! kept of its results.

use std::hash::Hash;

use rustc_hash::FxHashMap as HashMap;

use super::{Array, Components, Place, Program, Repetition, Rule, SinCos, Slots};
use crate::inconsistency::Inconsistency;
use crate::number::Number;
use crate::program::Operand;
use crate::repetition::Source;

/// What ends a plan.
const ONE_ARRAY: Inconsistency =
    Inconsistency { pass: "layout", rule: "the copies of a loop read an operand from one array" };

/// A loop over the copies of the same instructions.
pub struct Loop<V> {
    /// The instructions.
    pub repetition: Repetition,
    /// What a copy does, one step per instruction.
    pub steps: Vec<Step>,
    /// Variables that hold a result of the copy before.
    pub carried: Vec<Carried>,
    /// Operands that are others in every copy.
    pub columns: Vec<Column<V>>,
    /// Places without a rule, one per copy.
    pub tables: Vec<Vec<usize>>,
}

/// An instruction of a copy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Where the two operands are.
    pub operands: [Read; 2],
    /// Of a sine, the step with the cosine of the same angle in every copy, or the other way
    /// round. The first of the two may compute both.
    pub partner: Option<usize>,
    /// Which of the results are stored.
    pub kept: Kept,
}

/// Where a step finds an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Read {
    /// The same operand in all copies.
    Same(Operand),
    /// The result of another step of the copy.
    Own(usize),
    /// One of the [carried](Loop::carried) variables, by position.
    Carried(usize),
    /// What one of the [columns](Loop::columns) has for the copy, by position.
    Each(usize),
}

/// A variable that holds a result of the copy before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Carried {
    /// The step that gives it.
    pub from: usize,
    /// Its value in the first copy.
    pub first: Operand,
}

/// An operand that is another one in every copy.
#[derive(Clone, Debug, PartialEq)]
pub enum Column<V> {
    /// A number per copy.
    Numbers(Vec<Number>),
    /// An element of an array per copy.
    Elements(Home<V>, Rule),
}

/// The array that the copies of a loop read an operand from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Home<V> {
    /// One with results of the program.
    Result(Array),
    /// The values that depend on parameters alone.
    Hoisted,
    /// A vector that the program is given.
    Vector(V),
}

/// Which results of the copies of an instruction are stored, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// They do not leave their copy, but for the next.
    No,
    /// That of the last copy, after the loop.
    Last(Place),
    /// Those of all copies, at once.
    Each(Array, Rule),
}

/// A sine and a cosine of the components of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Angle {
    /// The column with the angles.
    pub column: usize,
    /// The two steps, in their order.
    pub steps: [usize; 2],
}

impl<V: Copy + Eq + Hash> Loop<V> {
    pub(super) fn new(
        program: &Program,
        repetition: Repetition,
        places: &Slots,
        pairs: &SinCos,
        components: Components<'_, V>,
    ) -> Result<Self, Inconsistency> {
        let sources: Vec<[Source; 2]> =
            (0..repetition.length).map(|at| repetition.sources(program, at)).collect();
        let partner = |at: usize| {
            let partner = pairs.partner(repetition.start + at)?.checked_sub(repetition.start)?;
            (sources.get(partner) == Some(&sources[at])).then_some(partner)
        };
        let mut planner = Planner::new(repetition, places, components);
        let mut kept = vec![None; repetition.length];
        let mut operands = Vec::new();
        // tables are in the order in which they are needed: a sine comes with its cosine
        for (at, [a, b]) in sources.iter().enumerate() {
            operands.push([planner.read(a)?, planner.read(b)?]);
            for at in [Some(at), partner(at)].into_iter().flatten() {
                kept[at].get_or_insert_with(|| planner.keep(at));
            }
        }
        let step = |(at, (operands, kept)): (usize, ([Read; 2], Option<Kept>))| Step {
            operands,
            partner: partner(at),
            kept: kept.unwrap_or(Kept::No),
        };
        let steps = operands.into_iter().zip(kept).enumerate().map(step).collect();
        let Planner { carried, columns, tables, .. } = planner;
        Ok(Self { repetition, steps, carried, columns, tables })
    }
}

impl<V> Loop<V> {
    /// The steps in pairs, if there is nothing but sines and cosines of components of
    /// vectors, all of them stored by a rule or not at all.
    pub fn angles(&self) -> Option<Vec<Angle>> {
        let mut angles = Vec::new();
        for (at, step) in self.steps.iter().enumerate() {
            let (Read::Each(column), Some(partner)) = (step.operands[0], step.partner) else { return None };
            let is_of_components = matches!(self.columns[column], Column::Elements(Home::Vector(_), _));
            if !is_of_components || matches!(step.kept, Kept::Last(_)) {
                return None;
            }
            if at < partner {
                angles.push(Angle { column, steps: [at, partner] });
            }
        }
        self.tables.is_empty().then_some(angles)
    }
}

/// What is known of a loop so far.
struct Planner<'a, V> {
    repetition: Repetition,
    places: &'a Slots,
    components: Components<'a, V>,
    known: HashMap<Source, Read>,
    carried: Vec<Carried>,
    columns: Vec<Column<V>>,
    tables: Vec<Vec<usize>>,
}

impl<'a, V: Copy + Eq> Planner<'a, V> {
    fn new(repetition: Repetition, places: &'a Slots, components: Components<'a, V>) -> Self {
        Self {
            repetition,
            places,
            components,
            known: HashMap::default(),
            carried: Vec::new(),
            columns: Vec::new(),
            tables: Vec::new(),
        }
    }

    /// Where an operand is; what is carried or a column, once.
    fn read(&mut self, source: &Source) -> Result<Read, Inconsistency> {
        if let Some(&known) = self.known.get(source) {
            return Ok(known);
        }
        let read = match source {
            Source::Same(operand) => Read::Same(*operand),
            Source::Own(at) => Read::Own(*at),
            Source::Carried(from, first) => {
                self.carried.push(Carried { from: *from, first: *first });
                Read::Carried(self.carried.len() - 1)
            }
            Source::Each(operands) => {
                let column = self.column(operands).ok_or(ONE_ARRAY)?;
                self.columns.push(column);
                Read::Each(self.columns.len() - 1)
            }
        };
        self.known.insert(source.clone(), read);
        Ok(read)
    }

    /// The column of these operands; `None` if they are not in one array.
    fn column(&mut self, operands: &[Operand]) -> Option<Column<V>> {
        let numbers = operands.iter().map(|operand| match operand {
            Operand::Number(number) => Some(*number),
            _ => None,
        });
        if let Some(numbers) = numbers.collect() {
            return Some(Column::Numbers(numbers));
        }
        let homes: Vec<(Home<V>, usize)> =
            operands.iter().map(|operand| self.home(*operand)).collect::<Option<_>>()?;
        let (home, _) = *homes.first()?;
        let is_one = homes.iter().all(|(other, _)| *other == home);
        let places = homes.into_iter().map(|(_, place)| place).collect();
        is_one.then(|| Column::Elements(home, Rule::of(places, &mut self.tables)))
    }

    /// The array and the place of an operand in it; `None` of what is in none.
    fn home(&self, operand: Operand) -> Option<(Home<V>, usize)> {
        match operand {
            Operand::Value(value) => {
                self.places.of(value).map(|Place { array, at }| (Home::Result(array), at))
            }
            Operand::Hoisted(at) => Some((Home::Hoisted, at)),
            Operand::Symbol(symbol) => {
                (self.components)(symbol).map(|component| (Home::Vector(component.vector), component.place))
            }
            Operand::Number(_) => None,
        }
    }

    /// What is stored of the results of a step.
    fn keep(&mut self, at: usize) -> Kept {
        let Repetition { start, length, count } = self.repetition;
        let copies = (0..count).map(|copy| self.places.of(start + at + copy * length));
        match copies.collect::<Option<Vec<_>>>().as_deref() {
            // those of all copies are in one array
            Some(places @ [first, ..]) => {
                let places = places.iter().map(|place| place.at).collect();
                Kept::Each(first.array, Rule::of(places, &mut self.tables))
            }
            _ => self.places.of(start + at + (count - 1) * length).map_or(Kept::No, Kept::Last),
        }
    }
}
