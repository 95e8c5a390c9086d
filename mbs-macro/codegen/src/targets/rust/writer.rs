//! Instructions as `let` statements.
//!
//! A program that is not a step is written as one scalar instruction after the other. Methods without a
//! fused step are made of such programs. The sines and cosines of two angles that are known at the same
//! place are one statement, which `f64` computes in a vector register.

use std::collections::BTreeSet;
use std::ops::Range;

use mbs_symbolic::layout::Layout;
use mbs_symbolic::{Function, Operand, Operation, Program, SinCos};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};

use super::access::Access;
use super::{places, tokens};
use crate::compiled::{Compiled, Vector};

/// Writes some instructions of a program, one after the other.
pub struct Writer<'a> {
    compiled: &'a Compiled,
    program: &'a Program,
    access: &'a Access,
    pairs: &'a SinCos,
    /// The instructions that are written; results of others are where the layout keeps them.
    range: Range<usize>,
    layout: Option<&'a Layout<Vector>>,
    /// Sines and cosines that are not of one angle in every copy.
    apart: HashSet<usize>,
    /// The variables that hold results; a partner of a sine–cosine pair is
    /// named early.
    results: HashMap<usize, Ident>,
    taken: BTreeSet<String>,
    pub statements: TokenStream,
}

impl<'a> Writer<'a> {
    pub fn new(
        compiled: &'a Compiled,
        program: &'a Program,
        access: &'a Access,
        pairs: &'a SinCos,
        range: Range<usize>,
    ) -> Self {
        Self {
            compiled,
            program,
            access,
            pairs,
            range,
            layout: None,
            apart: HashSet::default(),
            results: HashMap::default(),
            taken: BTreeSet::new(),
            statements: TokenStream::new(),
        }
    }

    /// Results that are not written here are read from their places.
    pub fn with_layout(self, layout: &'a Layout<Vector>) -> Self {
        Self { layout: Some(layout), ..self }
    }

    /// Does not take the result of an instruction from that of its partner.
    pub fn set_apart(&mut self, at: usize) {
        self.apart.insert(at);
    }

    /// The statement of an instruction, unless a partner has brought it. Sines and cosines of two
    /// angles that are known here are one statement.
    pub fn instruction(&mut self, at: usize) {
        let Some((other, pairs)) = self.two_angles(at) else {
            return self.instruction_of(at, [None, None]);
        };
        let [a, b] = [at, other].map(|it| self.operand(self.program.instructions[it].a));
        let [[s, c], [sine, cosine]] = pairs.map(|pair| pair.map(|it| self.name(it)));
        self.statements.extend(quote!(let ([#s, #sine], [#c, #cosine]) = T::sin_cos_of_two([#a, #b]);));
    }

    /// Where an instruction is a sine or cosine: a later one whose angle is known already, and the sine and
    /// cosine of each of the two angles.
    fn two_angles(&self, at: usize) -> Option<(usize, [[usize; 2]; 2])> {
        let pair = self.joined(at)?;
        let is_known = |operand: Operand| match operand {
            Operand::Value(value) => self.results.contains_key(&value),
            Operand::Number(_) | Operand::Symbol(_) | Operand::Hoisted(_) => true,
        };
        let mut later = at + 1..self.range.end;
        later.find_map(|other| {
            let of_other = self.joined(other).filter(|_| !pair.contains(&other))?;
            is_known(self.program.instructions[other].a).then_some((other, [pair, of_other]))
        })
    }

    /// The sine and the cosine of an angle, where an instruction is one of them, and both are still to
    /// be written here.
    fn joined(&self, at: usize) -> Option<[usize; 2]> {
        let partner = self.pairs.partner(at)?;
        let is_here = self.range.contains(&partner) && !self.results.contains_key(&at);
        let is_sine = self.program.instructions[at].operation == Operation::Call(Function::Sin);
        is_here.then_some(if is_sine { [at, partner] } else { [partner, at] })
    }

    /// The statement of an instruction with other operands, where there are any, unless a partner has
    /// brought it.
    pub fn instruction_of(&mut self, at: usize, operands: [Option<TokenStream>; 2]) {
        if self.results.contains_key(&at) {
            return;
        }
        let program = self.program;
        let instruction = &program.instructions[at];
        let [a, b] = operands;
        let a = a.unwrap_or_else(|| self.operand(instruction.a));
        let statement = match (instruction.operation, self.pairs.partner(at)) {
            (Operation::Call(function), Some(partner)) => {
                let is_sine = function == Function::Sin;
                let (sine, cosine) = if is_sine { (at, partner) } else { (partner, at) };
                // one that stands elsewhere computes the same pair once more
                let is_joined = self.range.contains(&partner) && !self.apart.contains(&at);
                let mut name = |it| if it == at || is_joined { self.name(it) } else { format_ident!("_") };
                let (sine, cosine) = (name(sine), name(cosine));
                quote!(let (#sine, #cosine) = #a.sin_cos();)
            }
            (operation, _) => {
                let b = b.unwrap_or_else(|| self.operand(instruction.b));
                let name = self.name(at);
                let value = tokens::operation(operation, &a, &b, &self.access.mechanism);
                quote!(let #name = #value;)
            }
        };
        self.statements.extend(statement);
    }

    pub fn operand(&self, operand: Operand) -> TokenStream {
        match operand {
            Operand::Number(number) => tokens::number(number),
            Operand::Symbol(symbol) => tokens::symbol(self.compiled, self.access, symbol),
            Operand::Hoisted(at) => {
                let (this, at) = (&self.access.this, Literal::usize_unsuffixed(at));
                quote!(#this.hoisted[#at])
            }
            // Instructions refer to earlier ones only: written here, or kept.
            Operand::Value(at) => match self.results.get(&at) {
                Some(name) => quote!(#name),
                None => self
                    .layout
                    .and_then(|layout| layout.place(at))
                    .map_or_else(|| tokens::internal("a result is read that is not kept"), places::element),
            },
        }
    }

    /// The variable that holds a result.
    pub fn result(&self, at: usize) -> Option<&Ident> {
        self.results.get(&at)
    }

    /// The name of a result: suggested, `sin_theta`, or `v7`.
    fn name(&mut self, at: usize) -> Ident {
        let instruction = &self.program.instructions[at];
        let of_call = |function: Function| {
            let argument = match instruction.a {
                Operand::Symbol(symbol) => self.compiled.symbol_name(symbol).to_owned(),
                Operand::Value(value) => self.results.get(&value)?.to_string(),
                _ => return None,
            };
            let is_plain = argument.chars().all(|c| c.is_alphanumeric() || c == '_');
            is_plain.then(|| format!("{}_{argument}", function.row().name))
        };
        let suggested = instruction.name.clone().or_else(|| match instruction.operation {
            Operation::Call(function) if function.row().arity == 1 => of_call(function),
            _ => None,
        });
        let name = match suggested {
            Some(name) if syn::parse_str::<Ident>(&name).is_ok() && self.taken.insert(name.clone()) => {
                Ident::new(&name, Span::call_site())
            }
            _ => format_ident!("v{at}"),
        };
        self.results.insert(at, name.clone());
        name
    }
}
