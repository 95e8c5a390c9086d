//! A loop over the copies of the same instructions: what every step reads, and what is
//! kept of its results.

use super::{Array, Place, Repetition, Rule};
use crate::number::Number;
use crate::program::Operand;

/// A loop over the copies of the same instructions.
pub struct Loop<V> {
    /// The instructions.
    pub repetition: Repetition,
    /// The steps of a copy, one per instruction.
    pub steps: Vec<Step>,
    /// Variables that hold a result of the copy before.
    pub carried: Vec<Carried>,
    /// Operands that are others in every copy.
    pub columns: Vec<Column<V>>,
    /// Places without a rule, one per copy.
    pub tables: Vec<Vec<usize>>,
}

/// An instruction of a copy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Where the two operands are.
    pub operands: [Read; 2],
    /// Of a sine, the step with the cosine of the same angle in every copy, or the other way
    /// round. The first of the two may compute both.
    pub partner: Option<usize>,
    /// Which of the results are stored.
    pub kept: Kept,
}

/// Where a step finds an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Read {
    /// The same operand in all copies.
    Same(Operand),
    /// The result of another step of the copy.
    Own(usize),
    /// One of the [carried](Loop::carried) variables, by position.
    Carried(usize),
    /// The operand that one of the [columns](Loop::columns) has for the copy, by position.
    Each(usize),
}

/// A variable that holds a result of the copy before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Carried {
    /// The step that gives it.
    pub from: usize,
    /// Its value in the first copy.
    pub first: Operand,
}

/// An operand that is another one in every copy.
#[derive(Clone, Debug, PartialEq)]
pub enum Column<V> {
    /// A number per copy.
    Numbers(Vec<Number>),
    /// An element of an array per copy.
    Elements(Home<V>, Rule),
}

/// The array that the copies of a loop read an operand from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Home<V> {
    /// One with results of the program.
    Result(Array),
    /// The values that depend on parameters alone.
    Hoisted,
    /// A vector that the program is given.
    Vector(V),
}

/// Which results of the copies of an instruction are stored, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// They do not leave their copy, but for the next.
    No,
    /// That of the last copy, after the loop.
    Last(Place),
    /// Those of all copies, at once.
    Each(Array, Rule),
}

/// A sine and a cosine of the components of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Angle {
    /// The column with the angles.
    pub column: usize,
    /// The two steps, in their order.
    pub steps: [usize; 2],
}

impl<V> Loop<V> {
    /// The steps in pairs, if there is nothing but sines and cosines of components of
    /// vectors, all of them stored by a rule or not at all.
    pub fn angles(&self) -> Option<Vec<Angle>> {
        let mut angles = Vec::new();
        for (at, step) in self.steps.iter().enumerate() {
            let (Read::Each(column), Some(partner)) = (step.operands[0], step.partner) else { return None };
            let is_of_components = matches!(self.columns[column], Column::Elements(Home::Vector(_), _));
            if !is_of_components || matches!(step.kept, Kept::Last(_)) {
                return None;
            }
            if at < partner {
                angles.push(Angle { column, steps: [at, partner] });
            }
        }
        self.tables.is_empty().then_some(angles)
    }
}
