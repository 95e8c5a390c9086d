//! Steps woven into operations on pairs, for the two-lane vectors of the runtime.

use mbs_symbolic::pairs::{Layout, Woven, weave};
use mbs_symbolic::{Inconsistency, Program, Symbol};

use crate::compiled::{Compiled, Input};

/// The program of a fused step on pairs, with a sum behind its outputs that is finite only if
/// the step is good: of q⁺ and v⁺, and with reactions of q̈ and λ too.
///
/// # Errors
/// Pairs that do not compute what the program does.
pub fn woven(compiled: &Compiled, program: &Program, with_reactions: bool) -> Result<Woven, Inconsistency> {
    let n = compiled.coordinates.len();
    // The x and the y of a body. An angle next to an x is not read with it: it would
    // have to be written with it, or the processor waits for the two writes.
    let is_place = |a: usize, b: usize| b == a + 1 && compiled.places.contains(&a);
    let are_neighbours = |a: Symbol, b: Symbol| match (compiled.input(a), compiled.input(b)) {
        (Input::Position(a), Input::Position(b)) | (Input::Velocity(a), Input::Velocity(b)) => is_place(a, b),
        _ => false,
    };
    // What belongs to coordinates: q⁺, v⁺, and q̈ where it is given.
    let of_coordinates = if with_reactions { 3 * n } else { 2 * n };
    let are_written_together =
        |a: usize, b: usize| a.max(b) < of_coordinates && a / n == b / n && is_place(a % n, b % n);
    let is_constant = |symbol: Symbol| {
        !matches!(
            compiled.input(symbol),
            Input::Time | Input::NextTime | Input::Position(_) | Input::Velocity(_)
        )
    };
    let layout = Layout {
        are_neighbours: &are_neighbours,
        are_written_together: &are_written_together,
        is_constant: &is_constant,
    };
    let mut woven = weave(program, &layout);
    let finite = if with_reactions { 3 * n + compiled.constraints.len() } else { 2 * n };
    woven.sum_outputs(finite);
    woven.check(program)?;
    Ok(woven)
}
