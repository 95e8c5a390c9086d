//! Copies of the same instructions as a loop.

use std::collections::BTreeSet;

use mbs_symbolic::layout::{Angle, Carried, Column, Home, Loop, Read};
use mbs_symbolic::{Function, Inconsistency, Operand, Operation, Repetition};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::around::Around;
use super::arrays::Arrays;
use super::columns::{Columns, carried_values, element, head, store, vectors};
use super::context::{Context, Definition};
use super::paired;
use crate::compiled::Vector;
use crate::targets::rust::writer::Writer;

/// A loop over the copies.
pub fn definition(
    context: &Context<'_>,
    repeated: &Loop<Vector>,
    arrays: &mut Arrays,
    name: Ident,
) -> Result<Definition, Inconsistency> {
    let Context { compiled, names, access, .. } = *context;
    let Repetition { length, count, .. } = repeated.repetition;
    let (doc, statements, mut arguments) = match repeated.angles() {
        Some(steps) => {
            (format!(" {} angles.", count * length / 2), angles(context, repeated, &steps), vec![])
        }
        None => {
            let arguments = access.arguments(compiled, names, &operands(repeated));
            let statements = match repeated.woven(context.program)? {
                Some(copy) => paired::copies(context, repeated, &copy),
                None => copies(context, repeated),
            };
            (format!(" {length} instructions, {count} times."), statements, arguments)
        }
    };
    let vectors = vectors(repeated).into_iter();
    arguments.extend(vectors.map(|vector| arrays.argument(vector, compiled, access)));
    Ok(Definition { name, doc: Some(doc), statements, arguments })
}

/// The copies, one after the other.
fn copies(context: &Context<'_>, repeated: &Loop<Vector>) -> TokenStream {
    let Context { compiled, program, access, pairs, layout, .. } = *context;
    let Repetition { start, length, .. } = repeated.repetition;
    let mut writer = Writer::new(compiled, program, access, pairs, start..start + length).with_layout(layout);
    for (at, step) in repeated.steps.iter().enumerate() {
        if step.partner.is_none() {
            writer.set_apart(start + at);
        }
    }
    let mut columns = Columns::new(context, repeated);
    let mut around = Around::default();
    let mut kept = BTreeSet::new();
    for (at, step) in repeated.steps.iter().enumerate() {
        let operands = step.operands.map(|read| columns.read(read));
        writer.statements.extend(std::mem::take(&mut columns.reads));
        writer.instruction_of(start + at, operands);
        // a sine comes with its cosine
        for at in [Some(at), step.partner].into_iter().flatten() {
            if let Some(value) = writer.result(start + at).filter(|_| kept.insert(at)) {
                let statement = around.keep(context, repeated.steps[at].kept, value);
                writer.statements.extend(statement);
            }
        }
    }
    let (first, next) = carried_values(repeated, &writer);
    let head = head(repeated);
    let body = writer.statements;
    let Around { before, after, .. } = around;
    quote!(#before #first #head { #body #next } #after)
}

/// Loops over the sines and cosines of components, which are taken two at once.
fn angles(context: &Context<'_>, repeated: &Loop<Vector>, angles: &[Angle]) -> TokenStream {
    let Context { names, program, .. } = *context;
    let runtime = &names.runtime;
    let Repetition { start, count, .. } = repeated.repetition;
    let count = Literal::usize_unsuffixed(count);
    let statements = angles.iter().map(|Angle { column, steps }| {
        let angle = element(context, &repeated.columns[*column]);
        let is_sine = program.instructions[start + steps[0]].operation == Operation::Call(Function::Sin);
        let results = if is_sine { ["sine", "cosine"] } else { ["cosine", "sine"] };
        let stores = steps
            .iter()
            .zip(results)
            .map(|(&at, result)| store(context, repeated.steps[at].kept, &format_ident!("{result}")));
        quote! {
            #runtime::__private::sin_cos_each(#count, |copy| #angle, |copy, sine, cosine| { #(#stores)* });
        }
    });
    statements.collect()
}

/// The operands that the function of a loop has to reach besides slots and arrays.
fn operands(repeated: &Loop<Vector>) -> Vec<Operand> {
    let same = repeated.steps.iter().flat_map(|step| step.operands).filter_map(|read| match read {
        Read::Same(operand) => Some(operand),
        Read::Own(_) | Read::Carried(_) | Read::Each(_) => None,
    });
    let carried = repeated.carried.iter().map(|Carried { first, .. }| *first);
    let hoisted = repeated.columns.iter().filter_map(|column| match column {
        Column::Elements(Home::Hoisted, rule) => Some(Operand::Hoisted(rule.at(0, &repeated.tables))),
        _ => None,
    });
    same.chain(carried).chain(hoisted).collect()
}
