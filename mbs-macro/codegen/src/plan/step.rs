//! A whole step of the declared scheme as one program.
//!
//! # How it works
//!
//! The program of a step is that of its stages, instruction by instruction. A value that several stages have
//! in common is computed once. Operations and operands are those of the stages, so results agree to the bit
//! (`tests/tests/solutions/fused_step.rs`). A step of more than 3072 instructions is left in stages.
//!
//! A second pair of programs also gives the reactions at the start, without feedback: one more solution with
//! the same factorization. In Rust these are generic functions, compiled where they are used.

use mbs_interface::Row;
use mbs_symbolic::{Inconsistency, Instruction, Number, Operand, Operation, Program, Symbol, probe};
use rustc_hash::FxHashMap as HashMap;

use crate::inputs::{Input, Inputs, State};
use crate::model::Model;

/// Longer steps are left in stages: rustc nests a scope per statement, and its
/// stack ends at about twice as many.
const LONGEST: usize = 3072;

/// The steps of a mechanism that is small enough.
pub struct FusedStep {
    /// That give the state after a step.
    pub alone: Kinds,
    /// That also give the reactions at their start.
    pub with_reactions: Option<Kinds>,
}

/// The programs of a step with each kind of feedback: q⁺, v⁺ and the growths of all stages,
/// added; with reactions q⁺, v⁺, q̈, λ, the growth, and that of the reactions.
pub struct Kinds<P = Program> {
    /// All stages are given the feedback of the first.
    pub held: P,
    /// Each stage has its own.
    pub per_stage: P,
}

/// The programs of a mechanism that a step is made of, all of the coordinates that are
/// integrated.
#[derive(Clone, Copy)]
pub struct Stages<'a> {
    pub stabilized: &'a Program,
    pub constrained: &'a Program,
    /// It gives q̈ of all coordinates.
    pub reactions: &'a Program,
}

/// The fused step of a mechanism that is small enough.
///
/// # Errors
/// A step that does not compute what its stages do.
pub fn fused(model: &Model, inputs: &Inputs, stages: Stages<'_>) -> Result<Option<FusedStep>, Inconsistency> {
    // constraints give the whole motion
    if inputs.states.is_empty() {
        return Ok(None);
    }
    let Some(alone) = kinds(model, inputs, stages, None)? else { return Ok(None) };
    let with_reactions = kinds(model, inputs, stages, Some(stages.reactions))?;
    Ok(Some(FusedStep { alone, with_reactions }))
}

fn kinds(
    model: &Model,
    inputs: &Inputs,
    stages: Stages<'_>,
    reactions: Option<&Program>,
) -> Result<Option<Kinds>, Inconsistency> {
    let Stages { stabilized, constrained, .. } = stages;
    if stabilized.instructions.len() > LONGEST {
        return Ok(None);
    }
    let [held, per_stage] =
        [constrained, stabilized].map(|second| step(model, inputs, stabilized, second, reactions));
    if held.instructions.len().max(per_stage.instructions.len()) > LONGEST {
        return Ok(None);
    }
    check(model, inputs, [stabilized, constrained], reactions, &held)?;
    check(model, inputs, [stabilized, stabilized], reactions, &per_stage)?;
    Ok(Some(Kinds { held, per_stage }))
}

/// A step gives what its stages give one after the other, with numbers without any relation
/// for all that it depends on: bit for bit but for the sign of a zero. A result that is not finite
/// tells nothing: there a step is made again in stages.
fn check(
    model: &Model,
    inputs: &Inputs,
    [first, second]: [&Program; 2],
    reactions: Option<&Program>,
    step: &Program,
) -> Result<(), Inconsistency> {
    for point in 0..probe::POINTS {
        let expected = in_stages(model, inputs, [first, second], reactions, point);
        let found = step.evaluate_with(&probe::symbol(point), &probe::hoisted(point));
        let is_same = |(x, y): (&f64, &f64)| !x.is_finite() || x == y;
        if found.len() != expected.len() || !expected.iter().zip(&found).all(is_same) {
            return Err(Inconsistency { pass: "fused step", rule: "a step computes what its stages do" });
        }
    }
    Ok(())
}

/// A share of the step.
fn in_steps(share: f64, h: f64, half_h: f64) -> f64 {
    if share == 0.5 { half_h } else { share * h }
}

/// The results of [`step`], from the programs of the stages.
fn in_stages(
    model: &Model,
    inputs: &Inputs,
    [first, second]: [&Program; 2],
    reactions: Option<&Program>,
    point: u64,
) -> Vec<f64> {
    let (n, m) = (inputs.states.len(), model.constraints.len());
    let (given, hoisted) = (probe::symbol(point), probe::hoisted(point));
    let [t, h, half_h, t_next] = [inputs.time, inputs.step, inputs.half_step, inputs.next_time].map(&given);
    let [q, v] = [|state: &State| state.position, |state: &State| state.velocity]
        .map(|symbol| inputs.states.iter().map(|state| given(symbol(state))).collect::<Vec<f64>>());
    // x₀ + (share · h) Σ w k, as the runtime computes it
    let combine = |row: &Row, x: f64, slopes: &dyn Fn(usize) -> f64| {
        let terms = row.terms().map(|(stage, weight)| weight * slopes(stage));
        x + in_steps(row.share, h, half_h) * terms.reduce(|sum, term| sum + term).unwrap_or(f64::NAN)
    };
    let scheme = model.solver.scheme();
    let mut velocities = vec![v.clone()];
    let mut solved = vec![first.evaluate_with(&given, &hoisted)];
    for row in scheme.stages {
        let node = row.node();
        let time = if node == 1.0 { t_next } else { t + in_steps(node, h, half_h) };
        let predicted: Vec<f64> = (0..n).map(|at| combine(row, v[at], &|stage| solved[stage][at])).collect();
        let there = |symbol: Symbol| match inputs.of(symbol) {
            Some(Input::Position(at) | Input::StatePosition(at)) => {
                combine(row, q[at], &|stage| velocities[stage][at])
            }
            Some(Input::Velocity(at) | Input::StateVelocity(at)) => predicted[at],
            Some(Input::Time) => time,
            Some(Input::Feedback(row)) => solved[0][n + row],
            _ => given(symbol),
        };
        let next = second.evaluate_with(&there, &hoisted);
        velocities.push(predicted);
        solved.push(next);
    }
    let without_feedback = |symbol: Symbol| match inputs.of(symbol) {
        Some(Input::Feedback(_)) => 0.0,
        _ => given(symbol),
    };
    let clean = reactions.map(|reactions| reactions.evaluate_with(&without_feedback, &hoisted));
    let end = |x: f64, slopes: &dyn Fn(usize) -> f64| combine(&scheme.update, x, slopes);
    let mut results: Vec<f64> = (0..n).map(|at| end(q[at], &|stage| velocities[stage][at])).collect();
    results.extend((0..n).map(|at| end(v[at], &|stage| solved[stage][at])));
    results.extend(clean.iter().flat_map(|clean| &clean[..model.coordinates.len() + m]));
    results
        .extend(solved.iter().filter_map(|stage| stage.last().copied()).reduce(|sum, growth| sum + growth));
    results.extend(clean.iter().flat_map(|clean| clean.last()));
    results
}

/// q⁺, v⁺ and the growth, with stages behind the first one that are given its feedback, or
/// compute their own. With reactions: q⁺, v⁺, q̈, λ, the growth, and that of
/// the reactions.
fn step(
    model: &Model,
    inputs: &Inputs,
    first: &Program,
    second: &Program,
    reactions: Option<&Program>,
) -> Program {
    let (n, m) = (inputs.states.len(), model.constraints.len());
    let q: Vec<Operand> = inputs.states.iter().map(|state| Operand::Symbol(state.position)).collect();
    let v: Vec<Operand> = inputs.states.iter().map(|state| Operand::Symbol(state.velocity)).collect();
    let scheme = model.solver.scheme();
    let mut steps = Fusion::default();
    let mut velocities = vec![v.clone()];
    let mut solved = vec![steps.append(first, &HashMap::default())];
    let held: HashMap<Symbol, Operand> =
        inputs.feedback.iter().copied().zip(solved[0][n..n + m].iter().copied()).collect();
    for row in scheme.stages {
        let mut stage = held.clone();
        let mut predicted = Vec::new();
        for (at, state) in inputs.states.iter().enumerate() {
            let position = steps.combine(inputs, row, q[at], &|stage| velocities[stage][at]);
            let velocity = steps.combine(inputs, row, v[at], &|stage| solved[stage][at]);
            stage.extend([(state.position, position), (state.velocity, velocity)]);
            predicted.push(velocity);
        }
        stage.insert(inputs.time, steps.time(inputs, row.node()));
        let there = steps.append(second, &stage);
        velocities.push(predicted);
        solved.push(there);
    }
    // Without feedback; what agrees with the first stage is there already.
    let zero = Operand::Number(Number::ZERO);
    let none = inputs.feedback.iter().map(|&symbol| (symbol, zero)).collect();
    let clean = reactions.map(|reactions| steps.append(reactions, &none));

    let mut outputs = Vec::new();
    for at in 0..n {
        outputs.push(steps.combine(inputs, &scheme.update, q[at], &|stage| velocities[stage][at]));
    }
    for at in 0..n {
        outputs.push(steps.combine(inputs, &scheme.update, v[at], &|stage| solved[stage][at]));
    }
    outputs.extend(clean.iter().flat_map(|clean| &clean[..model.coordinates.len() + m]));
    let growths = solved.iter().filter_map(|stage| stage.last().copied());
    outputs.extend(growths.reduce(|sum, growth| steps.push(Operation::Add, sum, growth, None)));
    outputs.extend(clean.iter().filter_map(|clean| clean.last()));
    Program { outputs, splines: first.splines.clone(), ..steps.into() }.without_dead_code()
}

fn number(value: f64) -> Operand {
    Operand::Number(Number::float(value))
}

/// Instructions one after the other, none of them twice.
#[derive(Default)]
struct Fusion {
    instructions: Vec<Instruction>,
    known: HashMap<(Operation, Operand, Operand), Operand>,
}

impl From<Fusion> for Program {
    fn from(fusion: Fusion) -> Self {
        Self { instructions: fusion.instructions, ..Self::default() }
    }
}

impl Fusion {
    fn push(&mut self, operation: Operation, a: Operand, b: Operand, name: Option<String>) -> Operand {
        if let Some(known) = self.without_zero(operation, a, b) {
            return known;
        }
        *self.known.entry((operation, a, b)).or_insert_with(|| {
            self.instructions.push(Instruction { operation, a, b, name });
            Operand::Value(self.instructions.len() - 1)
        })
    }

    /// The rest of an operation on the zero that stands for feedback. Where all is finite, the result
    /// is the same up to the sign of a zero. A number that is not finite shows in the first stage, which
    /// has the feedback in this place.
    fn without_zero(&mut self, operation: Operation, a: Operand, b: Operand) -> Option<Operand> {
        let is_zero = |operand| matches!(operand, Operand::Number(number) if number == Number::ZERO);
        match (operation, is_zero(a), is_zero(b)) {
            (Operation::Add, true, _) => Some(b),
            (Operation::Add | Operation::Sub, _, true) => Some(a),
            (Operation::Sub, true, _) => Some(self.push(Operation::Neg, b, b, None)),
            (Operation::Mul, true, _) | (Operation::Mul, _, true) => Some(Operand::Number(Number::ZERO)),
            (Operation::Div | Operation::Neg, true, _) => Some(a),
            _ => None,
        }
    }

    /// x + (share · h) Σ w k
    fn combine(
        &mut self,
        inputs: &Inputs,
        row: &Row,
        x: Operand,
        slopes: &dyn Fn(usize) -> Operand,
    ) -> Operand {
        let mut sum = None;
        for (stage, weight) in row.terms() {
            let slope = slopes(stage);
            let term =
                if weight == 1.0 { slope } else { self.push(Operation::Mul, number(weight), slope, None) };
            sum = Some(match sum {
                None => term,
                Some(sum) => self.push(Operation::Add, sum, term, None),
            });
        }
        let Some(sum) = sum else { return x };
        let factor = self.in_steps(inputs, row.share);
        let product = self.push(Operation::Mul, factor, sum, None);
        self.push(Operation::Add, x, product, None)
    }

    /// A share of the step.
    fn in_steps(&mut self, inputs: &Inputs, share: f64) -> Operand {
        let [h, half_h] = [inputs.step, inputs.half_step].map(Operand::Symbol);
        match share {
            1.0 => h,
            0.5 => half_h,
            share => self.push(Operation::Mul, number(share), h, None),
        }
    }

    /// The time of a stage, a share `node` of the step behind the start.
    fn time(&mut self, inputs: &Inputs, node: f64) -> Operand {
        if node == 1.0 {
            return Operand::Symbol(inputs.next_time);
        }
        let behind = self.in_steps(inputs, node);
        self.push(Operation::Add, Operand::Symbol(inputs.time), behind, None)
    }

    /// Appends a program with these values for its symbols; its outputs.
    fn append(&mut self, program: &Program, symbols: &HashMap<Symbol, Operand>) -> Vec<Operand> {
        let mut values: Vec<Operand> = Vec::with_capacity(program.instructions.len());
        let read = |operand: Operand, values: &[Operand]| match operand {
            Operand::Symbol(symbol) => symbols.get(&symbol).copied().unwrap_or(operand),
            Operand::Value(at) => values[at],
            _ => operand,
        };
        for instruction in &program.instructions {
            let (a, b) = (read(instruction.a, &values), read(instruction.b, &values));
            values.push(self.push(instruction.operation, a, b, instruction.name.clone()));
        }
        program.outputs.iter().map(|&output| read(output, &values)).collect()
    }
}

#[cfg(test)]
mod tests {
    use mbs_interface::FunctionId;

    use super::{Program, check, step};
    use crate::validate::planned::{DECLARATION, Planned, corrupted, needed};

    /// With and without reactions, with both kinds of feedback.
    #[test]
    fn every_wrong_instruction_of_a_fused_step_is_caught() {
        let planned = Planned::new(DECLARATION);
        let (model, plan) = (&planned.model, &planned.plan);
        let first = &plan.programs[FunctionId::Stabilized];
        for second in [&plan.programs[FunctionId::Constrained], &plan.programs[FunctionId::Stabilized]] {
            for reactions in [None, Some(&plan.programs[FunctionId::Reactions])] {
                let right = step(model, &plan.inputs, first, second, reactions);
                let is_accepted =
                    |step: &Program| check(model, &plan.inputs, [first, second], reactions, step).is_ok();
                assert!(is_accepted(&right));
                let mut tried = 0;
                for at in needed(&right, true) {
                    let mut wrong = right.clone();
                    let Some(operation) = corrupted(wrong.instructions[at].operation) else { continue };
                    wrong.instructions[at].operation = operation;
                    assert!(!is_accepted(&wrong), "instruction {at}: {:?}", right.instructions[at]);
                    tried += 1;
                }
                assert!(tried > 100, "{tried}");
            }
        }
    }
}
