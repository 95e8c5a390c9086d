//! A target in fifty lines: the functions of a mechanism as Python.
//!
//! ```text
//! cargo run -p mbs-codegen --example python < pendulum.mbs > pendulum.py
//! ```
//!
//! where `pendulum.mbs` is what stands between the braces of `mechanism!`. The functions
//! take what depends on parameters alone (the result of `new`), the parameters, and their
//! arguments, all as lists; without splines and without loops, which a target for long
//! chains should have.

use std::error::Error;
use std::io::{Read, stdin};

use mbs_codegen::compiled::{Argument, Input};
use mbs_codegen::{Compiled, FunctionId, analyse};
use mbs_symbolic::{Function, Operand, Operation};

fn main() -> Result<(), Box<dyn Error>> {
    let mut declaration = String::new();
    stdin().read_to_string(&mut declaration)?;
    let compiled = analyse(declaration.parse()?)?;
    println!("from math import *\n\ndef sign(x): return x if x == 0 else copysign(1.0, x)");
    for function in FunctionId::all() {
        let arguments = function.arguments().iter().flat_map(|argument| names(*argument)).copied();
        let arguments: Vec<&str> = ["hoisted", "p"].into_iter().chain(arguments).collect();
        println!("\ndef {}({}):", function.name(), arguments.join(", "));
        let program = compiled.program(function);
        for (at, instruction) in program.instructions.iter().enumerate() {
            let [a, b] = [instruction.a, instruction.b].map(|operand| read(&compiled, operand));
            println!("    v{at} = {}", operation(instruction.operation, &a, &b)?);
        }
        let outputs: Vec<String> = program.outputs.iter().map(|&output| read(&compiled, output)).collect();
        println!("    return [{}]", outputs.join(", "));
    }
    Ok(())
}

fn names(argument: Argument) -> &'static [&'static str] {
    match argument {
        Argument::Time => &["t"],
        Argument::Positions | Argument::StatePositions => &["q"],
        Argument::Velocities | Argument::StateVelocities => &["v"],
        Argument::Inputs => &["inputs"],
        Argument::Gains => &["minus_two_alpha", "minus_beta_squared"],
        Argument::Feedback => &["feedback"],
        Argument::Reactions => &["acceleration", "multipliers"],
        Argument::Shift => &["shift"],
        Argument::Predicted => &["predicted"],
    }
}

fn read(compiled: &Compiled, operand: Operand) -> String {
    match operand {
        Operand::Number(number) => format!("{:?}", number.to_f64()),
        Operand::Hoisted(at) => format!("hoisted[{at}]"),
        Operand::Value(at) => format!("v{at}"),
        Operand::Symbol(symbol) => match compiled.input(symbol) {
            Input::Time => "t".to_owned(),
            Input::Parameter(at) => format!("p[{at}]"),
            Input::Input(at) => format!("inputs[{at}]"),
            Input::Position(at) | Input::StatePosition(at) => format!("q[{at}]"),
            Input::Velocity(at) | Input::StateVelocity(at) => format!("v[{at}]"),
            Input::Acceleration(at) => format!("acceleration[{at}]"),
            Input::Multiplier(at) => format!("multipliers[{at}]"),
            Input::Feedback(at) => format!("feedback[{at}]"),
            Input::Predicted(at) => format!("predicted[{at}]"),
            Input::Shift => "shift".to_owned(),
            Input::MinusTwoAlpha => "minus_two_alpha".to_owned(),
            Input::MinusBetaSquared => "minus_beta_squared".to_owned(),
            Input::Step => "h".to_owned(),
            Input::HalfStep => "half_h".to_owned(),
            Input::NextTime => "t_next".to_owned(),
            Input::Weight(at) => format!("weights[{at}]"),
        },
    }
}

fn operation(operation: Operation, a: &str, b: &str) -> Result<String, &'static str> {
    Ok(match operation {
        Operation::Add => format!("{a} + {b}"),
        Operation::Sub => format!("{a} - {b}"),
        Operation::Mul => format!("{a} * {b}"),
        Operation::Div => format!("{a} / {b}"),
        Operation::Neg => format!("-{a}"),
        Operation::Call(Function::Ln) => format!("log({a})"),
        Operation::Call(Function::Greater | Function::Choice) => format!("float({a} > {b})"),
        Operation::Call(Function::Gate) => format!("({b} if {a} else 0.0)"),
        Operation::Call(function) => {
            format!("{}({})", function.row().name, function.arguments(&[a, b]).join(", "))
        }
        Operation::Spline(..) => return Err("this target has no splines"),
    })
}
