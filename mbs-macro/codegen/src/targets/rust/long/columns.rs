//! The operands that differ between the copies of a loop, as the loop reads them.

use std::collections::BTreeSet;

use mbs_symbolic::layout::{Carried, Column, Home, Kept, Loop, Read, Rule};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};
use rustc_hash::FxHashMap as HashMap;

use super::context::Context;
use crate::compiled::Vector;
use crate::targets::rust::writer::Writer;
use crate::targets::rust::{places, tokens};

/// The operands that differ from copy to copy, and the names that they have so far.
pub struct Columns<'a> {
    context: &'a Context<'a>,
    repeated: &'a Loop<Vector>,
    /// Statements that read what the next instruction needs.
    pub reads: TokenStream,
    known: HashMap<Read, Ident>,
}

impl<'a> Columns<'a> {
    pub fn new(context: &'a Context<'a>, repeated: &'a Loop<Vector>) -> Self {
        Self { context, repeated, reads: TokenStream::new(), known: HashMap::default() }
    }

    /// The operand in a copy; `None` if it reads as in straight instructions.
    pub fn read(&mut self, read: Read) -> Option<TokenStream> {
        if let Some(known) = self.known.get(&read) {
            return Some(known.to_token_stream());
        }
        let name = match read {
            Read::Own(_) | Read::Same(_) => return None,
            Read::Carried(at) => carried_name(at),
            Read::Each(at) => {
                let name = format_ident!("operand_{}", self.known.len() + 1);
                let value = element(self.context, &self.repeated.columns[at]);
                self.reads.extend(quote!(let #name = #value;));
                name
            }
        };
        let tokens = name.to_token_stream();
        self.known.insert(read, name);
        Some(tokens)
    }
}

/// The vectors that a loop reads.
pub fn vectors(repeated: &Loop<Vector>) -> BTreeSet<Vector> {
    let vector = |column: &Column<Vector>| match column {
        Column::Elements(Home::Vector(vector), _) => Some(*vector),
        _ => None,
    };
    repeated.columns.iter().filter_map(vector).collect()
}

/// The operand of a copy, which is another one each time.
pub fn element(context: &Context<'_>, column: &Column<Vector>) -> TokenStream {
    let (runtime, this) = (&context.names.runtime, &context.access.this);
    let (home, rule) = match column {
        Column::Numbers(numbers) => {
            let count = numbers.len();
            let numbers = numbers.iter().map(|number| Literal::f64_unsuffixed(number.to_f64()));
            return quote!(T::from_f64(#runtime::__private::read(
                &{ const NUMBERS: [::core::primitive::f64; #count] = [#(#numbers),*]; NUMBERS },
                copy,
            )));
        }
        Column::Elements(home, rule) => (home, rule),
    };
    let values = match home {
        Home::Result(array) => places::array(*array).to_token_stream(),
        Home::Hoisted => quote!(&#this.hoisted),
        Home::Vector(vector) => vector.ident().to_token_stream(),
    };
    let place = place(*rule);
    quote!(#runtime::__private::read(#values, #place))
}

/// Stores a result of every copy at once; nothing, where only the last one is kept.
pub fn store(context: &Context<'_>, kept: Kept, value: &impl ToTokens) -> TokenStream {
    let Kept::Each(array, rule) = kept else { return TokenStream::new() };
    let (runtime, array, place) = (&context.names.runtime, places::array(array), place(rule));
    quote!(#runtime::__private::write(#array, #place, #value);)
}

/// The place that goes with a copy: by a rule, or else from a table.
fn place(rule: Rule) -> TokenStream {
    let literal = Literal::usize_unsuffixed;
    match rule {
        Rule::Line { first, step, is_down } => {
            let (start, factor) = (literal(first), literal(step));
            match (first, step, is_down) {
                (0, 1, false) => quote!(copy),
                (_, 1, false) => quote!(#start + copy),
                (_, 1, true) => quote!(#start - copy),
                (0, _, false) => quote!(#factor * copy),
                (_, _, false) => quote!(#start + #factor * copy),
                (_, _, true) => quote!(#start - #factor * copy),
            }
        }
        Rule::Table(table) => {
            let name = place_name(table);
            quote!(#name as ::core::primitive::usize)
        }
    }
}

/// `for copy in …`, with the rows of the tables.
pub fn head(repeated: &Loop<Vector>) -> TokenStream {
    let (tables, count) = (&repeated.tables, repeated.repetition.count);
    let copies = Literal::usize_unsuffixed(count);
    if tables.is_empty() {
        return quote!(for copy in 0..#copies);
    }
    let rows = (0..count).map(|copy| {
        let places = tables.iter().map(|table| Literal::usize_unsuffixed(table[copy]));
        quote!([#(#places),*])
    });
    let names = (0..tables.len()).map(place_name);
    let columns = Literal::usize_unsuffixed(tables.len());
    quote! {
        const PLACES: [[::core::primitive::u32; #columns]; #copies] = [#(#rows),*];
        for (copy, &[#(#names),*]) in PLACES.iter().enumerate()
    }
}

/// Variables for results of the copy before: their first values, and how they change at the
/// end of a copy.
pub fn carried_values(repeated: &Loop<Vector>, writer: &Writer<'_>) -> (TokenStream, TokenStream) {
    let (mut before, mut after) = (TokenStream::new(), TokenStream::new());
    for (at, &Carried { from, first }) in repeated.carried.iter().enumerate() {
        let (name, first) = (carried_name(at), writer.operand(first));
        let next = writer
            .result(repeated.repetition.start + from)
            .map_or_else(|| tokens::internal("a loop has no result to carry"), ToTokens::to_token_stream);
        before.extend(quote!(let mut #name = #first;));
        after.extend(quote!(#name = #next;));
    }
    (before, after)
}

pub fn carried_name(at: usize) -> Ident {
    format_ident!("carried_{}", at + 1)
}

fn place_name(table: usize) -> Ident {
    format_ident!("place_{}", table + 1)
}
