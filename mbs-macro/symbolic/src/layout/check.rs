//! A long program as it is laid out, run: parts in their order, copies one after the other,
//! operands from where loops and functions read them, results kept where they are kept. It
//! has to give what the program does, at numbers without any relation, bit for bit.

use std::hash::Hash;

use rustc_hash::FxHashMap as HashMap;

use super::{
    Array, Column, Component, Components, Home, Kept, Layout, Loop, Part, Place, Read, Rule, Straight,
};
use crate::arena::Symbol;
use crate::inconsistency::Inconsistency;
use crate::probe;
use crate::program::{Operand, Program};

/// The error of a layout that breaks its promise.
const PROMISE: Inconsistency =
    Inconsistency { pass: "layout", rule: "loops and slots compute what the program does" };

/// The layout gives what the program does.
///
/// # Errors
/// It does not.
pub(super) fn check<V: Copy + Eq + Hash>(
    program: &Program,
    layout: &Layout<V>,
    components: Components<'_, V>,
) -> Result<(), Inconsistency> {
    compare(program, program, layout, components)
}

/// Checks that the program that is laid out gives the results of the expected one.
fn compare<V: Copy + Eq + Hash>(
    expected: &Program,
    laid_out: &Program,
    layout: &Layout<V>,
    components: Components<'_, V>,
) -> Result<(), Inconsistency> {
    let vectors = vectors(laid_out, components);
    for point in 0..probe::POINTS {
        let (symbol, hoisted) = (probe::symbol(point), probe::hoisted(point));
        let given = Given { symbol: &symbol, hoisted: &hoisted, vectors: &vectors };
        let mut run = Run { program: laid_out, layout, given, kept: HashMap::default() };
        let found = run.outputs().ok_or(PROMISE)?;
        let values = expected.evaluate_with(&symbol, &hoisted);
        let is_equal = |(found, value): (&f64, &f64)| {
            found.to_bits() == value.to_bits() || found.is_nan() && value.is_nan()
        };
        if found.len() != values.len() || !found.iter().zip(&values).all(is_equal) {
            return Err(PROMISE);
        }
    }
    Ok(())
}

/// The symbols of a program, by their places in vectors.
fn vectors<V: Copy + Eq + Hash>(
    program: &Program,
    components: Components<'_, V>,
) -> HashMap<(V, usize), Symbol> {
    let operands = program.instructions.iter().flat_map(|instruction| [instruction.a, instruction.b]);
    let component = |operand| match operand {
        Operand::Symbol(symbol) => {
            components(symbol).map(|Component { vector, place }| ((vector, place), symbol))
        }
        _ => None,
    };
    operands.filter_map(component).collect()
}

/// The numbers that are there before the first part.
struct Given<'a, V> {
    symbol: &'a dyn Fn(Symbol) -> f64,
    hoisted: &'a dyn Fn(usize) -> f64,
    vectors: &'a HashMap<(V, usize), Symbol>,
}

struct Run<'a, V> {
    program: &'a Program,
    layout: &'a Layout<V>,
    given: Given<'a, V>,
    /// The contents of the arrays.
    kept: HashMap<Place, f64>,
}

/// `None` where an operand is not there.
impl<V: Copy + Eq + Hash> Run<'_, V> {
    /// Runs the parts, and reads the outputs.
    fn outputs(&mut self) -> Option<Vec<f64>> {
        let layout = self.layout;
        for part in &layout.parts {
            match part {
                Part::Straight(straight) => self.straight(straight)?,
                Part::Loop(repeated) => self.repeated(repeated)?,
            }
        }
        for &(operand, place) in &layout.given {
            let value = self.outside(operand)?;
            self.keep(place, value)?;
        }
        layout.outputs.iter().map(|place| self.kept.get(place).copied()).collect()
    }

    /// An operand that is not computed in the part at hand.
    fn outside(&self, operand: Operand) -> Option<f64> {
        match operand {
            Operand::Value(value) => self.kept.get(&self.layout.place(value)?).copied(),
            Operand::Number(number) => Some(number.to_f64()),
            Operand::Symbol(symbol) => Some((self.given.symbol)(symbol)),
            Operand::Hoisted(at) => Some((self.given.hoisted)(at)),
        }
    }

    fn keep(&mut self, place: Place, value: f64) -> Option<()> {
        let is_there = place.array != Array::Slots || place.at < self.layout.slots;
        is_there.then(|| self.kept.insert(place, value)).map(drop)
    }

    fn apply(&self, at: usize, [a, b]: [f64; 2]) -> f64 {
        self.program.apply(self.program.instructions[at].operation, a, b)
    }

    fn straight(&mut self, straight: &Straight) -> Option<()> {
        let mut results: HashMap<usize, f64> = HashMap::default();
        for at in straight.range.clone() {
            let instruction = &self.program.instructions[at];
            let read = |operand| match operand {
                Operand::Value(value) if straight.range.contains(&value) => results.get(&value).copied(),
                other => self.outside(other),
            };
            let result = self.apply(at, [read(instruction.a)?, read(instruction.b)?]);
            results.insert(at, result);
        }
        straight.kept.iter().try_for_each(|(at, place)| self.keep(*place, *results.get(at)?))
    }

    fn repeated(&mut self, repeated: &Loop<V>) -> Option<()> {
        let firsts = repeated.carried.iter().map(|carried| self.outside(carried.first));
        let mut carried: Vec<f64> = firsts.collect::<Option<_>>()?;
        let mut results = Vec::new();
        for copy in 0..repeated.repetition.count {
            results = self.copy(repeated, copy, &carried)?;
            carried = repeated.carried.iter().map(|carried| results[carried.from]).collect();
        }
        for (step, result) in repeated.steps.iter().zip(results) {
            if let Kept::Last(place) = step.kept {
                self.keep(place, result)?;
            }
        }
        Some(())
    }

    /// The results of a copy.
    fn copy(&mut self, repeated: &Loop<V>, copy: usize, carried: &[f64]) -> Option<Vec<f64>> {
        let mut frame = Frame {
            repeated,
            copy,
            carried,
            held: vec![None; repeated.columns.len()],
            results: vec![None; repeated.steps.len()],
        };
        for (at, step) in repeated.steps.iter().enumerate() {
            let [a, b] = step.operands;
            let operands = [frame.operand(self, a)?, frame.operand(self, b)?];
            // a sine comes with its cosine
            for at in [Some(at), step.partner].into_iter().flatten() {
                if frame.results[at].is_some() {
                    continue;
                }
                let result = self.apply(repeated.repetition.start + at, operands);
                frame.results[at] = Some(result);
                if let Kept::Each(array, rule) = repeated.steps[at].kept {
                    self.keep(Place { array, at: rule.at(copy, &repeated.tables) }, result)?;
                }
            }
        }
        frame.results.into_iter().collect()
    }

    /// The number that a column has for a copy.
    fn element(&self, repeated: &Loop<V>, column: &Column<V>, copy: usize) -> Option<f64> {
        let place = |rule: &Rule| rule.at(copy, &repeated.tables);
        match column {
            Column::Numbers(numbers) => Some(numbers[copy].to_f64()),
            Column::Elements(Home::Result(array), rule) => {
                self.kept.get(&Place { array: *array, at: place(rule) }).copied()
            }
            Column::Elements(Home::Hoisted, rule) => Some((self.given.hoisted)(place(rule))),
            Column::Elements(Home::Vector(vector), rule) => {
                let symbol = self.given.vectors.get(&(*vector, place(rule)))?;
                Some((self.given.symbol)(*symbol))
            }
        }
    }
}

/// The variables of a copy of a loop.
struct Frame<'a, V> {
    repeated: &'a Loop<V>,
    copy: usize,
    carried: &'a [f64],
    /// By column, what was read so far.
    held: Vec<Option<f64>>,
    /// By step, what was computed so far.
    results: Vec<Option<f64>>,
}

impl<V: Copy + Eq + Hash> Frame<'_, V> {
    /// An operand of a step; an element of a column is read when it is first needed, and held.
    fn operand(&mut self, run: &Run<'_, V>, read: Read) -> Option<f64> {
        match read {
            Read::Same(operand) => run.outside(operand),
            Read::Own(step) => self.results[step],
            Read::Carried(at) => Some(self.carried[at]),
            Read::Each(at) => {
                if self.held[at].is_none() {
                    self.held[at] = run.element(self.repeated, &self.repeated.columns[at], self.copy);
                }
                self.held[at]
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]
mod tests {
    use super::*;
    use crate::layout::Slots;
    use crate::{Arena, Block, Function, Number, Stage, lower_whole};

    /// Numbers of a chain are components of one vector.
    const COMPONENTS: Components<'_, ()> = &|symbol| Some(Component { vector: (), place: symbol.index() });

    /// xᵢ = xᵢ₋₁·sin(qᵢ) + x₀/qᵢ, in loops.
    fn chain() -> (Program, Vec<Block>) {
        let mut arena = Arena::new();
        let mut last = arena.one();
        let mut links = Vec::new();
        for link in 0..50 {
            let symbol = arena.symbol(&format!("q{link}"), Stage::Variable);
            let q = arena.variable(symbol);
            let sine = arena.call(Function::Sin, q);
            let inverse = arena.powi(q, -1);
            let product = arena.mul(last, sine);
            let sum = arena.add(product, inverse);
            last = arena.share(sum);
            links.push(last);
        }
        let total = links.iter().map(|&link| (link, Number::ONE)).collect::<Vec<_>>();
        let sum = arena.sum(&total);
        let program = lower_whole(&mut arena, &[sum, last], 0).expect("a program");
        let blocks = program.blocks(&|_| 0);
        (program, blocks)
    }

    /// Its layout, which is right.
    fn layout() -> (Program, Layout<()>) {
        let (program, blocks) = chain();
        let layout = Layout::new(&program, &blocks, &[], COMPONENTS).expect("a layout");
        (program, layout)
    }

    /// The layout of blocks and places as they are.
    fn of(program: &Program, blocks: &[Block], slots: Slots) -> Layout<()> {
        Layout::plan(program, blocks, slots, COMPONENTS).expect("a plan")
    }

    fn loops(layout: &mut Layout<()>) -> impl Iterator<Item = &mut Loop<()>> {
        layout.parts.iter_mut().filter_map(|part| match part {
            Part::Loop(repeated) => Some(repeated),
            Part::Straight(_) => None,
        })
    }

    #[test]
    fn an_operand_that_was_taken_for_another_is_caught() {
        let (program, blocks) = chain();
        assert!(blocks.iter().any(|block| matches!(block, Block::Repeated(_))));
        assert!(Layout::new(&program, &blocks, &[], COMPONENTS).is_ok());
        let mut tried = 0;
        for at in 0..program.instructions.len() {
            let mut wrong = program.clone();
            let Operand::Value(value @ 1..) = wrong.instructions[at].a else { continue };
            wrong.instructions[at].a = Operand::Value(value - 1);
            let layout = of(&wrong, &blocks, Slots::new(&wrong, &blocks, &[]));
            assert_eq!(compare(&program, &wrong, &layout, COMPONENTS), Err(PROMISE), "instruction {at}");
            tried += 1;
        }
        assert!(tried > 50);
    }

    #[test]
    fn a_slot_that_is_given_away_too_early_is_caught() {
        let (program, blocks) = chain();
        let mut slots = Slots::new(&program, &blocks, &[]);
        let [Operand::Value(first), Operand::Value(second)] = program.outputs[..] else {
            panic!("two results")
        };
        slots.put(first, slots.of(second).expect("it is kept"));
        assert_eq!(check(&program, &of(&program, &blocks, slots), COMPONENTS), Err(PROMISE));
    }

    #[test]
    fn blocks_in_another_order_are_caught() {
        let (program, mut blocks) = chain();
        let slots = Slots::new(&program, &blocks, &[]);
        blocks.reverse();
        assert_eq!(check(&program, &of(&program, &blocks, slots), COMPONENTS), Err(PROMISE));
    }

    #[test]
    fn slots_that_are_not_there_are_caught() {
        let (program, mut layout) = layout();
        layout.slots -= 1;
        assert_eq!(check(&program, &layout, COMPONENTS), Err(PROMISE));
    }

    #[test]
    fn a_rule_that_reads_or_stores_elsewhere_is_caught() {
        fn shift(rule: &mut Rule) {
            if let Rule::Line { first, .. } = rule {
                *first += 1;
            }
        }
        let counts: Vec<[usize; 2]> =
            loops(&mut layout().1).map(|repeated| [repeated.columns.len(), repeated.steps.len()]).collect();
        let mut tried = 0;
        for (at, [columns, steps]) in counts.into_iter().enumerate() {
            for column in 0..columns {
                let (program, mut layout) = layout();
                let repeated = loops(&mut layout).nth(at).expect("it is a loop");
                if let Column::Elements(_, rule) = &mut repeated.columns[column] {
                    shift(rule);
                    assert_eq!(check(&program, &layout, COMPONENTS), Err(PROMISE), "column {column}");
                    tried += 1;
                }
            }
            for step in 0..steps {
                let (program, mut layout) = layout();
                let repeated = loops(&mut layout).nth(at).expect("it is a loop");
                if let Kept::Each(_, rule) = &mut repeated.steps[step].kept {
                    shift(rule);
                    assert_eq!(check(&program, &layout, COMPONENTS), Err(PROMISE), "step {step}");
                    tried += 1;
                }
            }
        }
        assert!(tried > 3, "{tried}");
    }

    #[test]
    fn a_variable_that_carries_another_result_is_caught() {
        let (program, mut layout) = layout();
        let mut tried = 0;
        for repeated in loops(&mut layout) {
            for carried in &mut repeated.carried {
                carried.from = (carried.from + 1) % repeated.repetition.length;
                tried += 1;
            }
        }
        assert!(tried > 0);
        assert_eq!(check(&program, &layout, COMPONENTS), Err(PROMISE));
    }

    #[test]
    fn a_partner_of_another_operand_is_caught() {
        let (program, mut layout) = layout();
        for repeated in loops(&mut layout) {
            let length = repeated.repetition.length;
            for (at, step) in repeated.steps.iter_mut().enumerate() {
                step.partner = Some((at + 1) % length);
            }
        }
        assert_eq!(check(&program, &layout, COMPONENTS), Err(PROMISE));
    }
}
