//! The steps of a program on pairs, each when it is first asked for.
//!
//! A pair may be held *plain* or *flipped*, with its second lane negated. A flipped
//! operand lets one instruction add in one lane and subtract in the other, and a
//! product takes over the flip of a factor, so that one flip of a sine and a cosine
//! serves all that is computed from it.

use rustc_hash::FxHashMap as HashMap;

use super::angles::{Angles, Lanes};
use super::kinds::{Kind, Partner, crossings, kind};
use super::layout::Layout;
use super::sines;
use super::steps::{Given, Lane, Scalar, Step};
use super::woven::Woven;
use crate::operators::Function;
use crate::program::{Instruction, Operand, Operation, Program};

/// How far ahead costs are looked at.
const DEPTH: usize = 5;

pub(super) fn weave(
    program: &Program,
    partners: &[Option<Partner>],
    angles: &Angles,
    layout: &Layout<'_>,
) -> Woven {
    let mut weaver = Weaver {
        program,
        partners,
        layout,
        steps: Vec::new(),
        scalars: HashMap::default(),
        pairs: HashMap::default(),
        angles,
        turns: HashMap::default(),
    };
    let outputs = program.outputs.iter().map(|&output| weaver.scalar(output)).collect();
    Woven { steps: weaver.steps, outputs }
}

struct Weaver<'a> {
    program: &'a Program,
    partners: &'a [Option<Partner>],
    layout: &'a Layout<'a>,
    steps: Vec<Step>,
    scalars: HashMap<usize, Scalar>,
    /// The steps of pairs, plain and flipped.
    pairs: HashMap<Lanes, [Option<usize>; 2]>,
    angles: &'a Angles,
    /// The sines of pairs of angles.
    turns: HashMap<Lanes, usize>,
}

impl Weaver<'_> {
    fn push(&mut self, step: Step) -> usize {
        self.steps.push(step);
        self.steps.len() - 1
    }

    fn scalar(&mut self, operand: Operand) -> Scalar {
        let at = match operand {
            Operand::Number(number) => return Scalar::Given(Given::Number(number)),
            Operand::Symbol(symbol) => return Scalar::Given(Given::Symbol(symbol)),
            Operand::Hoisted(at) => return Scalar::Given(Given::Hoisted(at)),
            Operand::Value(at) => at,
        };
        if let Some(&known) = self.scalars.get(&at) {
            return known;
        }
        let instruction = &self.program.instructions[at];
        let scalar = match (self.partners[at], instruction.operation) {
            (Some(Partner { other, lane: Lane::First }), _) => {
                // the first lane is the same in both forms
                let lanes = (operand, Operand::Value(other));
                let flipped = self.pairs.get(&lanes).is_some_and(|[plain, _]| plain.is_none());
                Scalar::Lane(self.pair(lanes, flipped && self.pairs.contains_key(&lanes)), Lane::First)
            }
            (Some(Partner { other, lane: Lane::Second }), _) => {
                Scalar::Lane(self.pair((Operand::Value(other), operand), false), Lane::Second)
            }
            (None, Operation::Call(function)) if function.is_turn() => {
                self.sine_or_cosine(function, instruction.a)
            }
            (None, operation) => {
                let (a, b) = (self.scalar(instruction.a), self.scalar(instruction.b));
                Scalar::Step(self.push(Step::Scalar(operation, a, b, instruction.name.clone())))
            }
        };
        self.scalars.insert(at, scalar);
        scalar
    }

    fn sine_or_cosine(&mut self, function: Function, angle: Operand) -> Scalar {
        let (lanes, lane) = self.angles.get(&angle).copied().unwrap_or(((angle, angle), Lane::First));
        let sines = match self.turns.get(&lanes) {
            Some(&sines) => sines,
            None => {
                let angles = self.pair(lanes, false);
                let sines = sines::push(&mut self.steps, angles);
                self.turns.insert(lanes, sines);
                sines
            }
        };
        Scalar::Lane(if function == Function::Sin { sines } else { sines + 1 }, lane)
    }

    /// The step of a pair, plain or flipped.
    fn pair(&mut self, lanes: Lanes, flipped: bool) -> usize {
        let form = usize::from(flipped);
        let known = self.pairs.get(&lanes).copied().unwrap_or_default();
        if let Some(step) = known[form] {
            return step;
        }
        let step = match known[1 - form] {
            Some(other) => self.push(Step::Flip(other)),
            None => self.new_pair(lanes, flipped),
        };
        self.pairs.entry(lanes).or_default()[form] = Some(step);
        step
    }

    fn new_pair(&mut self, lanes: Lanes, flipped: bool) -> usize {
        let (a, b) = lanes;
        if let Some((x, y)) = self.instructions(lanes).filter(|&(x, _)| !flipped || self.has_sign(x)) {
            return self.operation(x, y, flipped);
        }
        if let (Operand::Number(_), Operand::Number(number)) = lanes
            && flipped
        {
            let (first, negative) = (self.scalar(a), self.scalar(Operand::Number(-number)));
            return self.push(Step::Join(first, negative));
        }
        if flipped {
            let plain = self.pair(lanes, false);
            return self.push(Step::Flip(plain));
        }
        if a == b {
            let scalar = self.scalar(a);
            return self.push(Step::Splat(scalar));
        }
        if self.instructions((b, a)).is_some() {
            let other = self.pair((b, a), false);
            return self.push(Step::Swap(other));
        }
        let (a, b) = (self.scalar(a), self.scalar(b));
        self.push(Step::Join(a, b))
    }

    /// The instructions of a pair that is computed as one, in this order of lanes.
    fn instructions(&self, (a, b): Lanes) -> Option<(usize, usize)> {
        let (Operand::Value(x), Operand::Value(y)) = (a, b) else { return None };
        (self.partners[x] == Some(Partner { other: y, lane: Lane::First })).then_some((x, y))
    }

    /// True if the result is negated with its operands.
    fn has_sign(&self, at: usize) -> bool {
        kind(&self.program.instructions[at]) != Some(Kind::Magnitude)
    }

    fn operation(&mut self, x: usize, y: usize, flipped: bool) -> usize {
        let [x, y] = [x, y].map(|at| &self.program.instructions[at]);
        let (first, others) = forms(x, y, flipped);
        let cost = self.cost_of_form(&first);
        let (_, Form { operation, operands: [a, b] }) =
            others.into_iter().fold((cost, first), |best, form| {
                let cost = self.cost_of_form(&form);
                if cost < best.0 { (cost, form) } else { best }
            });
        let a = self.pair(a.0, a.1);
        let b = self.pair(b.0, b.1);
        self.push(Step::Pair(operation, a, b))
    }

    /// How many moves and flips it takes to have the operands of a form.
    fn cost_of_form(&self, form: &Form) -> u32 {
        form.operands.iter().map(|&(lanes, flipped)| self.moves(lanes) + self.flips(lanes, flipped, 0)).sum()
    }

    /// One if the lanes have to be brought together: a pair that is computed as one
    /// costs what it costs in any case.
    fn moves(&self, lanes: Lanes) -> u32 {
        let is_there = self.pairs.contains_key(&lanes) || self.instructions(lanes).is_some();
        match lanes {
            _ if is_there => 0,
            (Operand::Number(_), Operand::Number(_)) => 0,
            (Operand::Symbol(a), Operand::Symbol(b)) if (self.layout.are_neighbours)(a, b) => 0,
            _ => 1,
        }
    }

    fn flips(&self, lanes: Lanes, flipped: bool, depth: usize) -> u32 {
        let known = self.pairs.get(&lanes).copied().unwrap_or_default();
        match (known[usize::from(flipped)], known[usize::from(!flipped)], self.instructions(lanes)) {
            (Some(_), ..) => 0,
            (_, Some(_), _) => 1,
            (_, _, Some((x, y))) if depth < DEPTH && self.has_sign(x) => {
                let [x, y] = [x, y].map(|at| &self.program.instructions[at]);
                let of_form = |form: &Form| -> u32 {
                    let [a, b] = form.operands;
                    self.flips(a.0, a.1, depth + 1) + self.flips(b.0, b.1, depth + 1)
                };
                let (first, others) = forms(x, y, flipped);
                others.iter().map(of_form).fold(of_form(&first), u32::min)
            }
            _ if matches!(lanes, (Operand::Number(_), Operand::Number(_))) => 0,
            _ => u32::from(flipped),
        }
    }
}

/// A way to compute a pair: on which pairs, and which of them flipped.
struct Form {
    operation: Operation,
    operands: [(Lanes, bool); 2],
}

/// The ways to compute a pair of instructions, itself plain or flipped: the first one, which
/// there always is, and the others.
///
/// With the second lane of a, b and the result negated or not (σ = ±1), a sum
/// a ± b has the second lane σ_a a ± σ_b b: the sign of the result is σ_a, and lanes
/// that add and subtract take σ_b = −σ_a. Products have σ = σ_a σ_b.
fn forms(x: &Instruction, y: &Instruction, flipped: bool) -> (Form, Vec<Form>) {
    let is_mixed = x.operation != y.operation;
    let form = |[a, b]: [Lanes; 2], a_flipped, b_flipped| Form {
        operation: x.operation,
        operands: [(a, a_flipped), (b, b_flipped)],
    };
    let of_alignment = |operands| match x.operation {
        Operation::Mul | Operation::Div => {
            (form(operands, flipped, false), Some(form(operands, !flipped, true)))
        }
        _ => (form(operands, flipped, flipped != is_mixed), None),
    };
    let (first, more) = of_alignment([(x.a, y.a), (x.b, y.b)]);
    let others = crossings(x, y).map(of_alignment).flat_map(|(form, more)| std::iter::once(form).chain(more));
    (first, more.into_iter().chain(others).collect())
}
