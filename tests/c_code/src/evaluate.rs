//! The programs of a mechanism, evaluated one instruction after the other.

use mbs_codegen::compiled::Input;
use mbs_codegen::{Compiled, FunctionId};
use mbs_runtime::Real;
use mbs_symbolic::{Function, Operand, Operation};

/// A mechanism with its declared parameters, evaluated.
pub struct Evaluator<'a> {
    compiled: &'a Compiled,
    hoisted: Vec<f64>,
}

/// The arguments of a function; empty where they are not given.
#[derive(Clone, Copy, Debug, Default)]
struct Given<'a> {
    t: f64,
    q: &'a [f64],
    v: &'a [f64],
    inputs: &'a [f64],
    gains: [f64; 2],
    feedback: &'a [f64],
    acceleration: &'a [f64],
    multipliers: &'a [f64],
}

impl<'a> Evaluator<'a> {
    /// The mechanism with its declared parameters.
    pub fn new(compiled: &'a Compiled) -> Self {
        let mut evaluator = Self { compiled, hoisted: Vec::new() };
        evaluator.hoisted = evaluator.values(FunctionId::Hoisted, Given::default());
        evaluator
    }

    /// t, q, v, then q̈, λ and the outputs, of a state t, q, v.
    pub fn line(&self, state: &[f64], inputs: &[f64]) -> Vec<f64> {
        let (n, m) = (self.compiled.coordinates.len(), self.compiled.constraints.len());
        let (feedback, at) = (vec![0.0; m], self.at(state, inputs));
        let solved = self.values(FunctionId::Reactions, Given { feedback: &feedback, ..at });
        let (acceleration, multipliers) = solved[..n + m].split_at(n);
        let outputs = self.values(FunctionId::Outputs, Given { acceleration, multipliers, ..at });
        [state, acceleration, multipliers, &outputs].concat()
    }

    /// A step of Heun's method from a state t, q, v to the time `t_next`, with feedback of the gains
    /// (−2α, −β²), held over it or computed in both stages.
    pub fn step(
        &self,
        state: &[f64],
        inputs: &[f64],
        [h, t_next]: [f64; 2],
        gains: [f64; 2],
        is_held: bool,
    ) -> Vec<f64> {
        let (n, m) = (self.compiled.states.len(), self.compiled.constraints.len());
        let all = self.at(state, inputs);
        let states = |all: &[f64]| -> Vec<f64> { self.compiled.states.iter().map(|&at| all[at]).collect() };
        let (q, v) = (states(all.q), states(all.v));
        let at = Given { q: &q, v: &v, ..all };
        let here = self.values(FunctionId::Stabilized, Given { gains, ..at });
        let q_there: Vec<f64> = (0..n).map(|j| q[j] + h * v[j]).collect();
        let v_there: Vec<f64> = (0..n).map(|j| v[j] + h * here[j]).collect();
        let there = Given { t: t_next, q: &q_there, v: &v_there, inputs, ..Given::default() };
        let there = if is_held {
            self.values(FunctionId::Constrained, Given { feedback: &here[n..n + m], ..there })
        } else {
            self.values(FunctionId::Stabilized, Given { gains, ..there })
        };
        let half_h = 0.5 * h;
        let q: Vec<f64> = (0..n).map(|j| q[j] + half_h * (v[j] + v_there[j])).collect();
        let v: Vec<f64> = (0..n).map(|j| v[j] + half_h * (here[j] + there[j])).collect();
        let next = Given { t: t_next, q: &q, v: &v, ..Given::default() };
        [vec![t_next], self.values(FunctionId::Complete, next)].concat()
    }

    /// Takes the samples that are due after so many steps from 0 s on.
    pub fn sample(&self, state: &[f64], inputs: &mut [f64], steps: usize, h: f64) {
        let times = self.values(FunctionId::Clocks, Given::default());
        for (clock, time) in times.chunks(2).enumerate() {
            let [every, offset] = [time[0], time[1]].map(|seconds| (seconds / h).round() as i64);
            if (steps as i64 - offset).rem_euclid(every) != 0 {
                continue;
            }
            let values = self.values(FunctionId::Samples, self.at(state, inputs));
            for (&[of, memory], value) in self.compiled.sampling.samples.iter().zip(values) {
                if of == clock {
                    inputs[memory] = value;
                }
            }
        }
    }

    fn at<'b>(&self, state: &'b [f64], inputs: &'b [f64]) -> Given<'b> {
        let n = self.compiled.coordinates.len();
        Given { t: state[0], q: &state[1..=n], v: &state[n + 1..], inputs, ..Given::default() }
    }

    fn values(&self, function: FunctionId, given: Given<'_>) -> Vec<f64> {
        let program = self.compiled.program(function);
        let mut values: Vec<f64> = Vec::with_capacity(program.instructions.len());
        let read = |operand, values: &[f64]| match operand {
            Operand::Number(number) => number.to_f64(),
            Operand::Symbol(symbol) => self.symbol(self.compiled.input(symbol), given),
            Operand::Hoisted(at) => self.hoisted[at],
            Operand::Value(at) => values[at],
        };
        for instruction in &program.instructions {
            let [a, b] = [instruction.a, instruction.b].map(|operand| read(operand, &values));
            values.push(match instruction.operation {
                // the runtime's own
                Operation::Call(Function::Sin) => Real::sin(a),
                Operation::Call(Function::Cos) => Real::cos(a),
                operation => program.apply(operation, a, b),
            });
        }
        program.outputs.iter().map(|&output| read(output, &values)).collect()
    }

    fn symbol(&self, input: Input, given: Given<'_>) -> f64 {
        match input {
            Input::Time => given.t,
            Input::Parameter(at) => self.compiled.parameters[at].value,
            Input::Input(at) => given.inputs[at],
            Input::Position(at) | Input::StatePosition(at) => given.q[at],
            Input::Velocity(at) | Input::StateVelocity(at) => given.v[at],
            Input::Acceleration(at) => given.acceleration[at],
            Input::Multiplier(at) => given.multipliers[at],
            Input::Feedback(at) => given.feedback[at],
            Input::MinusTwoAlpha => given.gains[0],
            Input::MinusBetaSquared => given.gains[1],
            // of fused steps and of implicit stages alone
            Input::Step
            | Input::HalfStep
            | Input::NextTime
            | Input::Shift
            | Input::Predicted(_)
            | Input::Weight(_) => f64::NAN,
        }
    }
}
