//! Linear combinations of partial derivatives, in vector registers.
//!
//! The compiler takes arrays that do not leave a function apart into their numbers, and finds the
//! vectors in them again in short functions only: a fused step is a long one. Two doubles that are
//! made a vector by hand stay one.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

use wide::f64x2;

/// a x + b y of numbers, pair by pair in vector registers.
#[inline(always)]
pub(crate) fn combined<const N: usize>(a: f64, x: &[f64; N], b: f64, y: &[f64; N]) -> [f64; N] {
    let (a_both, b_both) = (f64x2::splat(a), f64x2::splat(b));
    pair_by_pair(x, y, |x, y| a_both * x + b_both * y, |x, y| a * x + b * y)
}

/// x + y
#[inline(always)]
pub(crate) fn sum<const N: usize>(x: &[f64; N], y: &[f64; N]) -> [f64; N] {
    pair_by_pair(x, y, |x, y| x + y, |x, y| x + y)
}

/// x − y
#[inline(always)]
pub(crate) fn difference<const N: usize>(x: &[f64; N], y: &[f64; N]) -> [f64; N] {
    pair_by_pair(x, y, |x, y| x - y, |x, y| x - y)
}

/// a x
#[inline(always)]
pub(crate) fn scaled<const N: usize>(a: f64, x: &[f64; N]) -> [f64; N] {
    let both = f64x2::splat(a);
    pair_by_pair(x, x, |x, _| both * x, |x, _| a * x)
}

#[inline(always)]
fn pair_by_pair<const N: usize>(
    x: &[f64; N],
    y: &[f64; N],
    of_pairs: impl Fn(f64x2, f64x2) -> f64x2,
    of_last: impl Fn(f64, f64) -> f64,
) -> [f64; N] {
    let mut found = *x;
    let mut at = 0;
    while at + 1 < N {
        let pair = of_pairs(f64x2::new([x[at], x[at + 1]]), f64x2::new([y[at], y[at + 1]]));
        [found[at], found[at + 1]] = pair.to_array();
        at += 2;
    }
    if at < N {
        found[at] = of_last(x[at], y[at]);
    }
    found
}
