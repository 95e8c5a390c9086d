//! Instructions as `let` statements.

use std::collections::{BTreeSet, HashMap};

use mbs_symbolic::{Function, Number, Operand, Operation, Program, Symbol};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::access::Access;
use super::names::{Names, field};
use super::parts;
use super::splines::spline_name;
use crate::model::{Meaning, Model};

/// Statements that run a program, and its outputs as expressions.
pub struct Body {
    pub statements: TokenStream,
    pub outputs: Vec<TokenStream>,
}

/// A program as one list of statements, or as calls of functions of bounded
/// size if it is long.
pub fn body(model: &Model, names: &Names, program: &Program, access: &Access) -> Body {
    if program.instructions.len() > parts::LONGEST {
        return parts::body(model, names, program, access);
    }
    let mut writer = Writer::new(model, program, access);
    for at in 0..program.instructions.len() {
        writer.instruction(at);
    }
    let outputs = program.outputs.iter().map(|&output| writer.operand(output)).collect();
    Body { statements: writer.statements, outputs }
}

pub(super) struct Writer<'a> {
    model: &'a Model,
    program: &'a Program,
    access: &'a Access,
    /// How a result is referred to; a partner of a sine–cosine pair is named early.
    pub references: Vec<Option<TokenStream>>,
    names: Vec<Option<Ident>>,
    taken: BTreeSet<String>,
    pub statements: TokenStream,
    /// Sine instruction ↔ cosine instruction of the same angle.
    pairs: HashMap<usize, usize>,
}

impl<'a> Writer<'a> {
    pub fn new(model: &'a Model, program: &'a Program, access: &'a Access) -> Self {
        let length = program.instructions.len();
        Self {
            model,
            program,
            access,
            references: vec![None; length],
            names: vec![None; length],
            taken: BTreeSet::new(),
            statements: TokenStream::new(),
            pairs: sine_cosine_pairs(program),
        }
    }

    /// The statement of an instruction, unless a partner has brought it.
    pub fn instruction(&mut self, at: usize) {
        if self.references[at].is_some() {
            return;
        }
        let instruction = &self.program.instructions[at];
        let a = self.operand(instruction.a);
        let statement = match (instruction.operation, self.pairs.get(&at).copied()) {
            (Operation::Call(function), Some(partner)) => {
                let (sine, cosine) = if function == Function::Sin { (at, partner) } else { (partner, at) };
                let (sine, cosine) = (self.name(sine), self.name(cosine));
                quote!(let (#sine, #cosine) = #a.sin_cos();)
            }
            (operation, _) => {
                let b = self.operand(instruction.b);
                let name = self.name(at);
                let value = operation_tokens(operation, &a, &b, &self.access.mechanism);
                quote!(let #name = #value;)
            }
        };
        self.statements.extend(statement);
    }

    pub fn operand(&self, operand: Operand) -> TokenStream {
        match operand {
            Operand::Number(number) => number_tokens(number),
            Operand::Symbol(symbol) => symbol_tokens(self.model, self.access, symbol),
            Operand::Hoisted(at) => {
                let (this, at) = (&self.access.this, Literal::usize_unsuffixed(at));
                quote!(#this.hoisted[#at])
            }
            // Instructions refer to earlier ones only.
            Operand::Value(at) => self.references.get(at).cloned().flatten().unwrap_or_default(),
        }
    }

    /// The instructions whose results stand in the statements so far, and the
    /// names that they have there.
    pub fn take_names(&mut self) -> Vec<(usize, Ident)> {
        self.taken.clear();
        let names = self.names.iter_mut().enumerate();
        names.filter_map(|(at, name)| name.take().map(|name| (at, name))).collect()
    }

    /// The name of a result: suggested, `sin_theta`, or `v7`.
    fn name(&mut self, at: usize) -> Ident {
        let instruction = &self.program.instructions[at];
        let of_call = |function: Function| {
            let argument = match instruction.a {
                Operand::Symbol(symbol) => self.model.arena.name(symbol).to_owned(),
                Operand::Value(value) => self.names.get(value)?.as_ref()?.to_string(),
                _ => return None,
            };
            let is_plain = argument.chars().all(|c| c.is_alphanumeric() || c == '_');
            is_plain.then(|| format!("{}_{argument}", function.row().name))
        };
        let suggested = instruction.name.clone().or_else(|| match instruction.operation {
            Operation::Call(function) => of_call(function),
            _ => None,
        });
        let name = match suggested {
            Some(name) if syn::parse_str::<Ident>(&name).is_ok() && self.taken.insert(name.clone()) => {
                Ident::new(&name, Span::call_site())
            }
            _ => format_ident!("v{at}"),
        };
        self.references[at] = Some(quote!(#name));
        self.names[at] = Some(name.clone());
        name
    }
}

/// How generated code reads a symbol.
pub fn symbol_tokens(model: &Model, access: &Access, symbol: Symbol) -> TokenStream {
    let Access { parameters, time, positions, velocities, .. } = access;
    let coordinate = |at: usize| field(&model.coordinates[at].quantity.name);
    let row = |at: usize| field(&model.constraints[at].name);
    match model.meanings[symbol.index()] {
        Meaning::Time => time.clone(),
        Meaning::Parameter(at) => {
            let name = field(&model.parameters[at].quantity.name);
            quote!(#parameters.#name)
        }
        Meaning::Input(at) => {
            let name = field(&model.inputs[at].name);
            quote!(inputs.#name)
        }
        Meaning::Coordinate(at) => {
            let name = coordinate(at);
            quote!(#positions.#name)
        }
        Meaning::Velocity(at) => {
            let name = coordinate(at);
            quote!(#velocities.#name)
        }
        Meaning::Acceleration(at) => {
            let name = coordinate(at);
            quote!(reactions.acceleration.#name)
        }
        Meaning::Multiplier(at) => {
            let name = row(at);
            quote!(reactions.multipliers.#name)
        }
        Meaning::Feedback(at) => {
            let name = row(at);
            quote!(feedback.#name)
        }
        Meaning::MinusTwoAlpha => quote!(gains.minus_two_alpha),
        Meaning::MinusBetaSquared => quote!(gains.minus_beta_squared),
        Meaning::Step => quote!(h),
        Meaning::HalfStep => quote!(half_h),
        Meaning::NextTime => quote!(t_next),
    }
}

pub fn operation_tokens(
    operation: Operation,
    a: &TokenStream,
    b: &TokenStream,
    mechanism: &TokenStream,
) -> TokenStream {
    match operation {
        Operation::Add => quote!(#a + #b),
        Operation::Sub => quote!(#a - #b),
        Operation::Mul => quote!(#a * #b),
        Operation::Div => quote!(#a / #b),
        Operation::Neg => quote!(-#a),
        Operation::Call(function) => {
            let method = method(function);
            quote!(#a.#method())
        }
        Operation::Call2(function) => {
            let method = method(function);
            quote!(#a.#method(#b))
        }
        Operation::Spline(spline, order) => {
            let (table, order) = (spline_name(spline.index()), Literal::u8_unsuffixed(order));
            quote!(#mechanism::#table.derivative(#order, #a))
        }
    }
}

/// The method of `Real` that computes a function.
fn method(function: Function) -> Ident {
    let name = if function == Function::Greater { "greater" } else { function.row().name };
    Ident::new(name, Span::call_site())
}

pub fn number_tokens(number: Number) -> TokenStream {
    float_tokens(number.to_f64())
}

pub fn float_tokens(value: f64) -> TokenStream {
    if !value.is_finite() {
        return quote!(T::from_f64(::core::primitive::f64::NAN));
    }
    let literal = Literal::f64_unsuffixed(value);
    quote!(T::from_f64(#literal))
}

/// Sine and cosine instructions of the same angle, both ways.
fn sine_cosine_pairs(program: &Program) -> HashMap<usize, usize> {
    let calls = |wanted: Function| {
        let of_angle = move |(at, instruction): (usize, &mbs_symbolic::Instruction)| {
            (instruction.operation == Operation::Call(wanted)).then_some((instruction.a, at))
        };
        program.instructions.iter().enumerate().filter_map(of_angle)
    };
    let cosines: HashMap<Operand, usize> = calls(Function::Cos).collect();
    let mut pairs = HashMap::new();
    for (angle, sine) in calls(Function::Sin) {
        if let Some(&cosine) = cosines.get(&angle) {
            pairs.insert(sine, cosine);
            pairs.insert(cosine, sine);
        }
    }
    pairs
}
