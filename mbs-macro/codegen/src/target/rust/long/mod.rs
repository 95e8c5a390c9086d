//! Long programs: what repeats itself as loops, the rest as functions of bounded
//! size, so that code and the compiler's time grow with the number of different
//! parts of a chain.
//!
//! Results that a later block needs are kept in an array of slots.

mod arrays;
mod check;
mod columns;
mod repeated;
mod slots;

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use mbs_symbolic::{Block, Operand, Program};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

pub use self::arrays::Array;
use self::arrays::Arrays;
pub use self::slots::{Kind, Place, Slots};
use super::access::{Access, Argument};
use super::names::Names;
use super::program::{Body, Pairs, Writer};
use crate::compiled::{Compiled, Input};

/// A program that is not to have loops is one function up to this length, whatever was
/// asked for: rustc nests a scope per statement, and its stack ends at about twice as many.
const LONGEST: usize = 3072;

/// Longer sequences are written as functions of this many instructions.
const PART: usize = 256;

/// The program in the blocks that are emitted; one block is written in place.
pub fn blocks(compiled: &Compiled, program: &Program) -> Vec<Block> {
    let length = program.instructions.len();
    if length <= compiled.choices.unrolled {
        let is_one = length <= LONGEST;
        return if is_one { vec![Block::Straight(0..length)] } else { parts(0..length).collect() };
    }
    let blocks = program.blocks(&|symbol| class(compiled.input(symbol)));
    let split = |block| match block {
        Block::Straight(range) => parts(range).collect(),
        repeated => vec![repeated],
    };
    blocks.into_iter().flat_map(split).collect()
}

fn parts(range: Range<usize>) -> impl Iterator<Item = Block> {
    range.clone().step_by(PART).map(move |start| Block::Straight(start..range.end.min(start + PART)))
}

/// Symbols with equal numbers are components of one vector.
fn class(input: Input) -> usize {
    match input {
        Input::Time => 0,
        Input::MinusTwoAlpha => 1,
        Input::MinusBetaSquared => 2,
        Input::Parameter(_) => 3,
        Input::Input(_) => 4,
        Input::Position(_) => 5,
        Input::Velocity(_) => 6,
        Input::Acceleration(_) => 7,
        Input::Multiplier(_) => 8,
        Input::Feedback(_) => 9,
        Input::Step => 10,
        Input::HalfStep => 11,
        Input::NextTime => 12,
    }
}

/// What the functions of a program share.
struct Context<'a> {
    compiled: &'a Compiled,
    names: &'a Names,
    program: &'a Program,
    /// How symbols are read within the functions.
    access: &'a Access,
    pairs: &'a Pairs,
    slots: &'a Slots,
}

/// The statements of a function, and what it takes.
struct Part {
    name: Ident,
    doc: Option<String>,
    statements: TokenStream,
    arguments: Vec<Argument>,
}

/// Definitions and calls of the functions, and the outputs. Where access is to arrays, the
/// slots are given too, and `SLOTS` is how many.
pub fn body(
    compiled: &Compiled,
    names: &Names,
    program: &Program,
    access: &Access,
    blocks: &[Block],
) -> Body {
    let results = results(compiled, program, access);
    let slots = Slots::new(program, blocks, &results);
    if let Err(fault) = check::check(program, blocks, &slots) {
        names.faults.borrow_mut().push(fault);
    }
    let pairs = Pairs::new(program);
    let inside = access.in_part(names);
    let context = Context { compiled, names, program, access: &inside, pairs: &pairs, slots: &slots };
    let mut arrays = Arrays::default();
    let given_slots = if access.is_on_arrays() { quote!(slots) } else { quote!(&mut slots) };
    let (mut definitions, mut calls) = (TokenStream::new(), TokenStream::new());
    for (at, block) in blocks.iter().enumerate() {
        let number = at + 1;
        let part = match block {
            Block::Straight(range) => {
                straight(&context, range.clone(), &mut arrays, format_ident!("part_{number}"))
            }
            Block::Repeated(repetition) => {
                repeated::part(&context, *repetition, &mut arrays, format_ident!("repeated_{number}"))
            }
        };
        let Part { name, doc, statements, mut arguments } = part;
        arguments.extend(results.iter().map(|(array, length)| {
            let (array, length) = (array.ident(), Literal::usize_unsuffixed(*length));
            Argument { declaration: quote!(#array: &mut [T; #length]), value: quote!(#array) }
        }));
        let doc = doc.map(|doc| quote!(#[doc = #doc]));
        let declarations = arguments.iter().map(|argument| &argument.declaration);
        let values = arguments.iter().map(|argument| &argument.value);
        let runtime = &names.runtime;
        definitions.extend(quote! {
            #doc
            #[inline(never)]
            fn #name<T: #runtime::Real>(#(#declarations,)* slots: &mut [T; SLOTS]) { #statements }
        });
        calls.extend(quote!(#name(#(#values,)* #given_slots);));
    }
    // outside the functions, symbols are read as the function around them reads them
    let outside = Writer::new(compiled, program, access, &pairs, 0..0).with_slots(&slots);
    let outputs: Vec<_> = program.outputs.iter().map(|&output| outside.operand(output)).collect();
    let Outputs { places, length, statements: rest } = Outputs::new(program, &slots, &outputs);
    let arrays = arrays.declarations(names, access);
    let room = (!access.is_on_arrays()).then(|| {
        let length = Literal::usize_unsuffixed(length);
        quote! {
            const SLOTS: ::core::primitive::usize = #length;
            let mut slots = [T::from_f64(0.0); SLOTS];
        }
    });
    let statements = quote!(#room #definitions #arrays #calls #rest);
    Body { statements, outputs, places: Some(places), slots: length, runtime: names.runtime.clone() }
}

/// Where outputs are kept.
struct Outputs {
    places: Vec<Place>,
    /// How many slots there are with those of outputs that no instruction computes,
    length: usize,
    /// and what fills these.
    statements: TokenStream,
}

impl Outputs {
    fn new(program: &Program, slots: &Slots, values: &[TokenStream]) -> Self {
        let (mut length, mut statements) = (slots.len(), TokenStream::new());
        let mut others: HashMap<Operand, Place> = HashMap::new();
        let place = |(&output, value): (&Operand, &TokenStream)| {
            let known = match output {
                Operand::Value(at) => slots.of(at),
                other => others.get(&other).copied(),
            };
            known.unwrap_or_else(|| {
                let (at, place) =
                    (Literal::usize_unsuffixed(length), Place { array: Kind::Slots, at: length });
                statements.extend(quote!(slots[#at] = #value;));
                others.insert(output, place);
                length += 1;
                place
            })
        };
        let places = program.outputs.iter().zip(values).map(place).collect();
        Self { places, length, statements }
    }
}

/// The arrays of results that stages on arrays are given, and their lengths.
fn results(compiled: &Compiled, program: &Program, access: &Access) -> Vec<(Kind, usize)> {
    if !access.is_on_arrays() {
        return Vec::new();
    }
    let (n, m) = (compiled.coordinates.len(), compiled.constraints.len());
    let has_feedback = m > 0 && program.outputs.len() > n + m;
    let feedback = has_feedback.then_some((Kind::Feedback, m));
    [(Kind::Acceleration, n)].into_iter().chain(feedback).collect()
}

/// Instructions that are written once.
fn straight(context: &Context<'_>, range: Range<usize>, arrays: &mut Arrays, name: Ident) -> Part {
    let Context { compiled, names, program, access, pairs, slots } = *context;
    let mut writer = Writer::new(compiled, program, access, pairs, range.clone()).with_slots(slots);
    range.clone().for_each(|at| writer.instruction(at));
    for at in range.clone() {
        if let (Some(slot), Some(value)) = (slots.token(at), writer.result(at)) {
            writer.statements.extend(quote!(#slot = #value;));
        }
    }
    let operands: Vec<Operand> =
        program.instructions[range].iter().flat_map(|instruction| [instruction.a, instruction.b]).collect();
    let mut arguments = access.arguments(compiled, names, &operands);
    if access.is_on_arrays() {
        let vector = |operand: &Operand| match operand {
            Operand::Symbol(symbol) => Array::of(compiled.input(*symbol)),
            _ => None,
        };
        let given: BTreeSet<_> = operands.iter().filter_map(vector).map(|(array, _)| array).collect();
        let given = given.into_iter().filter(|array| array.is_given());
        arguments.extend(given.map(|array| arrays.argument(array, compiled, access)));
    }
    Part { name, doc: None, statements: writer.statements, arguments }
}
