//! Finds out what the loop over the copies of a repetition reads and keeps.

use std::hash::Hash;

use rustc_hash::FxHashMap as HashMap;

use super::{
    Carried, Column, Components, Home, Kept, Loop, Place, Program, Read, Repetition, Rule, SinCos, Slots,
    Step,
};
use crate::inconsistency::Inconsistency;
use crate::program::Operand;
use crate::repetition::Source;

/// The error that ends a plan.
const ONE_ARRAY: Inconsistency =
    Inconsistency { pass: "layout", rule: "the copies of a loop read an operand from one array" };

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
        let steps = operands.into_iter().zip(kept).enumerate();
        let steps = steps.map(|(at, (operands, kept))| Step {
            operands,
            partner: partner(at),
            kept: kept.unwrap_or(Kept::No),
        });
        let steps = steps.collect();
        let Planner { carried, columns, tables, .. } = planner;
        Ok(Self { repetition, steps, carried, columns, tables })
    }
}

/// The parts of a loop that are known so far.
struct Planner<'a, V> {
    repetition: Repetition,
    places: &'a Slots,
    components: Components<'a, V>,
    known: HashMap<&'a Source, Read>,
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
    fn read(&mut self, source: &'a Source) -> Result<Read, Inconsistency> {
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
        self.known.insert(source, read);
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

    /// The results of a step that are stored.
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
