//! Instructions as statements of C.

use std::collections::HashSet;
use std::fmt::Write;
use std::ops::Range;

use mbs_symbolic::layout::{Array, Layout, Place};
use mbs_symbolic::{Function, Inconsistency, Operand, Operation, Program, SinCos};

use super::Target;
use super::names::plain;
use crate::compiled::{Input, Vector};

/// What ends a program that reads a result which is not there.
const KEPT: Inconsistency = Inconsistency { pass: "C", rule: "a result that is read is kept" };

/// What a function reads symbols from, by the name of its argument.
pub fn argument(input: Input) -> &'static str {
    match input {
        Input::Time => "t",
        Input::Parameter(_) => "m",
        Input::Input(_) => "inputs",
        Input::Position(_) => "q",
        Input::Velocity(_) => "v",
        Input::Acceleration(_) | Input::Multiplier(_) => "reactions",
        Input::Feedback(_) => "feedback",
        Input::MinusTwoAlpha | Input::MinusBetaSquared => "gains",
        Input::Step => "h",
        Input::HalfStep => "half_h",
        Input::NextTime => "t_next",
    }
}

/// The struct that holds a vector, and how a member of it is chosen.
fn structure(vector: Vector) -> (&'static str, &'static str) {
    match vector {
        Vector::Parameters => ("m->parameters", "."),
        Vector::Inputs => ("inputs", "->"),
        Vector::Positions => ("q", "->"),
        Vector::Velocities => ("v", "->"),
        Vector::Accelerations => ("reactions->acceleration", "."),
        Vector::Multipliers => ("reactions->multipliers", "."),
        Vector::Feedback => ("feedback", "->"),
    }
}

/// A vector as an array.
pub fn elements(target: &Target<'_>, vector: Vector) -> String {
    let (structure, by) = structure(vector);
    let address = if by == "." { "&" } else { "" };
    format!("{}_elements({address}{structure})", target.names.prefix)
}

/// Where the results of a program that is laid out are kept.
#[derive(Clone, Copy)]
pub struct Kept<'a> {
    pub layout: &'a Layout<Vector>,
    /// The arrays of results, as expressions.
    pub results: &'a [String],
}

impl Kept<'_> {
    /// An array of results.
    ///
    /// # Errors
    /// There is none.
    pub fn array(&self, array: Array) -> Result<&str, Inconsistency> {
        match array {
            Array::Slots => Ok("slots"),
            Array::Result(at) => self.results.get(at).map(String::as_str).ok_or(KEPT),
        }
    }

    /// An element of one.
    ///
    /// # Errors
    /// There is none.
    pub fn element(&self, place: Place) -> Result<String, Inconsistency> {
        Ok(format!("{}[{}]", self.array(place.array)?, place.at))
    }
}

/// Prints some instructions of a program, one after the other.
pub struct Printer<'a> {
    pub target: &'a Target<'a>,
    pub program: &'a Program,
    pairs: SinCos,
    /// What is printed here; results of other instructions are where they are kept.
    range: Range<usize>,
    kept: Option<Kept<'a>>,
    /// Sines and cosines that are not of one angle in every copy of a loop.
    apart: HashSet<usize>,
    printed: HashSet<usize>,
    indent: &'static str,
    pub text: String,
}

impl<'a> Printer<'a> {
    pub fn new(
        target: &'a Target<'a>,
        program: &'a Program,
        range: Range<usize>,
        kept: Option<Kept<'a>>,
        indent: &'static str,
    ) -> Self {
        let (pairs, text) = (SinCos::of(program), String::new());
        let (apart, printed) = (HashSet::new(), HashSet::new());
        Self { target, program, pairs, range, kept, apart, printed, indent, text }
    }

    /// Does not take the result of an instruction from that of its partner.
    pub fn set_apart(&mut self, at: usize) {
        self.apart.insert(at);
    }

    pub fn is_printed(&self, at: usize) -> bool {
        self.printed.contains(&at)
    }

    /// Adds a line.
    pub fn line(&mut self, line: &str) {
        let _ = writeln!(self.text, "{}{line}", self.indent);
    }

    /// The statement of an instruction, unless a partner has brought it, with other operands
    /// where there are any.
    ///
    /// # Errors
    /// A result is read that is not kept.
    pub fn instruction(&mut self, at: usize, operands: [Option<String>; 2]) -> Result<(), Inconsistency> {
        if self.is_printed(at) {
            return Ok(());
        }
        let instruction = &self.program.instructions[at];
        let [a, b] = operands;
        let a = a.map_or_else(|| self.operand(instruction.a), Ok)?;
        let partner = self.pairs.partner(at);
        let partner = partner.filter(|partner| self.range.contains(partner) && !self.apart.contains(&at));
        match partner {
            Some(partner) => {
                let is_sine = instruction.operation == Operation::Call(Function::Sin);
                let [sine, cosine] =
                    if is_sine { [at, partner] } else { [partner, at] }.map(|it| self.name(it));
                self.line(&format!("real {sine}, {cosine};"));
                let prefix = &self.target.names.prefix;
                self.line(&format!("{prefix}_sin_cos({a}, &{sine}, &{cosine});"));
                self.printed.insert(partner);
            }
            None => {
                let b = b.map_or_else(|| self.operand(instruction.b), Ok)?;
                let value = self.target.operation(instruction.operation, &a, &b);
                self.line(&format!("const real {} = {value};", self.name(at)));
            }
        }
        self.printed.insert(at);
        Ok(())
    }

    /// An operand as an expression that needs no parentheses.
    ///
    /// # Errors
    /// It is a result that is not kept.
    pub fn operand(&self, operand: Operand) -> Result<String, Inconsistency> {
        Ok(match operand {
            Operand::Number(number) => self.target.scalar.literal(number.to_f64()),
            Operand::Symbol(symbol) => self.target.input(self.target.compiled.input(symbol)),
            Operand::Hoisted(at) => format!("m->hoisted[{at}]"),
            Operand::Value(at) if self.is_printed(at) => self.name(at),
            Operand::Value(at) => {
                let kept = self.kept.ok_or(KEPT)?;
                kept.element(kept.layout.place(at).ok_or(KEPT)?)?
            }
        })
    }

    /// The variable that holds a result: the suggested name, or `v`, with the position, so that
    /// nothing else has this name.
    pub fn name(&self, at: usize) -> String {
        let suggested = self.program.instructions[at].name.as_deref();
        suggested.map_or_else(|| format!("v{at}"), |name| format!("{}_{at}", plain(name)))
    }
}

impl Target<'_> {
    /// How a function reads what a symbol stands for.
    pub fn input(&self, input: Input) -> String {
        if let Some(component) = input.component() {
            let (structure, by) = structure(component.vector);
            return format!("{structure}{by}{}", self.names.members(component.vector)[component.place]);
        }
        let of_gains = match input {
            Input::MinusTwoAlpha => "->minus_two_alpha",
            Input::MinusBetaSquared => "->minus_beta_squared",
            _ => "",
        };
        format!("{}{of_gains}", argument(input))
    }

    fn operation(&self, operation: Operation, a: &str, b: &str) -> String {
        match operation {
            Operation::Add => format!("{a} + {b}"),
            Operation::Sub => format!("{a} - {b}"),
            Operation::Mul => format!("{a} * {b}"),
            Operation::Div => format!("{a} / {b}"),
            Operation::Neg => format!("-{a}"),
            Operation::Call(function) => format!("{}({a})", self.function(function)),
            Operation::Call2(function) => format!("{}({a}, {b})", self.function(function)),
            Operation::Spline(spline, order) => {
                let prefix = &self.names.prefix;
                format!("{prefix}_interpolate(&{prefix}_spline_{}, {order}, {a})", spline.index())
            }
        }
    }

    /// The function of `math.h`, or one of those that are printed with the code.
    fn function(&self, function: Function) -> String {
        let own = |name: &str| format!("{}_{name}", self.names.prefix);
        match (function, function.row().c) {
            (Function::Sin | Function::Cos, _) => own(function.row().name),
            (Function::Greater, _) => own("greater"),
            (_, Some(name)) => self.scalar.of_math(name),
            (_, None) => own(function.row().name),
        }
    }
}
