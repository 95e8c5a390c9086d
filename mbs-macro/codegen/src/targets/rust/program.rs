//! Instructions as `let` statements.
//!
//! A program that is not a step is written as one scalar instruction after the other. Methods without a
//! fused step are made of such programs. The sines and cosines of two angles that are known at the same
//! place are one statement, which `f64` computes in a vector register.

use std::collections::BTreeSet;
use std::ops::Range;

use mbs_symbolic::layout::{Array, Layout, Place};
use mbs_symbolic::{Block, Function, Operand, Operation, Program, SinCos};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};

use super::access::Access;
use super::long::{self, places};
use super::names::Names;
use super::tokens;
use crate::compiled::{Compiled, FunctionId, Vector};

/// Statements that run a program, and its outputs.
pub struct Body {
    pub statements: TokenStream,
    /// As expressions.
    pub outputs: Vec<TokenStream>,
    /// Of a long program, where they are kept.
    pub places: Option<Vec<Place>>,
    /// The number of slots of a long program.
    pub slots: usize,
    pub runtime: TokenStream,
}

impl Body {
    /// A stand-in for a program that cannot be written; nobody gets to see it.
    fn none(program: &Program, names: &Names) -> Self {
        let outputs = vec![tokens::internal("a program has no layout"); program.outputs.len()];
        let runtime = names.runtime.clone();
        Self { statements: TokenStream::new(), outputs, places: None, slots: 0, runtime }
    }

    /// Some of the outputs as an array.
    pub fn array(&self, range: Range<usize>) -> TokenStream {
        let Some(places) = &self.places else {
            let outputs = &self.outputs[range];
            return quote!([#(#outputs),*]);
        };
        let (runtime, count) = (&self.runtime, Literal::usize_unsuffixed(range.len()));
        let places = places[range].iter().map(|place| Literal::usize_unsuffixed(place.at));
        quote! {{
            const PLACES: [::core::primitive::u32; #count] = [#(#places),*];
            #runtime::__private::gather(&slots, &PLACES)
        }}
    }

    /// Statements that write outputs of a long program into an array, each pair of an output and
    /// its element, but for those that are there already.
    pub fn write(&self, array: Array, pairs: impl Iterator<Item = (usize, usize)>) -> TokenStream {
        let runtime = &self.runtime;
        let literal = Literal::usize_unsuffixed;
        let places = self.places.as_deref().unwrap_or_default();
        let rows: Vec<_> = pairs
            .filter_map(|(output, to)| Some((places.get(output)?, to)))
            .filter(|(place, _)| place.array == Array::Slots)
            .map(|(place, to)| (literal(place.at), literal(to)))
            .map(|(from, to)| quote!([#from, #to]))
            .collect();
        if rows.is_empty() {
            return TokenStream::new();
        }
        let (array, count) = (places::array(array), literal(rows.len()));
        quote! {{
            const PLACES: [[::core::primitive::u32; 2]; #count] = [#(#rows),*];
            #runtime::__private::copy(slots, #array, &PLACES);
        }}
    }

    /// Statements that add outputs to elements of a slice, each pair of an output and its element.
    pub fn add(&self, slice: &TokenStream, pairs: &[(usize, usize)]) -> TokenStream {
        let literal = Literal::usize_unsuffixed;
        let Some(places) = &self.places else {
            let length = literal(pairs.iter().map(|(_, to)| to + 1).max().unwrap_or(0));
            let sums = pairs.iter().map(|&(output, to)| {
                let (value, to) = (&self.outputs[output], literal(to));
                quote!(sums[#to] = sums[#to] + #value;)
            });
            return quote! {{
                let sums = #slice.first_chunk_mut::<#length>()?;
                #(#sums)*
            }};
        };
        let runtime = &self.runtime;
        let rows = pairs.iter().map(|&(output, to)| {
            let (from, to) = (literal(places[output].at), literal(to));
            quote!([#from, #to])
        });
        let count = literal(pairs.len());
        quote! {{
            const PLACES: [[::core::primitive::u32; 2]; #count] = [#(#rows),*];
            #runtime::__private::add(&slots, #slice, &PLACES);
        }}
    }

    /// Some of the outputs as a vector with named components.
    pub fn vector(&self, of_t: &TokenStream, fields: &[Ident], range: Range<usize>) -> TokenStream {
        if self.places.is_some() && !fields.is_empty() {
            let (runtime, array) = (&self.runtime, self.array(range));
            return quote!(<#of_t as #runtime::Components>::from_array(#array));
        }
        named(of_t, fields, &self.outputs[range])
    }
}

/// A vector of type `of_t` with these components.
pub fn named(of_t: &TokenStream, fields: &[Ident], values: &[TokenStream]) -> TokenStream {
    if fields.is_empty() {
        return quote!(::core::default::Default::default());
    }
    // `Name<T>` as it stands in expressions
    let name = of_t.clone().into_iter().next();
    quote!(#name { #(#fields: #values),* })
}

/// A program as one list of statements, or if it is long, as loops and
/// functions of bounded size.
pub fn body(compiled: &Compiled, names: &Names, function: FunctionId, access: &Access) -> Body {
    body_of(compiled, names, compiled.program(function), access)
}

/// The same of any program.
pub fn body_of(compiled: &Compiled, names: &Names, program: &Program, access: &Access) -> Body {
    let blocks = compiled.blocks(program);
    let range = match &blocks[..] {
        [] => 0..0,
        [Block::Straight(range)] => range.clone(),
        _ => {
            let body = long::body(compiled, names, program, access, &blocks);
            return body.unwrap_or_else(|fault| {
                names.faults.borrow_mut().push(fault);
                Body::none(program, names)
            });
        }
    };
    let pairs = SinCos::of(program);
    let mut writer = Writer::new(compiled, program, access, &pairs, range.clone());
    range.for_each(|at| writer.instruction(at));
    let outputs = program.outputs.iter().map(|&output| writer.operand(output)).collect();
    Body { statements: writer.statements, outputs, places: None, slots: 0, runtime: names.runtime.clone() }
}

/// Writes some instructions of a program, one after the other.
pub(super) struct Writer<'a> {
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
