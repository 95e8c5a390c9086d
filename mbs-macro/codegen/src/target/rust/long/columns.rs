//! What differs between the copies of a loop.

use std::collections::{BTreeSet, HashMap};

use mbs_symbolic::{Operand, Repetition, Source};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::Context;
use super::arrays::Array;
use super::slots::{Kind, Slots};
use crate::compiled::Compiled;
use crate::target::rust::program::{Writer, internal};

/// What differs from copy to copy: how it is read.
pub struct Columns<'a> {
    pub context: &'a Context<'a>,
    pub repetition: Repetition,
    /// Statements that read what the next instruction needs.
    pub reads: TokenStream,
    known: HashMap<Source, TokenStream>,
    /// The vectors that are read.
    pub arrays: BTreeSet<Array>,
    /// Places without a rule, one per copy.
    pub tables: Vec<Vec<usize>>,
    /// Variables that hold a result of the copy before, its instruction, and
    /// their value in the first copy.
    carried: Vec<(Ident, usize, Operand)>,
}

impl<'a> Columns<'a> {
    pub fn new(context: &'a Context<'a>, repetition: Repetition) -> Self {
        Self {
            context,
            repetition,
            reads: TokenStream::new(),
            known: HashMap::new(),
            arrays: BTreeSet::new(),
            tables: Vec::new(),
            carried: Vec::new(),
        }
    }

    /// The operand in a copy; `None` if it reads as in straight instructions.
    pub fn read(&mut self, source: &Source) -> Option<TokenStream> {
        if matches!(source, Source::Own(_) | Source::Same(_)) {
            return None;
        }
        if let Some(known) = self.known.get(source) {
            return Some(known.clone());
        }
        let tokens = match source {
            Source::Carried(from, first) => {
                let name = format_ident!("carried_{}", self.carried.len() + 1);
                self.carried.push((name.clone(), *from, *first));
                quote!(#name)
            }
            Source::Each(operands) => {
                let name = format_ident!("operand_{}", self.known.len() + 1);
                let value = self.each(operands);
                self.reads.extend(quote!(let #name = #value;));
                quote!(#name)
            }
            Source::Own(_) | Source::Same(_) => return None,
        };
        self.known.insert(source.clone(), tokens.clone());
        Some(tokens)
    }

    /// The operand of a copy, which is another one each time.
    pub fn each(&mut self, operands: &[Operand]) -> TokenStream {
        let Context { compiled, names, access, slots, .. } = *self.context;
        let (runtime, this) = (&names.runtime, &access.this);
        let numbers: Vec<_> = operands.iter().filter_map(|operand| number(*operand)).collect();
        if numbers.len() == operands.len() {
            let (count, numbers) = (numbers.len(), numbers.into_iter().map(Literal::f64_unsuffixed));
            return quote!(T::from_f64(#runtime::__private::read(
                &{ const NUMBERS: [::core::primitive::f64; #count] = [#(#numbers),*]; NUMBERS },
                copy,
            )));
        }
        let homes: Option<Vec<(Home, usize)>> =
            operands.iter().map(|&operand| Home::of(compiled, slots, operand)).collect();
        // operands of one column are of one kind, and results have slots
        let home = match homes.as_deref() {
            Some([(first, _), others @ ..]) if others.iter().all(|(other, _)| other == first) => *first,
            _ => return internal("the copies of a loop read an operand from different arrays"),
        };
        let values = match home {
            Home::Result(array) => array.ident().to_token_stream(),
            Home::Hoisted => quote!(&#this.hoisted),
            Home::Vector(array) => {
                self.arrays.insert(array);
                array.ident().to_token_stream()
            }
        };
        let places = homes.into_iter().flatten().map(|(_, place)| place).collect();
        let place = self.place(places);
        quote!(#runtime::__private::read(#values, #place))
    }

    /// The place that goes with a copy: by a rule, or else from a table.
    pub fn place(&mut self, places: Vec<usize>) -> TokenStream {
        let literal = Literal::usize_unsuffixed;
        let places = match Rule::of(places) {
            Rule::Line { first, step, is_down } => {
                let (start, factor) = (literal(first), literal(step));
                return match (first, step, is_down) {
                    (0, 1, false) => quote!(copy),
                    (_, 1, false) => quote!(#start + copy),
                    (_, 1, true) => quote!(#start - copy),
                    (0, _, false) => quote!(#factor * copy),
                    (_, _, false) => quote!(#start + #factor * copy),
                    (_, _, true) => quote!(#start - #factor * copy),
                };
            }
            Rule::Table(places) => places,
        };
        let column = self.tables.iter().position(|table| *table == places).unwrap_or_else(|| {
            self.tables.push(places);
            self.tables.len() - 1
        });
        let name = format_ident!("place_{}", column + 1);
        quote!(#name as ::core::primitive::usize)
    }

    /// `for copy in …`, with the rows of the table.
    pub fn head(&self) -> TokenStream {
        let count = Literal::usize_unsuffixed(self.repetition.count);
        if self.tables.is_empty() {
            return quote!(for copy in 0..#count);
        }
        let rows = (0..self.repetition.count).map(|copy| {
            let places = self.tables.iter().map(|table| Literal::usize_unsuffixed(table[copy]));
            quote!([#(#places),*])
        });
        let names = (1..=self.tables.len()).map(|column| format_ident!("place_{column}"));
        let columns = Literal::usize_unsuffixed(self.tables.len());
        quote! {
            const PLACES: [[::core::primitive::u32; #columns]; #count] = [#(#rows),*];
            for (copy, &[#(#names),*]) in PLACES.iter().enumerate()
        }
    }

    /// Variables for results of the copy before: their first values, and how
    /// they change at the end of a copy.
    pub fn carried_values(&self, writer: &Writer<'_>) -> (TokenStream, TokenStream) {
        let (mut before, mut after) = (TokenStream::new(), TokenStream::new());
        for (name, from, first) in &self.carried {
            let first = writer.operand(*first);
            let next = writer
                .result(self.repetition.start + from)
                .map_or_else(|| internal("a loop has no result to carry"), ToTokens::to_token_stream);
            before.extend(quote!(let mut #name = #first;));
            after.extend(quote!(#name = #next;));
        }
        (before, after)
    }
}

/// The places that go with the copies of a loop.
pub enum Rule {
    /// first + step·copy, or first − step·copy
    Line {
        first: usize,
        step: usize,
        is_down: bool,
    },
    Table(Vec<usize>),
}

impl Rule {
    pub fn of(places: Vec<usize>) -> Self {
        let [first, second, ..] = places[..] else { return Self::Table(places) };
        let (up, down) = (second.saturating_sub(first), first.saturating_sub(second));
        let by_rule = |(copy, place): (usize, &usize)| place + down * copy == first + up * copy;
        match places.iter().enumerate().all(by_rule) {
            true => Self::Line { first, step: up.max(down), is_down: down > 0 },
            false => Self::Table(places),
        }
    }

    /// The place of a copy.
    pub fn at(&self, copy: usize) -> usize {
        match self {
            Self::Line { first, step, is_down: false } => first + step * copy,
            Self::Line { first, step, is_down: true } => first - step * copy,
            Self::Table(places) => places[copy],
        }
    }
}

/// The array that the copies of a loop read an operand from.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Home {
    Result(Kind),
    Hoisted,
    Vector(Array),
}

impl Home {
    /// The array and the place of an operand in it; `None` of what is in none.
    pub fn of(compiled: &Compiled, slots: &Slots, operand: Operand) -> Option<(Self, usize)> {
        match operand {
            Operand::Value(value) => slots.of(value).map(|place| (Self::Result(place.array), place.at)),
            Operand::Hoisted(at) => Some((Self::Hoisted, at)),
            Operand::Symbol(symbol) => {
                Array::of(compiled.input(symbol)).map(|(array, at)| (Self::Vector(array), at))
            }
            Operand::Number(_) => None,
        }
    }
}

fn number(operand: Operand) -> Option<f64> {
    match operand {
        Operand::Number(number) => Some(number.to_f64()),
        _ => None,
    }
}
