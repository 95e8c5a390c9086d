//! A long program as it is written, run: blocks in their order, copies one after the other,
//! operands from where loops and functions read them, results kept where they are kept. It
//! has to give what the program does, at numbers without any relation, bit for bit.

use std::collections::HashMap;

use mbs_symbolic::{Block, Inconsistency, Operand, Operation, Program, Repetition, Source, probe};

use super::columns::Rule;
use super::slots::{Kept, Kind, Place, Slots};

/// What a layout promises.
const PROMISE: Inconsistency =
    Inconsistency { pass: "long", rule: "loops and slots compute what the program does" };

/// The layout gives what the program does.
///
/// # Errors
/// It does not.
pub fn check(program: &Program, blocks: &[Block], slots: &Slots) -> Result<(), Inconsistency> {
    compare(program, program, blocks, slots)
}

/// What is written gives what is expected.
fn compare(
    expected: &Program,
    written: &Program,
    blocks: &[Block],
    slots: &Slots,
) -> Result<(), Inconsistency> {
    for point in 0..probe::POINTS {
        let (symbol, hoisted) = (probe::symbol(point), probe::hoisted(point));
        let given = |operand| match operand {
            Operand::Number(number) => Some(number.to_f64()),
            Operand::Symbol(input) => Some(symbol(input)),
            Operand::Hoisted(at) => Some(hoisted(at)),
            Operand::Value(_) => None,
        };
        let mut run = Run { program: written, slots, given: &given, kept: HashMap::new() };
        for block in blocks {
            run.block(block).ok_or(PROMISE)?;
        }
        let values = expected.evaluate_with(&symbol, &hoisted);
        for (&output, value) in written.outputs.iter().zip(values) {
            let found = run.outside(output).ok_or(PROMISE)?;
            if found.to_bits() != value.to_bits() && !(found.is_nan() && value.is_nan()) {
                return Err(PROMISE);
            }
        }
    }
    Ok(())
}

struct Run<'a> {
    program: &'a Program,
    slots: &'a Slots,
    given: &'a dyn Fn(Operand) -> Option<f64>,
    /// What the arrays hold.
    kept: HashMap<(Kind, usize), f64>,
}

/// `None` where an operand is not there.
impl Run<'_> {
    /// An operand that is not computed in the function at hand.
    fn outside(&self, operand: Operand) -> Option<f64> {
        match operand {
            Operand::Value(value) => self.read(self.slots.of(value)?),
            other => (self.given)(other),
        }
    }

    fn read(&self, Place { array, at }: Place) -> Option<f64> {
        self.kept.get(&(array, at)).copied()
    }

    fn apply(&self, at: usize, a: f64, b: f64) -> f64 {
        let operation: Operation = self.program.instructions[at].operation;
        self.program.apply(operation, a, b)
    }

    fn block(&mut self, block: &Block) -> Option<()> {
        match block {
            Block::Straight(range) => {
                let mut results: HashMap<usize, f64> = HashMap::new();
                for at in range.clone() {
                    let instruction = &self.program.instructions[at];
                    let read = |operand| match operand {
                        Operand::Value(value) if range.contains(&value) => results.get(&value).copied(),
                        other => self.outside(other),
                    };
                    let result = self.apply(at, read(instruction.a)?, read(instruction.b)?);
                    results.insert(at, result);
                }
                for (at, result) in results {
                    if let Some(Place { array, at }) = self.slots.of(at) {
                        self.kept.insert((array, at), result);
                    }
                }
                Some(())
            }
            Block::Repeated(repetition) => self.repetition(*repetition),
        }
    }

    fn repetition(&mut self, repetition: Repetition) -> Option<()> {
        let Repetition { start, length, count } = repetition;
        let sources: Vec<[Source; 2]> = (0..length).map(|at| repetition.sources(self.program, at)).collect();
        let keeping: Vec<Keeping> = (0..length).map(|at| Keeping::of(self.slots, &repetition, at)).collect();
        let mut columns = Columns::default();
        let feeds: Vec<[Feed; 2]> = sources
            .iter()
            .map(|[a, b]| Some([self.feed(a, &mut columns)?, self.feed(b, &mut columns)?]))
            .collect::<Option<_>>()?;
        let mut results = vec![f64::NAN; length];
        for copy in 0..count {
            // an operand of a copy is read when it is first needed, and held
            let mut held: Vec<Option<f64>> = vec![None; columns.list.len()];
            let before = std::mem::replace(&mut results, vec![f64::NAN; length]);
            for (at, feeds) in feeds.iter().enumerate() {
                let mut operands = [f64::NAN; 2];
                for (operand, feed) in operands.iter_mut().zip(feeds) {
                    *operand = match *feed {
                        Feed::Same(same) => self.outside(same)?,
                        Feed::Own(own) => results[own],
                        Feed::Carried(_, first) if copy == 0 => first,
                        Feed::Carried(from, _) => before[from],
                        Feed::Each(column) => match held[column] {
                            Some(value) => value,
                            None => *held[column].insert(self.each(&columns.list[column], copy)?),
                        },
                    };
                }
                results[at] = self.apply(start + at, operands[0], operands[1]);
                if let Keeping::Each(array, rule) = &keeping[at] {
                    self.kept.insert((*array, rule.at(copy)), results[at]);
                }
            }
        }
        for (keeping, result) in keeping.iter().zip(results) {
            if let Keeping::Last(Place { array, at }) = keeping {
                self.kept.insert((*array, *at), result);
            }
        }
        Some(())
    }

    fn feed<'s>(&self, source: &'s Source, columns: &mut Columns<'s>) -> Option<Feed> {
        Some(match source {
            Source::Same(same) => Feed::Same(*same),
            Source::Own(own) => Feed::Own(*own),
            Source::Carried(from, first) => Feed::Carried(*from, self.outside(*first)?),
            Source::Each(operands) => match columns.known.get(source) {
                Some(&column) => Feed::Each(column),
                None => {
                    columns.list.push(Column::of(self.slots, operands)?);
                    columns.known.insert(source, columns.list.len() - 1);
                    Feed::Each(columns.list.len() - 1)
                }
            },
        })
    }

    /// What a column has for a copy.
    fn each(&self, column: &Column<'_>, copy: usize) -> Option<f64> {
        match column {
            Column::Kept(array, rule) => self.read(Place { array: *array, at: rule.at(copy) }),
            Column::Given(operands) => (self.given)(operands[copy]),
        }
    }
}

/// What an instruction of a loop gets as an operand.
enum Feed {
    Same(Operand),
    Own(usize),
    /// A result of the copy before, and the value in the first one.
    Carried(usize, f64),
    /// The position of a column.
    Each(usize),
}

/// The operands that are others in every copy, each once.
#[derive(Default)]
struct Columns<'s> {
    list: Vec<Column<'s>>,
    known: HashMap<&'s Source, usize>,
}

/// Where the copies of a loop find an operand that is another one each time.
enum Column<'s> {
    Kept(Kind, Rule),
    /// Numbers, hoisted values, and components of vectors, which nothing overwrites.
    Given(&'s [Operand]),
}

impl<'s> Column<'s> {
    fn of(slots: &Slots, operands: &'s [Operand]) -> Option<Self> {
        let places = operands.iter().map(|operand| match operand {
            Operand::Value(value) => slots.of(*value),
            _ => None,
        });
        match places.collect::<Option<Vec<Place>>>() {
            Some(places) => {
                let array = places.first()?.array;
                let is_one = places.iter().all(|place| place.array == array);
                is_one.then(|| Self::Kept(array, Rule::of(places.iter().map(|place| place.at).collect())))
            }
            None => operands.iter().all(|o| !matches!(o, Operand::Value(_))).then_some(Self::Given(operands)),
        }
    }
}

/// Which results of the copies of an instruction are kept.
enum Keeping {
    No,
    Last(Place),
    Each(Kind, Rule),
}

impl Keeping {
    fn of(slots: &Slots, repetition: &Repetition, at: usize) -> Self {
        match slots.of_copies(repetition, repetition.start + at) {
            Kept::No => Self::No,
            Kept::Last(place) => Self::Last(place),
            Kept::Each(array, places) => Self::Each(array, Rule::of(places)),
        }
    }
}

#[cfg(test)]
#[allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]
mod tests {
    use mbs_symbolic::{Arena, Function, Stage, lower_whole};

    use super::*;

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
        let total = links.iter().map(|&link| (link, mbs_symbolic::Number::ONE)).collect::<Vec<_>>();
        let sum = arena.sum(&total);
        let program = lower_whole(&mut arena, &[sum, last], 0).expect("a program");
        let blocks = program.blocks(&|_| 0);
        (program, blocks)
    }

    #[test]
    fn an_operand_that_was_taken_for_another_is_caught() {
        let (program, blocks) = chain();
        assert!(blocks.iter().any(|block| matches!(block, Block::Repeated(_))));
        let slots = Slots::new(&program, &blocks, &[]);
        assert_eq!(check(&program, &blocks, &slots), Ok(()));
        let mut tried = 0;
        for at in 0..program.instructions.len() {
            let mut wrong = program.clone();
            let Operand::Value(value @ 1..) = wrong.instructions[at].a else { continue };
            wrong.instructions[at].a = Operand::Value(value - 1);
            let slots = Slots::new(&wrong, &blocks, &[]);
            assert_eq!(compare(&program, &wrong, &blocks, &slots), Err(PROMISE), "instruction {at}");
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
        assert_eq!(check(&program, &blocks, &slots), Err(PROMISE));
    }

    #[test]
    fn blocks_in_another_order_are_caught() {
        let (program, mut blocks) = chain();
        let slots = Slots::new(&program, &blocks, &[]);
        blocks.reverse();
        assert_eq!(check(&program, &blocks, &slots), Err(PROMISE));
    }
}
