//! Long programs: what repeats itself as loops, the rest as functions of bounded
//! size, so that code and the compiler's time grow with the number of different
//! parts of a chain.
//!
//! The [layout](mbs_symbolic::layout) says what is written where.
//!
//! Every operation is done on the same operands as in straight lines, so results agree to the bit
//! (`tests/tests/loops.rs`). `paired` writes a copy on pairs where that saves an eighth of its operations.

mod around;
mod arrays;
mod columns;
mod context;
mod paired;
mod repeated;

use std::collections::BTreeSet;

use mbs_symbolic::layout::{Array, Part, Straight};
use mbs_symbolic::{Block, Inconsistency, Operand, Program, SinCos};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use self::arrays::Arrays;
use self::context::{Context, Definition};
use super::access::{Access, Argument};
use super::body::Body;
use super::names::Names;
use super::places;
use super::writer::Writer;
use crate::compiled::Compiled;

/// The functions of a program, and the statements that call them.
#[derive(Default)]
struct Functions {
    definitions: TokenStream,
    calls: TokenStream,
}

impl Functions {
    /// Adds a function, which is also given these arrays.
    fn add(&mut self, definition: Definition, results: &[Argument], names: &Names, access: &Access) {
        let Definition { name, doc, statements, arguments } = definition;
        let doc = doc.map(|doc| quote!(#[doc = #doc]));
        let arguments = || arguments.iter().chain(results);
        let declarations = arguments().map(|argument| &argument.declaration);
        let values = arguments().map(|argument| &argument.value);
        let slots = if access.is_on_arrays() { quote!(slots) } else { quote!(&mut slots) };
        let runtime = &names.runtime;
        self.definitions.extend(quote! {
            #doc
            #[inline(never)]
            fn #name<T: #runtime::Real>(#(#declarations,)* slots: &mut [T; SLOTS]) { #statements }
        });
        self.calls.extend(quote!(#name(#(#values,)* #slots);));
    }
}

/// Definitions and calls of the functions, and the outputs. Where access is to arrays, the
/// slots are given too, and `SLOTS` is how many.
///
/// # Errors
/// The layout does not compute what the program does.
pub fn body(
    compiled: &Compiled,
    names: &Names,
    program: &Program,
    access: &Access,
    blocks: &[Block],
) -> Result<Body, Inconsistency> {
    let lengths = results(compiled, program, access);
    let layout = compiled.layout(program, blocks, &lengths)?;
    let results: Vec<Argument> = lengths.iter().enumerate().map(result_argument).collect();
    let pairs = SinCos::of(program);
    let inside = access.in_part(names);
    let context = Context { compiled, names, program, access: &inside, pairs: &pairs, layout: &layout };
    let (mut arrays, mut functions) = (Arrays::default(), Functions::default());
    for (at, part) in layout.parts.iter().enumerate() {
        let number = at + 1;
        let definition = match part {
            Part::Straight(part) => straight(&context, part, &mut arrays, format_ident!("part_{number}")),
            Part::Loop(part) => {
                repeated::definition(&context, part, &mut arrays, format_ident!("repeated_{number}"))?
            }
        };
        functions.add(definition, &results, names, access);
    }
    let Functions { definitions, calls } = functions;
    // outside the functions, symbols are read as the function around them reads them
    let outside = Writer::new(compiled, program, access, &pairs, 0..0).with_layout(&layout);
    let outputs = program.outputs.iter().map(|&output| outside.operand(output)).collect();
    let given = layout.given.iter().map(|(operand, place)| {
        let (value, place) = (outside.operand(*operand), places::element(*place));
        quote!(#place = #value;)
    });
    let arrays = arrays.declarations(names, access);
    let room = (!access.is_on_arrays()).then(|| room(layout.slots));
    let statements = quote!(#room #definitions #arrays #calls #(#given)*);
    let places = Some(layout.outputs.clone());
    Ok(Body { statements, outputs, places, slots: layout.slots, runtime: names.runtime.clone() })
}

/// The slots, where they are not given.
fn room(slots: usize) -> TokenStream {
    let length = Literal::usize_unsuffixed(slots);
    quote! {
        const SLOTS: ::core::primitive::usize = #length;
        let mut slots = [T::from_f64(0.0); SLOTS];
    }
}

/// The lengths of the arrays of results that stages on arrays are given: q̈, and the
/// feedback where the first stage gives it.
fn results(compiled: &Compiled, program: &Program, access: &Access) -> Vec<usize> {
    if !access.is_on_arrays() {
        return Vec::new();
    }
    let (s, m) = (compiled.states.len(), compiled.constraints.len());
    let has_feedback = m > 0 && program.outputs.len() > s + m;
    [s].into_iter().chain(has_feedback.then_some(m)).collect()
}

/// An array of results as an argument of a function.
fn result_argument((at, length): (usize, &usize)) -> Argument {
    let (array, length) = (places::array(Array::Result(at)), Literal::usize_unsuffixed(*length));
    Argument { declaration: quote!(#array: &mut [T; #length]), value: quote!(#array) }
}

/// Instructions that are written once.
fn straight(context: &Context<'_>, part: &Straight, arrays: &mut Arrays, name: Ident) -> Definition {
    let Context { compiled, names, program, access, pairs, layout } = *context;
    let Straight { range, kept } = part;
    let mut writer = Writer::new(compiled, program, access, pairs, range.clone()).with_layout(layout);
    range.clone().for_each(|at| writer.instruction(at));
    for &(at, place) in kept {
        if let Some(value) = writer.result(at) {
            let place = places::element(place);
            writer.statements.extend(quote!(#place = #value;));
        }
    }
    let instructions = &program.instructions[range.clone()];
    let operands: Vec<Operand> =
        instructions.iter().flat_map(|instruction| [instruction.a, instruction.b]).collect();
    let mut arguments = access.arguments(compiled, names, &operands);
    let vector = |operand: &Operand| Some(compiled.input_of(*operand)?.component()?.vector);
    let given: BTreeSet<_> = operands.iter().filter_map(vector).collect();
    let given = given.into_iter().filter(|vector| access.has_array(*vector));
    arguments.extend(given.map(|vector| arrays.argument(vector, compiled, access)));
    Definition { name, doc: None, statements: writer.statements, arguments }
}
