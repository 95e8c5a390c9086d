//! Steps woven into operations on pairs, for the two-lane vectors of the runtime.
//!
//! `pairs` of `mbs-symbolic` finds instructions that do the same on neighbouring data, such as the x and the
//! y of a body or the sines of two stages. This module tells it which symbols are neighbours. x and y are
//! read and written in one piece, since a load across two stores waits for both.

use mbs_symbolic::pairs::{Layout, Woven, weave};
use mbs_symbolic::{Inconsistency, Program, Symbol};

use crate::compiled::{Compiled, Input};

/// The program of a fused step on pairs, with a sum behind its outputs that is finite only if
/// the step is good: of q⁺ and v⁺, and with reactions of q̈ and λ too.
///
/// # Errors
/// Pairs that do not compute what the program does.
pub fn woven(compiled: &Compiled, program: &Program, with_reactions: bool) -> Result<Woven, Inconsistency> {
    let (n, s) = (compiled.coordinates.len(), compiled.states.len());
    // The x and the y of a body. An angle next to an x is not read with it: it would
    // have to be written with it, or the processor waits for the two writes.
    let is_place = |a: usize, b: usize| b == a + 1 && compiled.places.contains(&a);
    // which states stand side by side as their coordinates do
    let are_placed = |a: usize, b: usize| b == a + 1 && is_place(compiled.states[a], compiled.states[b]);
    let are_neighbours = |a: Symbol, b: Symbol| match (compiled.input(a), compiled.input(b)) {
        (Input::Position(a), Input::Position(b)) | (Input::Velocity(a), Input::Velocity(b)) => is_place(a, b),
        (Input::StatePosition(a), Input::StatePosition(b))
        | (Input::StateVelocity(a), Input::StateVelocity(b)) => are_placed(a, b),
        _ => false,
    };
    // q⁺ and v⁺ belong to states, q̈ to coordinates where it is given.
    let are_written_together = |a: usize, b: usize| {
        let (first, last) = (a.min(b), a.max(b));
        if last < 2 * s {
            a / s == b / s && are_placed(a % s, b % s)
        } else {
            with_reactions && first >= 2 * s && last < 2 * s + n && is_place(a - 2 * s, b - 2 * s)
        }
    };
    let is_constant = |symbol: Symbol| {
        !matches!(
            compiled.input(symbol),
            Input::Time
                | Input::NextTime
                | Input::Position(_)
                | Input::Velocity(_)
                | Input::StatePosition(_)
                | Input::StateVelocity(_)
        )
    };
    // the next step begins where this one ends
    let state_of = |coordinate: usize| compiled.states.iter().position(|&of| of == coordinate);
    let carried = |symbol: Symbol| match compiled.input(symbol) {
        Input::StatePosition(state) => Some(state),
        Input::StateVelocity(state) => Some(s + state),
        Input::Position(coordinate) => state_of(coordinate),
        Input::Velocity(coordinate) => Some(s + state_of(coordinate)?),
        _ => None,
    };
    let layout = Layout {
        are_neighbours: &are_neighbours,
        are_written_together: &are_written_together,
        is_constant: &is_constant,
        carried: &carried,
    };
    let mut woven = weave(program, &layout);
    let finite = if with_reactions { 2 * s + n + compiled.constraints.len() } else { 2 * s };
    woven.sum_outputs(finite);
    woven.check(program)?;
    Ok(woven)
}
