//! Numbers of many members side by side.

use mbs_runtime::__private::Spline;
use mbs_runtime::Lanes;

use crate::instruction::{Instruction, execute};

/// Members that are computed together: an instruction is decoded once for all of them.
pub const LANES: usize = 32;

/// Numbers in a vector instruction of the widest kind.
const WIDTH: usize = 8;
pub const VECTORS: usize = LANES / WIDTH;

pub type Vector = Lanes<f64, WIDTH>;

/// A number of each member.
pub type Column = [Vector; VECTORS];

/// The numbers of all lanes.
pub fn column(number: impl Fn(usize) -> f64) -> Column {
    std::array::from_fn(|vector| Lanes(std::array::from_fn(|at| number(vector * WIDTH + at))))
}

/// f of the numbers in every lane.
pub fn zip(a: Column, b: Column, f: impl Fn(Vector, Vector) -> Vector) -> Column {
    std::array::from_fn(|at| f(a[at], b[at]))
}

/// 0 in lanes where all of these are finite.
pub fn trouble<'a>(columns: impl IntoIterator<Item = &'a Column>) -> Column {
    let none = column(|_| 0.0);
    columns.into_iter().fold(none, |sum, x| zip(sum, zip(*x, *x, |a, b| a - b), |sum, x| sum + x))
}

/// The number of a lane; there is one of each below [`LANES`].
pub fn read(column: &Column, lane: usize) -> f64 {
    column[lane / WIDTH].0[lane % WIDTH]
}

/// Sets the number of a lane.
pub fn write(column: &mut Column, lane: usize, number: f64) {
    column[lane / WIDTH].0[lane % WIDTH] = number;
}

/// Runs instructions in the widest vectors that the processor has; AVX-512 without fused
/// operations, which nobody writes here: results do not depend on the target.
#[multiversion::multiversion(targets(
    "x86_64+avx+avx2+fma+avx512f+avx512dq+avx512vl+avx512bw+avx512cd",
    "x86_64+avx+avx2+fma",
))]
pub fn run(instructions: &[Instruction], splines: &[Spline], values: &mut [Column]) {
    execute(instructions, splines, values);
}
