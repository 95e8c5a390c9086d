//! Long programs as functions of bounded size, so that the compiler's time and
//! memory grow linearly with a chain.
//!
//! Results that a later part needs are kept in an array of slots; a slot is free
//! again behind its last reader.

use mbs_symbolic::{Operand, Program};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::access::Access;
use super::names::Names;
use super::program::{Body, Writer};
use crate::model::Model;

/// Programs with more instructions than this are split.
pub const LONGEST: usize = 1024;

/// Instructions per part.
const PART: usize = 256;

/// Calls of the parts, their definitions before them, and the outputs.
pub fn body(model: &Model, names: &Names, program: &Program, access: &Access) -> Body {
    let inside = access.in_part(names);
    let mut writer = Writer::new(model, program, &inside);
    let mut slots = Slots::new(program);
    let mut definitions = TokenStream::new();
    let mut calls = TokenStream::new();
    let all: Vec<usize> = (0..program.instructions.len()).collect();
    for (part, instructions) in all.chunks(PART).enumerate() {
        for &at in instructions {
            writer.instruction(at);
        }
        let results = writer.take_names();
        let used: Vec<usize> = results.iter().map(|(at, _)| *at).collect();
        slots.release(part);
        for (at, name) in results {
            let Some(slot) = slots.keep(at, part) else { continue };
            let slot = Literal::usize_unsuffixed(slot);
            writer.statements.extend(quote!(slots[#slot] = #name;));
            writer.references[at] = Some(quote!(slots[#slot]));
        }
        let function = format_ident!("part_{}", part + 1);
        let arguments = access.arguments(model, names, program, &used);
        let (declarations, values) =
            (arguments.iter().map(|a| &a.declaration), arguments.iter().map(|a| &a.value));
        let statements = std::mem::take(&mut writer.statements);
        let runtime = &names.runtime;
        definitions.extend(quote! {
            #[inline(never)]
            fn #function<T: #runtime::Real>(#(#declarations,)* slots: &mut [T; SLOTS]) { #statements }
        });
        calls.extend(quote!(#function(#(#values,)* &mut slots);));
    }
    // outside the parts, symbols are read as the function around them reads them
    let mut outside = Writer::new(model, program, access);
    outside.references = writer.references;
    let outputs = program.outputs.iter().map(|&output| outside.operand(output)).collect();
    let length = Literal::usize_unsuffixed(slots.last_readers.len());
    let statements = quote! {
        const SLOTS: ::core::primitive::usize = #length;
        #definitions
        let mut slots = [T::from_f64(0.0); SLOTS];
        #calls
    };
    Body { statements, outputs }
}

struct Slots {
    /// Per instruction, the last part that reads its result; `None` if nothing does.
    readers: Vec<Option<usize>>,
    /// Per slot, the last part that reads what it holds.
    last_readers: Vec<usize>,
    free: Vec<usize>,
}

impl Slots {
    fn new(program: &Program) -> Self {
        let mut readers = vec![None; program.instructions.len()];
        let mut read = |operand: Operand, part: usize| {
            if let Operand::Value(value) = operand {
                readers[value] = readers[value].max(Some(part));
            }
        };
        for (at, instruction) in program.instructions.iter().enumerate() {
            read(instruction.a, at / PART);
            read(instruction.b, at / PART);
        }
        program.outputs.iter().for_each(|&output| read(output, usize::MAX));
        Self { readers, last_readers: Vec::new(), free: Vec::new() }
    }

    /// Frees what this part is the last to read: it stores behind its reading.
    fn release(&mut self, part: usize) {
        for (slot, last) in self.last_readers.iter_mut().enumerate() {
            if *last <= part {
                *last = usize::MAX - 1;
                self.free.push(slot);
            }
        }
    }

    /// A slot for a result of this part that a later one reads.
    fn keep(&mut self, at: usize, part: usize) -> Option<usize> {
        let last = self.readers[at].filter(|last| *last > part)?;
        let slot = self.free.pop().unwrap_or(self.last_readers.len());
        if slot == self.last_readers.len() {
            self.last_readers.push(last);
        }
        self.last_readers[slot] = last;
        Some(slot)
    }
}
