//! What differs between the copies of a loop.

use std::collections::{BTreeSet, HashMap};

use mbs_symbolic::{Operand, Repetition, Source};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::Context;
use super::arrays::Array;
use super::slots::Place;
use crate::emit::program::Writer;

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
        let Context { model, names, access, slots, .. } = *self.context;
        let (runtime, this) = (&names.runtime, &access.this);
        let numbers: Vec<_> = operands.iter().filter_map(|operand| number(*operand)).collect();
        if numbers.len() == operands.len() {
            let (count, numbers) = (numbers.len(), numbers.into_iter().map(Literal::f64_unsuffixed));
            return quote!(T::from_f64(#runtime::__private::read(
                &{ const NUMBERS: [::core::primitive::f64; #count] = [#(#numbers),*]; NUMBERS },
                copy,
            )));
        }
        let mut values = quote!(slots);
        let mut places = Vec::with_capacity(operands.len());
        for &operand in operands {
            let place = match operand {
                Operand::Value(value) => slots.of(value).map(|Place { array, at }| {
                    let ident = array.ident();
                    values = quote!(#ident);
                    at
                }),
                Operand::Hoisted(at) => {
                    values = quote!(&#this.hoisted);
                    Some(at)
                }
                Operand::Symbol(symbol) => Array::of(model.meanings[symbol.index()]).map(|(array, at)| {
                    self.arrays.insert(array);
                    let ident = array.ident();
                    values = quote!(#ident);
                    at
                }),
                Operand::Number(_) => None,
            };
            // operands of one column are of one kind, and results have slots
            places.extend(place);
        }
        let place = self.place(places);
        quote!(#runtime::__private::read(#values, #place))
    }

    /// The place that goes with a copy: by a rule, or else from a table.
    pub fn place(&mut self, places: Vec<usize>) -> TokenStream {
        let first = places.first().copied().unwrap_or(0);
        let second = places.get(1).copied().unwrap_or(first);
        let (up, down) = (second.saturating_sub(first), first.saturating_sub(second));
        let by_rule = |(copy, place): (usize, &usize)| place + down * copy == first + up * copy;
        let literal = Literal::usize_unsuffixed;
        let start = literal(first);
        if places.iter().enumerate().all(by_rule) {
            let (step, is_down) = (literal(up.max(down)), down > 0);
            return match (first, up.max(down), is_down) {
                (0, 1, false) => quote!(copy),
                (_, 1, false) => quote!(#start + copy),
                (_, 1, true) => quote!(#start - copy),
                (0, _, false) => quote!(#step * copy),
                (_, _, false) => quote!(#start + #step * copy),
                (_, _, true) => quote!(#start - #step * copy),
            };
        }
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
            let next = writer.result(self.repetition.start + from);
            before.extend(quote!(let mut #name = #first;));
            after.extend(quote!(#name = #next;));
        }
        (before, after)
    }
}

fn number(operand: Operand) -> Option<f64> {
    match operand {
        Operand::Number(number) => Some(number.to_f64()),
        _ => None,
    }
}
