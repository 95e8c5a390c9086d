//! Numbers to run programs at that have to compute the same.

use crate::arena::Symbol;

/// How many points are looked at. One finds an operand that was taken for another, but for
/// a coincidence; what is not a number at one of them may be at the next.
pub const POINTS: u64 = 3;

/// Values of symbols without any relation to each other, of both signs, of order 1.
pub fn symbol(point: u64) -> impl Fn(Symbol) -> f64 {
    move |symbol| {
        let [size, sign] = numbers(point, 2 * symbol.index() as u64);
        if sign < 0.5 { size } else { -size }
    }
}

/// Values of what depends on parameters alone: positive, as lengths and masses are, so that
/// roots of them are numbers.
pub fn hoisted(point: u64) -> impl Fn(usize) -> f64 {
    move |at| numbers(point, 2 * at as u64 + 1)[0]
}

/// A number in 0.25 … 1.75 and one in 0 … 1 (SplitMix64, Steele et al. 2014).
fn numbers(point: u64, at: u64) -> [f64; 2] {
    let seed = point.wrapping_mul(0xd134_2543_de82_ef95).wrapping_add(at + 1);
    let z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let z = z ^ (z >> 31);
    let unit = |bits: u64| bits as f64 / (1_u64 << 32) as f64;
    [0.25 + 1.5 * unit(z >> 32), unit(z & 0xffff_ffff)]
}
