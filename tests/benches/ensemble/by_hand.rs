//! The elimination of `tests::by_hand` over eight lanes as a person writes it for
//! AVX-512: every number a register, sine and cosine inlined, in a loop that does
//! nothing else. No watched pivots, no test for finite values, no bound of angles, no
//! time but that of the drive.
//!
//! `FUSED` says whether products are fused with sums. The library's are not, so that
//! its results are the same on every processor.

pub const N: usize = 8;

/// Coordinates, or their rates.
pub type Seven = [[f64; N]; 7];

/// Eight slider-cranks.
#[derive(Clone, Copy)]
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
pub struct Hand {
    pub l1: [f64; N],
    pub l2: [f64; N],
    pub m: [[f64; N]; 3],
    pub j: [[f64; N]; 2],
    pub omega: [f64; N],
    pub torque: [f64; N],
    pub minus_two_alpha: [f64; N],
    pub minus_beta_squared: [f64; N],
}

/// Steps of eight slider-cranks; `false` if this processor has no AVX-512.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "a function that is compiled for AVX-512, called where it is there")]
pub fn advance<const DRIVEN: bool, const FUSED: bool>(
    hand: &Hand,
    q: &mut Seven,
    v: &mut Seven,
    h: f64,
    count: u64,
) -> bool {
    let is_there = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("fma");
    if is_there {
        // these are the features that it is compiled for
        unsafe { crate::steps::steps::<DRIVEN, FUSED>(hand, q, v, h, count) };
    }
    is_there
}

/// There is no AVX-512.
#[cfg(not(target_arch = "x86_64"))]
pub fn advance<const DRIVEN: bool, const FUSED: bool>(
    _: &Hand,
    _: &mut Seven,
    _: &mut Seven,
    _: f64,
    _: u64,
) -> bool {
    false
}
