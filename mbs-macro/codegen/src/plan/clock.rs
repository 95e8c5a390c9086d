//! Functions of time in a fused step, apart from it.
//!
//! A function of time and parameters alone, as the sine of a crank's prescribed angle, has at the
//! end of a step the value that it has at the start of the next one. Many steps in a row need it
//! once for each step.
//!
//! Ensembles use this. A single run would not gain, since its sines are computed two at a time anyway.

use mbs_symbolic::{Inconsistency, Operand, Program, probe};
use rustc_hash::FxHashMap as HashMap;

use super::step::{Fusion, Kinds};
use crate::inputs::{Input, Inputs};
use crate::model::Model;

/// A fused step without the functions of time that it needs at its ends.
pub struct Clocked {
    /// These functions, of [`Input::Time`].
    pub clock: Program,
    /// The steps, given their values as [`Input::Clock`].
    pub step: Kinds,
}

/// An end of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Now,
    Next,
}

/// A value of a step that depends on parameters and one end's time alone.
#[derive(Clone, Copy)]
struct Timed {
    /// The same in the program of the clock.
    value: Operand,
    /// The end whose time it depends on; `None` where it depends on parameters alone.
    end: Option<End>,
}

/// The steps with a clock; `None` where no function of time is needed at the end of one.
///
/// # Errors
/// A step that computes something else with a clock.
pub fn clocked(
    model: &mut Model,
    inputs: &mut Inputs,
    step: &Kinds,
) -> Result<Option<Clocked>, Inconsistency> {
    let mut clock = Clock::default();
    let found = [&step.held, &step.per_stage].map(|program| clock.functions(inputs, program));
    if !found.iter().flatten().any(|function| function.end == End::Next) {
        return Ok(None);
    }
    let Clock { steps, functions } = clock;
    let symbols = inputs.add_clock(model, functions.len());
    let clock = Program { outputs: functions, splines: step.held.splines.clone(), ..steps.into() };
    let [of_held, of_per_stage] = found;
    let (now, next) = symbols.split_at(symbols.len() / 2);
    let reading = |program: &Program, functions: &[Function]| {
        let given = functions.iter().map(|function| {
            let symbols = if function.end == End::Now { now } else { next };
            (function.instruction, Operand::Symbol(symbols[function.at]))
        });
        with_given(program, &given.collect())
    };
    let held = reading(&step.held, &of_held);
    let per_stage = reading(&step.per_stage, &of_per_stage);
    check(inputs, &clock, &step.held, &held)?;
    check(inputs, &clock, &step.per_stage, &per_stage)?;
    Ok(Some(Clocked { clock, step: Kinds { held, per_stage } }))
}

/// A function of time in a program.
struct Function {
    instruction: usize,
    /// Which one of the clock.
    at: usize,
    end: End,
}

/// The program of a clock in the making.
#[derive(Default)]
struct Clock {
    steps: Fusion,
    functions: Vec<Operand>,
}

impl Clock {
    /// The functions of one end's time in a program.
    fn functions(&mut self, inputs: &Inputs, program: &Program) -> Vec<Function> {
        let mut timed: Vec<Option<Timed>> = Vec::with_capacity(program.instructions.len());
        let mut functions = Vec::new();
        for (at, instruction) in program.instructions.iter().enumerate() {
            let read = |operand| timed_operand(inputs, &timed, operand);
            let both = read(instruction.a).zip(read(instruction.b)).and_then(|(a, b)| {
                let is_of_one = a.end.is_none() || b.end.is_none() || a.end == b.end;
                is_of_one.then_some((a, b))
            });
            let value = both.map(|(a, b)| Timed {
                value: self.steps.push(instruction.operation, a.value, b.value, instruction.name.clone()),
                end: a.end.or(b.end),
            });
            if let Some(Timed { value, end: Some(end) }) = value
                && instruction.operation.is_function()
            {
                functions.push(Function { instruction: at, at: self.place(value), end });
            }
            timed.push(value);
        }
        functions
    }

    /// Which function of the clock a value is.
    fn place(&mut self, value: Operand) -> usize {
        let known = self.functions.iter().position(|function| *function == value);
        known.unwrap_or_else(|| {
            self.functions.push(value);
            self.functions.len() - 1
        })
    }
}

fn timed_operand(inputs: &Inputs, timed: &[Option<Timed>], operand: Operand) -> Option<Timed> {
    let of = |value, end| Some(Timed { value, end });
    match operand {
        Operand::Number(_) | Operand::Hoisted(_) => of(operand, None),
        Operand::Value(at) => timed[at],
        Operand::Symbol(symbol) => match inputs.of(symbol) {
            Some(Input::Parameter(_)) => of(operand, None),
            Some(Input::Time) => of(operand, Some(End::Now)),
            Some(Input::NextTime) => of(Operand::Symbol(inputs.time), Some(End::Next)),
            _ => None,
        },
    }
}

/// The program with these instructions given.
fn with_given(program: &Program, given: &HashMap<usize, Operand>) -> Program {
    let read = |operand: &mut Operand| {
        if let Operand::Value(at) = operand
            && let Some(value) = given.get(at)
        {
            *operand = *value;
        }
    };
    let mut program = program.clone();
    program.instructions.iter_mut().for_each(|instruction| {
        read(&mut instruction.a);
        read(&mut instruction.b);
    });
    program.outputs.iter_mut().for_each(read);
    program.without_dead_code()
}

/// With the values of the clock at both ends a step computes what it does without, to the bit.
fn check(inputs: &Inputs, clock: &Program, step: &Program, clocked: &Program) -> Result<(), Inconsistency> {
    for point in 0..probe::POINTS {
        let (given, hoisted) = (probe::symbol(point), probe::hoisted(point));
        let at = |time: f64| {
            let there = |symbol| if symbol == inputs.time { time } else { given(symbol) };
            clock.evaluate_with(&there, &hoisted)
        };
        let values = [inputs.time, inputs.next_time].map(|time| at(given(time))).concat();
        let with_clock = |symbol| match inputs.of(symbol) {
            Some(Input::Clock(function)) => values[function],
            _ => given(symbol),
        };
        let expected = step.evaluate_with(&given, &hoisted);
        let found = clocked.evaluate_with(&with_clock, &hoisted);
        let is_same = |(x, y): (&f64, &f64)| x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan();
        if found.len() != expected.len() || !expected.iter().zip(&found).all(is_same) {
            return Err(Inconsistency { pass: "clock", rule: "a step computes the same with a clock" });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Clocked, check};
    use crate::validate::planned::{DECLARATION, Planned, corrupted, needed};

    /// Φ and γ need the sine of 3 t, Φ̇ the cosine.
    #[test]
    fn every_wrong_instruction_with_a_clock_is_caught() {
        let Planned { plan, .. } = Planned::new(DECLARATION);
        let fused = plan.fused_step.expect("a small mechanism");
        let Clocked { clock, step } = fused.clocked.expect("functions of time");
        assert_eq!(clock.outputs.len(), 2);
        // sine, cosine and their angle at both ends; with held feedback no cosine at the second one
        let kinds = [(&fused.alone.held, &step.held, 5), (&fused.alone.per_stage, &step.per_stage, 6)];
        for (whole, clocked, spared) in kinds {
            assert_eq!(clocked.instructions.len() + spared, whole.instructions.len());
            let mut tried = 0;
            for at in needed(clocked, true) {
                let mut wrong = clocked.clone();
                let Some(operation) = corrupted(wrong.instructions[at].operation) else { continue };
                wrong.instructions[at].operation = operation;
                assert!(check(&plan.inputs, &clock, whole, &wrong).is_err(), "instruction {at}");
                tried += 1;
            }
            assert!(tried > 100, "{tried}");
            assert!(check(&plan.inputs, &clock, whole, clocked).is_ok());
        }
        let mut late = clock.clone();
        late.instructions[0].operation = corrupted(late.instructions[0].operation).expect("a product");
        assert!(check(&plan.inputs, &late, &fused.alone.held, &step.held).is_err());
    }

    #[test]
    fn a_mechanism_without_functions_of_time_has_no_clock() {
        let Planned { plan, .. } = Planned::new(
            "Pendulum { dof = 1; gravity = (0, -9.81) [m/s^2]; body bob (x, y) { mass = 1 [kg]; }
            constraint rod: x^2 + y^2 = 1 [m^2]; start { x = 1 [m]; guess y = 0; } }",
        );
        assert!(plan.fused_step.expect("a small mechanism").clocked.is_none());
    }
}
