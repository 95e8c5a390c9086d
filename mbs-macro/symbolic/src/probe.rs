//! Numbers to run programs at that have to compute the same.

use crate::arena::Symbol;

/// How many points are looked at. One finds an operand that was taken for another, but for
/// a coincidence; what is not a number at one of them may be at the next.
pub const POINTS: u64 = 3;

/// Values of symbols without any relation to each other, of both signs, of order 1.
pub fn symbol(point: u64) -> impl Fn(Symbol) -> f64 {
    move |symbol| number(point, 2 * symbol.index() as u64)
}

/// Values of what depends on parameters alone.
pub fn hoisted(point: u64) -> impl Fn(usize) -> f64 {
    move |at| number(point, 2 * at as u64 + 1)
}

/// 0.25 … 1.75, or the negative of that (SplitMix64, Steele et al. 2014).
fn number(point: u64, at: u64) -> f64 {
    let seed = point.wrapping_mul(0xd134_2543_de82_ef95).wrapping_add(at + 1);
    let z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let z = z ^ (z >> 31);
    let size = 0.25 + 1.5 * (z >> 11) as f64 / (1_u64 << 53) as f64;
    if z & 1 == 0 { size } else { -size }
}
