//! A copy of a loop on pairs.
//!
//! The two ends of a chain are mostly the lanes of a vector. So are the variables that a copy hands to the
//! next one.

use super::{Carried, Kept, Loop, Read};
use crate::arena::Symbol;
use crate::inconsistency::Inconsistency;
use crate::pairs::{self, Given, Lane, Scalar, Woven, is_sine_or_cosine, kind};
use crate::program::{Instruction, Operand, Program};

/// A loop is woven if at most so many of eight operations are left. Where pairs save less, moving
/// lanes takes longer than they save: the way back through a chain of 40 rods took 1.4 times as
/// long on pairs, with 32 operations in place of 34.
const OF_EIGHT: usize = 7;

/// A copy of a loop as steps on pairs.
///
/// A copy reads all of its columns before it stores anything.
pub struct WovenCopy {
    /// The operands that the copy is given: the symbols of its steps are positions in this list.
    pub given: Vec<Read>,
    /// The steps. The first outputs are what the [carried](Loop::carried) variables take for the
    /// next copy, in their order; then come the results of `kept`.
    pub woven: Woven,
    /// The steps of the loop whose results are stored.
    pub kept: Vec<usize>,
    /// Carried variables that are the two lanes of a vector, by position.
    pub together: Vec<[usize; 2]>,
}

impl<V> Loop<V> {
    /// A copy as steps on pairs. Nothing is returned if pairs save less than an eighth of its
    /// operations, if it takes sines, because those of pairs have a bounded range, or if it reads
    /// from a column what it has stored itself.
    ///
    /// # Errors
    /// The pairs do not compute what the copy does.
    pub fn woven(&self, program: &Program) -> Result<Option<WovenCopy>, Inconsistency> {
        let copy = Body::new(self, program);
        if copy.program.instructions.iter().any(is_sine_or_cosine) || self.reads_what_it_stores(program) {
            return Ok(None);
        }
        // The gain of a pair depends on which carried variables are lanes of a vector, and that shows
        // only when the pairs are chosen. So the first try takes all that could be lanes for such, and
        // every later one those that became lanes in the try before.
        let mut best = copy.weave(&|a, b| copy.are_alike(a, b));
        loop {
            let next = copy.weave(&|a, b| best.are_together(a, b));
            // fewer operations every time
            if copy.operations(&next) >= copy.operations(&best) {
                break;
            }
            best = next;
        }
        if 8 * copy.operations(&best) > OF_EIGHT * copy.program.instructions.len() {
            return Ok(None);
        }
        best.woven.check(&copy.program)?;
        let Tried { woven, together } = best;
        Ok(Some(WovenCopy { given: copy.given, woven, kept: copy.kept, together }))
    }

    /// True if a column has a result of the copy that reads it.
    fn reads_what_it_stores(&self, program: &Program) -> bool {
        let length = self.repetition.length;
        self.repetition.range().any(|at| {
            let offset = (at - self.repetition.start) % length;
            let begin_of_copy = at - offset;
            let Instruction { a, b, .. } = program.instructions[at];
            [a, b].iter().zip(self.steps[offset].operands).any(|(operand, read)| {
                let is_own = matches!(*operand, Operand::Value(value) if value >= begin_of_copy);
                is_own && matches!(read, Read::Each(_))
            })
        })
    }
}

/// A copy of a loop as a program of its own.
struct Body<'a> {
    program: Program,
    given: Vec<Read>,
    kept: Vec<usize>,
    carried: &'a [Carried],
}

/// Pairs that are tried.
struct Tried {
    woven: Woven,
    together: Vec<[usize; 2]>,
}

impl Tried {
    fn are_together(&self, a: usize, b: usize) -> bool {
        self.together.contains(&[a, b])
    }
}

impl<'a> Body<'a> {
    fn new<V>(repeated: &'a Loop<V>, program: &Program) -> Self {
        let mut given: Vec<Read> = Vec::new();
        let mut operand = |read: Read| match read {
            Read::Own(at) => Operand::Value(at),
            Read::Same(operand @ (Operand::Number(_) | Operand::Hoisted(_))) => operand,
            Read::Same(_) | Read::Carried(_) | Read::Each(_) => {
                let known = given.iter().position(|&known| known == read);
                let at = known.unwrap_or_else(|| {
                    given.push(read);
                    given.len() - 1
                });
                Operand::Symbol(Symbol(at as u32))
            }
        };
        let Loop { repetition, steps, carried, .. } = repeated;
        let originals = &program.instructions[repetition.start..];
        let instructions = steps.iter().zip(originals).map(|(step, original)| {
            let [a, b] = step.operands.map(&mut operand);
            Instruction { operation: original.operation, a, b, name: None }
        });
        let instructions = instructions.collect();
        let kept: Vec<usize> = (0..steps.len()).filter(|&at| steps[at].kept != Kept::No).collect();
        let outputs = carried.iter().map(|carried| carried.from).chain(kept.iter().copied());
        let outputs = outputs.map(Operand::Value).collect();
        let program = Program { instructions, outputs, splines: program.splines.clone() };
        Self { program, given, kept, carried }
    }

    /// The pairs that are best if these carried variables are lanes of a vector.
    fn weave(&self, are_together: &dyn Fn(usize, usize) -> bool) -> Tried {
        let are_neighbours = |a: Symbol, b: Symbol| {
            self.carried(a).zip(self.carried(b)).is_some_and(|(a, b)| are_together(a, b))
        };
        let woven = pairs::weave(
            &self.program,
            &pairs::Layout {
                are_neighbours: &are_neighbours,
                are_written_together: &|_, _| false,
                is_constant: &|symbol| self.is_constant(symbol),
                carried: &|symbol| self.carried(symbol),
            },
        );
        let together = lanes(&woven.outputs[..self.carried.len()]);
        Tried { woven, together }
    }

    /// True if two carried variables could be the lanes of a vector: what gives them is of one kind.
    fn are_alike(&self, a: usize, b: usize) -> bool {
        let [a, b] = [a, b].map(|at| kind(&self.program.instructions[self.carried[at].from]));
        a.is_some() && a == b
    }

    /// How many operations a copy does. Joins of constants are done before the loop, and carried
    /// variables that are together need none.
    fn operations(&self, tried: &Tried) -> usize {
        let is_constant = |scalar: &Scalar| match *scalar {
            Scalar::Given(Given::Symbol(symbol)) => self.is_constant(symbol),
            Scalar::Given(_) => true,
            Scalar::Step(_) | Scalar::Lane(..) => false,
        };
        let carried = |scalar: &Scalar| match *scalar {
            Scalar::Given(Given::Symbol(symbol)) => self.carried(symbol),
            _ => None,
        };
        let is_there = |step: &pairs::Step| match step {
            pairs::Step::Splat(a) => is_constant(a),
            pairs::Step::Join(a, b) => {
                is_constant(a) && is_constant(b)
                    || carried(a).zip(carried(b)).is_some_and(|(a, b)| tried.are_together(a, b))
            }
            _ => false,
        };
        tried.woven.steps.iter().filter(|step| !is_there(step)).count()
    }

    fn carried(&self, symbol: Symbol) -> Option<usize> {
        match self.given[symbol.index()] {
            Read::Carried(at) => Some(at),
            Read::Same(_) | Read::Own(_) | Read::Each(_) => None,
        }
    }

    fn is_constant(&self, symbol: Symbol) -> bool {
        matches!(self.given[symbol.index()], Read::Same(_))
    }
}

/// The positions of outputs that are the first and the second lane of one pair.
fn lanes(outputs: &[Scalar]) -> Vec<[usize; 2]> {
    let second = |step: usize| outputs.iter().position(|output| *output == Scalar::Lane(step, Lane::Second));
    let firsts = outputs.iter().enumerate().filter_map(|(at, output)| match *output {
        Scalar::Lane(step, Lane::First) => Some([at, second(step)?]),
        _ => None,
    });
    firsts.collect()
}
