//! Inputs and outputs of a program in memory, and from run to run.

use crate::arena::Symbol;

/// Where the symbols of a program come from.
pub struct Layout<'a> {
    /// True if two symbols lie side by side in memory, so that they are read as a pair.
    pub are_neighbours: &'a dyn Fn(Symbol, Symbol) -> bool,
    /// True if two outputs do, so that they are written as a pair.
    pub are_written_together: &'a dyn Fn(usize, usize) -> bool,
    /// True if a symbol is the same in run after run of the program, so that a loop
    /// moves it into both lanes once.
    pub is_constant: &'a dyn Fn(Symbol) -> bool,
    /// The output from which the next run of the program reads a symbol.
    pub carried: &'a dyn Fn(Symbol) -> Option<usize>,
}
