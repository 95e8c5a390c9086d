//! How a long program is written in loops and functions of bounded size: where results
//! are stored, and where every instruction finds its operands. It knows no language; a
//! target prints it, or runs it.
//!
//! # What a target does with a layout
//! 1. It asks for the [`blocks`] of a program. One block is a short program, which needs no
//!    layout: its instructions are written one after the other.
//! 2. Otherwise [`Layout::new`] plans the blocks. The target says which symbols are
//!    components of vectors, because a loop reads them by their places, and how many outputs
//!    it wants in arrays of their own instead of slots.
//! 3. The target provides [`Layout::slots`] slots and the arrays of results, and writes the
//!    [`Layout::parts`] in their order, each as a function or in place.
//!    - A [`Straight`] part has its instructions one after the other. An operand that is a
//!      result of the same part is in a variable; one of another part is at its
//!      [`Layout::place`]. At the end, what is `kept` is stored.
//!    - A [`Loop`] runs its steps once per copy. [`Read`] tells where a step finds an
//!      operand. An element of a [`Column`] is read when the copy first needs it. A carried
//!      variable has its first value before the loop, and takes that of the next copy at the
//!      end of each. A result is stored as [`Kept`] tells: at once in every copy, or after
//!      the loop, of the last copy alone. A loop of [`Loop::angles`] has nothing but sines
//!      and cosines, which a target may take several at once. [`Loop::woven`] has the same
//!      steps on [pairs](crate::pairs), for a target with two-lane vectors; such a copy reads all
//!      of its columns first.
//! 4. After the parts, the target stores what [`Layout::given`] lists. The outputs are then at
//!    [`Layout::outputs`].
//!
//! A layout was run before it is handed out, as it says: it computes what the program does.
//!
//! # Example
//! ```
//! use mbs_symbolic::layout::{Component, Layout, Part, blocks};
//! use mbs_symbolic::{Arena, Function, Stage, lower_whole};
//!
//! // xᵢ = sin(xᵢ₋₁ + qᵢ)
//! let mut arena = Arena::new();
//! let mut last = arena.one();
//! for link in 0..100 {
//!     let symbol = arena.symbol(&format!("q{link}"), Stage::Variable);
//!     let q = arena.variable(symbol);
//!     let sum = arena.add(last, q);
//!     let sine = arena.call(Function::Sin, sum);
//!     last = arena.share(sine);
//! }
//! let program = lower_whole(&mut arena, &[last], 0)?;
//!
//! let component = |symbol: mbs_symbolic::Symbol| Some(Component { vector: "q", place: symbol.index() });
//! let blocks = blocks(&program, 100, &component);
//! let layout = Layout::new(&program, &blocks, &[], &component)?;
//! assert!(layout.parts.iter().any(|part| matches!(part, Part::Loop(_))));
//! assert_eq!(layout.outputs.len(), 1);
//! # Ok::<(), mbs_symbolic::Inconsistency>(())
//! ```

mod blocks;
mod check;
mod copy;
mod loops;
mod plan;
mod readers;
mod rule;
mod slots;
mod space;

use std::hash::Hash;
use std::ops::Range;

use rustc_hash::FxHashMap as HashMap;

use crate::arena::Symbol;
use crate::inconsistency::Inconsistency;
use crate::program::{Operand, Program};
use crate::repetition::{Block, Repetition};
use crate::sin_cos::SinCos;

pub use blocks::blocks;
pub use copy::WovenCopy;
pub use loops::{Angle, Carried, Column, Home, Kept, Loop, Read, Step};
pub use rule::Rule;
use slots::Slots;
pub use slots::{Array, Place};

/// A symbol as a component of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Component<V> {
    /// The vector.
    pub vector: V,
    /// The place in it; every component has its own.
    pub place: usize,
}

/// Tells which symbols are components of vectors; all others are single quantities.
pub type Components<'a, V> = &'a dyn Fn(Symbol) -> Option<Component<V>>;

/// A program in loops and functions of bounded size; see the [module](self).
pub struct Layout<V> {
    /// The parts, in the order in which they run.
    pub parts: Vec<Part<V>>,
    /// The number of slots.
    pub slots: usize,
    /// Outputs that no instruction computes, and where they are stored.
    pub given: Vec<(Operand, Place)>,
    /// Where the outputs are in the end.
    pub outputs: Vec<Place>,
    places: Slots,
}

/// Instructions that are written together.
pub enum Part<V> {
    /// Each runs once.
    Straight(Straight),
    /// They run once per copy.
    Loop(Loop<V>),
}

/// Instructions that run once.
pub struct Straight {
    /// The instructions, by position.
    pub range: Range<usize>,
    /// Those whose results are stored at the end, and where.
    pub kept: Vec<(usize, Place)>,
}

impl<V: Copy + Eq + Hash> Layout<V> {
    /// Plans the blocks of a program. Outputs are kept in arrays of these lengths at once,
    /// one array after the other, where that is possible; the others are in slots.
    ///
    /// # Errors
    /// The layout does not compute what the program does.
    pub fn new(
        program: &Program,
        blocks: &[Block],
        results: &[usize],
        components: Components<'_, V>,
    ) -> Result<Self, Inconsistency> {
        let layout = Self::plan(program, blocks, Slots::new(program, blocks, results), components)?;
        check::check(program, &layout, components)?;
        Ok(layout)
    }

    /// The layout with these places.
    fn plan(
        program: &Program,
        blocks: &[Block],
        places: Slots,
        components: Components<'_, V>,
    ) -> Result<Self, Inconsistency> {
        let pairs = SinCos::of(program);
        let part = |block: &Block| match block {
            Block::Straight(range) => Ok(Part::Straight(Straight::new(range.clone(), &places))),
            Block::Repeated(repetition) => {
                Loop::new(program, *repetition, &places, &pairs, components).map(Part::Loop)
            }
        };
        let parts = blocks.iter().map(part).collect::<Result<_, _>>()?;
        let Outputs { outputs, given, slots } = Outputs::new(program, &places)?;
        Ok(Self { parts, slots, given, outputs, places })
    }

    /// Where the result of an instruction is kept; `None` if nobody outside its part, or its
    /// copy, reads it.
    pub fn place(&self, value: usize) -> Option<Place> {
        self.places.of(value)
    }
}

impl Straight {
    fn new(range: Range<usize>, places: &Slots) -> Self {
        let kept = range.clone().filter_map(|at| Some((at, places.of(at)?))).collect();
        Self { range, kept }
    }
}

/// Where outputs are kept.
struct Outputs {
    outputs: Vec<Place>,
    given: Vec<(Operand, Place)>,
    /// The number of slots with those of outputs that no instruction computes.
    slots: usize,
}

impl Outputs {
    fn new(program: &Program, places: &Slots) -> Result<Self, Inconsistency> {
        const KEPT: Inconsistency = Inconsistency { pass: "layout", rule: "every output has a place" };
        let (mut given, mut slots) = (Vec::new(), places.len());
        let mut others: HashMap<Operand, Place> = HashMap::default();
        let place = |&output: &Operand| match output {
            Operand::Value(value) => places.of(value).ok_or(KEPT),
            other => Ok(*others.entry(other).or_insert_with(|| {
                let place = Place { array: Array::Slots, at: slots };
                given.push((other, place));
                slots += 1;
                place
            })),
        };
        let outputs = program.outputs.iter().map(place).collect::<Result<_, _>>()?;
        Ok(Self { outputs, given, slots })
    }
}
