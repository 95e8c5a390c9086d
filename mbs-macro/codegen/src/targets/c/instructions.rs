//! Instructions as statements of C.

use rustc_hash::FxHashSet as HashSet;
use std::fmt::Write;
use std::ops::Range;

use mbs_symbolic::layout::{Array, Component, Layout, Place};
use mbs_symbolic::{Function, Inconsistency, Operand, Operation, Program, SinCos};

use super::names::plain;
use super::target::Target;
use crate::compiled::{Input, Vector};

/// The text before a member of a vector.
fn before(vector: Vector) -> &'static str {
    match vector {
        Vector::Parameters => "m->parameters.",
        Vector::Inputs => "inputs->",
        Vector::Positions | Vector::StatePositions => "q->",
        Vector::Velocities | Vector::StateVelocities => "v->",
        Vector::Accelerations => "reactions->acceleration.",
        Vector::Multipliers => "reactions->multipliers.",
        Vector::Feedback => "feedback->",
        Vector::Predicted => "predicted->",
        // of tangents, an array
        Vector::Weights => "direction",
    }
}

/// A vector as an array.
pub fn elements(target: &Target<'_>, vector: Vector) -> String {
    let before = before(vector);
    let pointer = match (vector, before.strip_suffix("->")) {
        (Vector::Weights, _) => before.to_owned(),
        (_, Some(pointer)) => pointer.to_owned(),
        (_, None) => format!("&{}", before.trim_end_matches('.')),
    };
    format!("{}_elements({pointer})", target.names.prefix)
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
    pub fn array(&self, array: Array) -> &str {
        match array {
            Array::Slots => "slots",
            Array::Result(at) => &self.results[at],
        }
    }

    /// An element of one.
    pub fn element(&self, place: Place) -> String {
        format!("{}[{}]", self.array(place.array), place.at)
    }
}

/// Prints some instructions of a program, one after the other.
pub struct Printer<'a> {
    target: &'a Target<'a>,
    program: &'a Program,
    pairs: SinCos,
    /// The instructions that are printed here; results of others are where they are kept.
    range: Range<usize>,
    kept: Option<Kept<'a>>,
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
        let (pairs, printed, text) = (SinCos::of(program), HashSet::default(), String::new());
        Self { target, program, pairs, range, kept, printed, indent, text }
    }

    /// A whole program in straight lines, up to its outputs.
    pub fn of(target: &'a Target<'a>, program: &'a Program) -> Self {
        Self::new(target, program, 0..program.instructions.len(), None, "    ").instructions()
    }

    /// All instructions, as they stand in the program.
    pub fn instructions(mut self) -> Self {
        for at in self.range.clone() {
            let partner = self.pairs.partner(at);
            self.instruction(at, [None, None], partner.filter(|partner| self.range.contains(partner)));
        }
        self
    }

    pub fn is_printed(&self, at: usize) -> bool {
        self.printed.contains(&at)
    }

    /// Adds a line.
    pub fn line(&mut self, line: &str) {
        let _ = writeln!(self.text, "{}{line}", self.indent);
    }

    /// The statement of an instruction, with other operands where there are any, and of its
    /// partner, which takes the cosine of the same angle or the sine; nothing if a partner has
    /// brought it.
    pub fn instruction(&mut self, at: usize, operands: [Option<String>; 2], partner: Option<usize>) {
        if !self.printed.insert(at) {
            return;
        }
        let (program, name) = (self.program, self.name(at));
        let instruction = &program.instructions[at];
        let [a, b] = operands;
        let a = a.unwrap_or_else(|| self.operand(instruction.a));
        let Some(partner) = partner else {
            let b = b.unwrap_or_else(|| self.operand(instruction.b));
            let value = self.target.operation(instruction.operation, &a, &b);
            return self.line(&format!("const real {name} = {value};"));
        };
        self.printed.insert(partner);
        let other = self.name(partner);
        let is_sine = instruction.operation == Operation::Call(Function::Sin);
        let (sine, cosine) = if is_sine { (name, other) } else { (other, name) };
        self.line(&format!("real {sine}, {cosine};"));
        self.line(&format!("{}_sin_cos({a}, &{sine}, &{cosine});", self.target.names.prefix));
    }

    /// An operand as an expression that needs no parentheses.
    pub fn operand(&self, operand: Operand) -> String {
        match operand {
            Operand::Number(number) => self.target.scalar.literal(number.to_f64()),
            Operand::Symbol(symbol) => self.target.input(self.target.compiled.input(symbol)),
            Operand::Hoisted(at) => format!("m->hoisted[{at}]"),
            Operand::Value(at) if self.is_printed(at) => self.name(at),
            Operand::Value(at) => {
                let kept = self.kept.and_then(|kept| Some(kept.element(kept.layout.place(at)?)));
                kept.unwrap_or_else(|| {
                    let rule = "what is read behind a block is kept";
                    self.target.faults.borrow_mut().push(Inconsistency { pass: "C", rule });
                    String::new()
                })
            }
        }
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
        if let Some(Component { vector, place }) = input.component() {
            return match vector {
                Vector::Weights => format!("{}[{place}]", before(vector)),
                _ => format!("{}{}", before(vector), self.names.of(vector).members[place].name),
            };
        }
        let name = match input {
            Input::MinusTwoAlpha => "gains->minus_two_alpha",
            Input::MinusBetaSquared => "gains->minus_beta_squared",
            Input::Step => "h",
            Input::HalfStep => "half_h",
            Input::NextTime => "t_next",
            Input::Shift => "shift",
            _ => "t",
        };
        name.to_owned()
    }

    fn operation(&self, operation: Operation, a: &str, b: &str) -> String {
        match operation {
            Operation::Add => format!("{a} + {b}"),
            Operation::Sub => format!("{a} - {b}"),
            Operation::Mul => format!("{a} * {b}"),
            Operation::Div => format!("{a} / {b}"),
            Operation::Neg => format!("-{a}"),
            Operation::Call(function) => {
                format!("{}({})", self.function(function), function.arguments(&[a, b]).join(", "))
            }
            Operation::Spline(spline, order) => {
                let prefix = &self.names.prefix;
                format!("{prefix}_interpolate(&{prefix}_splines[{}], {order}, {a})", spline.index())
            }
        }
    }

    /// The function of `math.h`, or one of those that are printed with the code.
    fn function(&self, function: Function) -> String {
        match function.row().c {
            Some(name) => self.scalar.of_math(name),
            None => format!("{}_{}", self.names.prefix, function.row().name),
        }
    }
}
