//! The symbolic engine behind `mechanism!`: expressions, derivatives,
//! elimination of constrained systems, straight-line programs. It knows no
//! tokens and no joints, and needs no more than a hasher and an ordered map.
//!
//! 1. An [`Arena`] holds [`Expr`]essions, each once, in a canonical form that
//!    its constructors keep: exact constants, like terms collected, sines and
//!    cosines squared and added. An [`Algebra`] writes them with the signs of
//!    mathematics, vectors of the plane among them.
//! 2. [`Arena::derivative`] differentiates along a direction: partial
//!    derivatives and total time derivatives are both of that kind.
//! 3. [`factor`] eliminates a constrained system ([`Kkt`]) by pivots that are
//!    safe in every regular position, and [`Factorization::solve`] gives its
//!    solution as expressions.
//! 4. [`lower`] turns expressions into a [`Program`], with what depends on
//!    parameters alone [`Hoisted`] and pairs that occur repeatedly computed
//!    once. A program can be counted, evaluated and printed.
//! 5. A [`layout`] cuts a long program into loops and functions of bounded size.
//!
//! # Example
//!
//! ```
//! use mbs_symbolic::{Arena, Function, Stage, lower_whole};
//!
//! let mut arena = Arena::new();
//! let symbol = arena.symbol("theta", Stage::Variable);
//! let theta = arena.variable(symbol);
//! let sine = arena.call(Function::Sin, theta);
//! let square = arena.powi(sine, 2);
//! let slope = arena.partial(square, symbol);
//! assert_eq!(arena.display(slope), "2*sin(theta)*cos(theta)");
//!
//! let program = lower_whole(&mut arena, &[square, slope], 1024)?;
//! assert_eq!(program.operations().to_string(), "3 mul + 0 add + 0 div + 1 sincos");
//! assert_eq!(program.evaluate(&|_| 0.0, &[]), [0.0, 0.0]);
//! # Ok::<(), mbs_symbolic::Inconsistency>(())
//! ```
#![forbid(unsafe_code)]

mod abbreviated;
mod adjoint;
mod algebra;
mod arena;
mod arithmetic;
mod collected;
mod construct;
mod differentiate;
mod display;
mod eliminate;
mod evaluate;
mod exact;
mod growing;
mod inconsistency;
mod latex;
pub mod layout;
mod lower;
mod moving;
mod number;
mod operators;
pub mod pairs;
mod polynomial;
pub mod probe;
mod program;
mod repetition;
mod rounding;
mod sin_cos;
mod spline;
mod substitute;
mod tangent;
pub mod units;

pub use algebra::{Algebra, Scalar, Vector};
pub use arena::{Arena, Expr, Node, Stage, Symbol};
pub use arithmetic::{Arithmetic, Numeric};
pub use eliminate::{
    Elimination, Factorization, Kkt, Strategy, Sums, Undetermined, Unknown, WatchedPivot, factor,
    factor_within,
};
pub use evaluate::{Tape, Values};
pub use exact::{Exact, Point, Real, Residue};
pub use inconsistency::Inconsistency;
pub use latex::symbol_name as latex_name;
pub use lower::{Hoisted, lower, lower_whole};
pub use moving::{Jet, Moving};
pub use number::Number;
pub use operators::{Dimensions, Function, Latex, Parity, Pieces, Range, Row, TABLE as FUNCTIONS, Wasm};
pub use program::{Instruction, Operand, Operation, Operations, Program};
pub use repetition::{Block, Repetition, Source};
pub use rounding::Rounded;
pub use sin_cos::SinCos;
pub use spline::{Bends, Beyond, Grid, Interpolation, Outside, Segment, Spline, SplineId, Surface};
