//! Copies of the same instructions as a loop.

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use mbs_symbolic::{Function, Operand, Operation, Repetition, Source};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::arrays::{Array, Arrays};
use super::slots::{Kept, Place};
use super::{Context, Part};
use crate::emit::program::Writer;

/// A loop over the copies.
pub fn part(context: &Context<'_>, repetition: Repetition, arrays: &mut Arrays, name: Ident) -> Part {
    let Context { model, names, program, access, pairs, slots } = *context;
    let runtime = &names.runtime;
    let first_copy = repetition.start..repetition.start + repetition.length;
    let sources: Vec<[Source; 2]> =
        (0..repetition.length).map(|at| repetition.sources(program, at)).collect();

    let mut simple = Columns::new(context, repetition);
    if let Some(statements) = angles(context, &mut simple, &first_copy, &sources) {
        let arguments = simple.arrays.iter().map(|&array| arrays.argument(array, model, access)).collect();
        let doc = Some(format!(" {} angles.", repetition.count));
        return Part { name, doc, statements, arguments };
    }
    let mut columns = Columns::new(context, repetition);
    let mut writer = Writer::new(model, program, access, pairs, first_copy.clone()).with_slots(slots);
    for at in first_copy.clone() {
        let partner = pairs.partner(at).filter(|partner| first_copy.contains(partner));
        if partner.is_some_and(|p| sources[p - first_copy.start] != sources[at - first_copy.start]) {
            writer.set_apart(at);
        }
    }
    let (mut before, mut after) = (TokenStream::new(), TokenStream::new());
    let mut kept = BTreeSet::new();
    for (at, sources) in first_copy.clone().zip(&sources) {
        let [a, b] = sources.each_ref().map(|source| columns.read(source));
        writer.statements.extend(std::mem::take(&mut columns.reads));
        writer.instruction_of(at, [a, b]);
        // a sine comes with its cosine
        for at in [Some(at), pairs.partner(at)].into_iter().flatten() {
            let Some(value) = writer.result(at).filter(|_| kept.insert(at)) else { continue };
            match slots.of_copies(&repetition, at) {
                Kept::No => {}
                Kept::Each(array, places) => {
                    let (array, place) = (array.ident(), columns.place(places));
                    writer.statements.extend(quote!(#runtime::__private::write(#array, #place, #value);));
                }
                Kept::Last(Place { array, at }) => {
                    let last = format_ident!("last_{}", kept.len());
                    let (array, place) = (array.ident(), Literal::usize_unsuffixed(at));
                    before.extend(quote!(let mut #last = T::from_f64(0.0);));
                    writer.statements.extend(quote!(#last = #value;));
                    after.extend(quote!(#array[#place] = #last;));
                }
            }
        }
    }
    let (first, next) = columns.carried_values(&writer);
    let head = columns.head();
    let body = writer.statements;
    let statements = quote!(#before #first #head { #body #next } #after);

    let operands: Vec<Operand> = sources.iter().flatten().filter_map(first_operand).collect();
    let mut arguments = access.arguments(model, names, &operands);
    arguments.extend(columns.arrays.iter().map(|&array| arrays.argument(array, model, access)));
    let doc = format!(" {} instructions, {} times.", repetition.length, repetition.count);
    Part { name, doc: Some(doc), statements, arguments }
}

/// A loop over the sines and cosines of components, which are taken two at once.
fn angles(
    context: &Context<'_>,
    columns: &mut Columns<'_>,
    first_copy: &Range<usize>,
    sources: &[[Source; 2]],
) -> Option<TokenStream> {
    let Context { names, program, pairs, slots, .. } = *context;
    let [[source, _], [other, _]] = sources else { return None };
    let Source::Each(operands) = source else { return None };
    let is_pair = pairs.partner(first_copy.start) == Some(first_copy.start + 1) && source == other;
    if !is_pair || !operands.iter().all(|operand| matches!(operand, Operand::Symbol(_))) {
        return None;
    }
    let angle = columns.each(operands);
    let is_sine = program.instructions[first_copy.start].operation == Operation::Call(Function::Sin);
    let results = if is_sine { ["sine", "cosine"] } else { ["cosine", "sine"] };
    let runtime = &names.runtime;
    let mut kept = TokenStream::new();
    for (at, result) in first_copy.clone().zip(results) {
        // of a last one alone the others would have to be left out
        if let Kept::Last(_) = slots.of_copies(&columns.repetition, at) {
            return None;
        }
        if let Kept::Each(array, places) = slots.of_copies(&columns.repetition, at) {
            let (array, place, result) = (array.ident(), columns.place(places), format_ident!("{result}"));
            kept.extend(quote!(#runtime::__private::write(#array, #place, #result);));
        }
    }
    // places from a table would need the loop
    columns.tables.is_empty().then(|| {
        let count = Literal::usize_unsuffixed(columns.repetition.count);
        quote!(#runtime::__private::sin_cos_each(#count, |copy| #angle, |copy, sine, cosine| { #kept });)
    })
}

/// What the function of a loop has to reach besides slots and arrays.
fn first_operand(source: &Source) -> Option<Operand> {
    match source {
        Source::Own(_) => None,
        Source::Same(operand) | Source::Carried(_, operand) => Some(*operand),
        Source::Each(operands) => operands.first().copied().filter(|o| matches!(o, Operand::Hoisted(_))),
    }
}

/// What differs from copy to copy: how it is read.
struct Columns<'a> {
    context: &'a Context<'a>,
    repetition: Repetition,
    /// Statements that read what the next instruction needs.
    reads: TokenStream,
    known: HashMap<Source, TokenStream>,
    /// The vectors that are read.
    arrays: BTreeSet<Array>,
    /// Places without a rule, one per copy.
    tables: Vec<Vec<usize>>,
    /// Variables that hold a result of the copy before, its instruction, and
    /// their value in the first copy.
    carried: Vec<(Ident, usize, Operand)>,
}

impl<'a> Columns<'a> {
    fn new(context: &'a Context<'a>, repetition: Repetition) -> Self {
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
    fn read(&mut self, source: &Source) -> Option<TokenStream> {
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

    fn each(&mut self, operands: &[Operand]) -> TokenStream {
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
    fn place(&mut self, places: Vec<usize>) -> TokenStream {
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
    fn head(&self) -> TokenStream {
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
    fn carried_values(&self, writer: &Writer<'_>) -> (TokenStream, TokenStream) {
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
