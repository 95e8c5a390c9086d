//! From expressions to programs.
//!
//! 1. `flatten` turns nodes into rows of factors and of signed summands, with
//!    what depends on parameters alone gathered into one hoisted factor;
//! 2. `factoring` computes pairs that occur in several rows once;
//! 3. `signs` chooses between sums and their negatives;
//! 4. `schedule` puts binary instructions into order, outputs first asked for
//!    first computed.
//!
//! # Order
//!
//! Functions of inputs come first. In a sum or a product, the operands that are there first are combined
//! first. So chains of dependent operations stay short.
//!
//! A program of more values than `unrolled` (1024, unless a declaration says `limit unrolled`) is ordered
//! for loops instead. Everything that needs a pivot stands right behind its last operand, short branches
//! first (`order`). So the elimination of a chain with its right-hand sides and its watch is one sequence
//! that repeats itself from link to link. The way back with the accelerations is another. `fusion` puts the
//! sequences of both ends of a chain side by side. The same limit decides where repetitions are searched
//! for, and where results are stored.

mod factoring;
mod flatten;
mod fusion;
mod hoisted;
mod order;
mod schedule;
mod signs;

pub use hoisted::Hoisted;

use crate::arena::{Arena, Expr};
use crate::inconsistency::Inconsistency;
use crate::program::Program;

/// The program that computes `outputs`, with everything that depends on
/// parameters alone moved into `hoisted`. One of more than `unrolled` values is ordered such
/// that its repeated parts can become loops.
///
/// # Errors
/// A pass that breaks its own rules.
pub fn lower(
    arena: &mut Arena,
    outputs: &[Expr],
    hoisted: &mut Hoisted,
    unrolled: usize,
) -> Result<Program, Inconsistency> {
    lower_flat(arena, outputs, Some(hoisted), unrolled)
}

/// The program that computes `outputs` from scratch.
///
/// # Errors
/// As those of [`lower`].
pub fn lower_whole(arena: &mut Arena, outputs: &[Expr], unrolled: usize) -> Result<Program, Inconsistency> {
    lower_flat(arena, outputs, None, unrolled)
}

fn lower_flat(
    arena: &mut Arena,
    outputs: &[Expr],
    hoisted: Option<&mut Hoisted>,
    unrolled: usize,
) -> Result<Program, Inconsistency> {
    let mut flat = flatten::flatten(arena, outputs, hoisted);
    factoring::factor(&mut flat)?;
    signs::choose(&mut flat);
    let results = flat.settle_outputs(arena, outputs);
    Ok(Program { splines: arena.splines().to_vec(), ..schedule::schedule(&flat, &results, unrolled) })
}
