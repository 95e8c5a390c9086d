//! Copies of the same instructions as a loop.

use std::collections::BTreeSet;
use std::ops::Range;

use mbs_symbolic::{Function, Operand, Operation, Repetition, Source};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::arrays::Arrays;
use super::columns::Columns;
use super::slots::{Kept, Place};
use super::{Context, Part};
use crate::target::rust::program::Writer;

/// A loop over the copies.
pub fn part(context: &Context<'_>, repetition: Repetition, arrays: &mut Arrays, name: Ident) -> Part {
    let Context { compiled, names, program, access, pairs, slots } = *context;
    let first_copy = repetition.start..repetition.start + repetition.length;
    let sources: Vec<[Source; 2]> =
        (0..repetition.length).map(|at| repetition.sources(program, at)).collect();

    let mut simple = Columns::new(context, repetition);
    if let Some(statements) = angles(context, &mut simple, &first_copy, &sources) {
        let arguments = simple.arrays.iter().map(|&array| arrays.argument(array, compiled, access)).collect();
        let doc = Some(format!(" {} angles.", repetition.count * repetition.length / 2));
        return Part { name, doc, statements, arguments };
    }
    let mut columns = Columns::new(context, repetition);
    let mut writer = Writer::new(compiled, program, access, pairs, first_copy.clone()).with_slots(slots);
    for at in first_copy.clone() {
        let partner = pairs.partner(at).filter(|partner| first_copy.contains(partner));
        if partner.is_some_and(|p| sources[p - first_copy.start] != sources[at - first_copy.start]) {
            writer.set_apart(at);
        }
    }
    let mut around = Around::default();
    for (at, sources) in first_copy.clone().zip(&sources) {
        let [a, b] = sources.each_ref().map(|source| columns.read(source));
        writer.statements.extend(std::mem::take(&mut columns.reads));
        writer.instruction_of(at, [a, b]);
        // a sine comes with its cosine
        for at in [Some(at), pairs.partner(at)].into_iter().flatten() {
            if let Some(value) = writer.result(at).filter(|_| around.kept.insert(at)) {
                let statement = keep(&mut columns, &mut around, at, value);
                writer.statements.extend(statement);
            }
        }
    }
    let (first, next) = columns.carried_values(&writer);
    let head = columns.head();
    let body = writer.statements;
    let Around { before, after, .. } = around;
    let statements = quote!(#before #first #head { #body #next } #after);

    let operands: Vec<Operand> = sources.iter().flatten().filter_map(first_operand).collect();
    let mut arguments = access.arguments(compiled, names, &operands);
    arguments.extend(columns.arrays.iter().map(|&array| arrays.argument(array, compiled, access)));
    let doc = format!(" {} instructions, {} times.", repetition.length, repetition.count);
    Part { name, doc: Some(doc), statements, arguments }
}

/// Statements around a loop.
#[derive(Default)]
struct Around {
    before: TokenStream,
    after: TokenStream,
    /// The instructions whose results are kept so far.
    kept: BTreeSet<usize>,
}

/// Keeps the result of an instruction: that of every copy at once, that of the last one
/// after the loop.
fn keep(columns: &mut Columns<'_>, around: &mut Around, at: usize, value: &Ident) -> TokenStream {
    let Context { names, slots, .. } = *columns.context;
    match slots.of_copies(&columns.repetition, at) {
        Kept::No => TokenStream::new(),
        Kept::Each(array, places) => {
            let (runtime, array, place) = (&names.runtime, array.ident(), columns.place(places));
            quote!(#runtime::__private::write(#array, #place, #value);)
        }
        Kept::Last(Place { array, at }) => {
            let last = format_ident!("last_{}", around.kept.len());
            let (array, place) = (array.ident(), Literal::usize_unsuffixed(at));
            around.before.extend(quote!(let mut #last = T::from_f64(0.0);));
            around.after.extend(quote!(#array[#place] = #last;));
            quote!(#last = #value;)
        }
    }
}

/// Loops over the sines and cosines of components, which are taken two at once, if
/// the copies have nothing else.
fn angles(
    context: &Context<'_>,
    columns: &mut Columns<'_>,
    first_copy: &Range<usize>,
    sources: &[[Source; 2]],
) -> Option<TokenStream> {
    let Context { names, program, pairs, slots, .. } = *context;
    let runtime = &names.runtime;
    let count = Literal::usize_unsuffixed(columns.repetition.count);
    let mut statements = TokenStream::new();
    for (at, [source, _]) in first_copy.clone().zip(sources) {
        let partner = pairs.partner(at).filter(|partner| first_copy.contains(partner))?;
        let Source::Each(operands) = source else { return None };
        let is_of_components = operands.iter().all(|operand| matches!(operand, Operand::Symbol(_)));
        if !is_of_components || sources[partner - first_copy.start][0] != *source {
            return None;
        }
        if partner < at {
            continue;
        }
        let angle = columns.each(operands);
        let is_sine = program.instructions[at].operation == Operation::Call(Function::Sin);
        let results = if is_sine { ["sine", "cosine"] } else { ["cosine", "sine"] };
        let mut kept = TokenStream::new();
        for (at, result) in [at, partner].into_iter().zip(results) {
            match slots.of_copies(&columns.repetition, at) {
                Kept::No => {}
                // the others would have to be left out
                Kept::Last(_) => return None,
                Kept::Each(array, places) => {
                    let (array, place) = (array.ident(), columns.place(places));
                    let result = format_ident!("{result}");
                    kept.extend(quote!(#runtime::__private::write(#array, #place, #result);));
                }
            }
        }
        statements.extend(quote! {
            #runtime::__private::sin_cos_each(#count, |copy| #angle, |copy, sine, cosine| { #kept });
        });
    }
    // places from a table would need the loop
    columns.tables.is_empty().then_some(statements)
}

/// What the function of a loop has to reach besides slots and arrays.
fn first_operand(source: &Source) -> Option<Operand> {
    match source {
        Source::Own(_) => None,
        Source::Same(operand) | Source::Carried(_, operand) => Some(*operand),
        Source::Each(operands) => operands.first().copied().filter(|o| matches!(o, Operand::Hoisted(_))),
    }
}
