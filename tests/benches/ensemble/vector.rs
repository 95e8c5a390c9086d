//! Eight numbers in a register of AVX-512.
#![allow(unsafe_code, reason = "operators cannot say that their caller has found AVX-512")]

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy)]
pub struct Vector(__m512d);

macro_rules! operators {
    ($($operator:ident $method:ident $intrinsic:ident)*) => {$(
        impl $operator for Vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )*};
}

operators!(Add add _mm512_add_pd  Sub sub _mm512_sub_pd  Mul mul _mm512_mul_pd  Div div _mm512_div_pd);

impl Neg for Vector {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::of([0.0; 8]) - self
    }
}

impl Vector {
    #[inline(always)]
    pub fn of(lanes: [f64; 8]) -> Self {
        Self(unsafe { _mm512_loadu_pd(lanes.as_ptr()) })
    }

    #[inline(always)]
    pub fn all(x: f64) -> Self {
        Self(unsafe { _mm512_set1_pd(x) })
    }

    #[inline(always)]
    pub fn lanes(self) -> [f64; 8] {
        let mut lanes = [0.0; 8];
        unsafe { _mm512_storeu_pd(lanes.as_mut_ptr(), self.0) };
        lanes
    }

    /// self + x y
    #[inline(always)]
    pub fn plus<const FUSED: bool>(self, x: Self, y: Self) -> Self {
        if FUSED { Self(unsafe { _mm512_fmadd_pd(x.0, y.0, self.0) }) } else { self + x * y }
    }

    /// self − x y
    #[inline(always)]
    pub fn minus<const FUSED: bool>(self, x: Self, y: Self) -> Self {
        if FUSED { Self(unsafe { _mm512_fnmadd_pd(x.0, y.0, self.0) }) } else { self - x * y }
    }

    /// By the reduction and the polynomials of Sun's fdlibm, for any angle below 10⁵ rad.
    #[inline(always)]
    pub fn sin_cos<const FUSED: bool>(self) -> (Self, Self) {
        const SHIFT: f64 = 6_755_399_441_055_744.0;
        let c = Self::all;
        let shifted = c(SHIFT).plus::<FUSED>(self, c(std::f64::consts::FRAC_2_PI));
        let n = shifted - c(SHIFT);
        let r = if FUSED {
            self.minus::<true>(n, c(std::f64::consts::FRAC_PI_2))
                .minus::<true>(n, c(6.123_233_995_736_766e-17))
        } else {
            self - n * c(1.570_796_326_734_125_6)
                - n * c(6.077_100_506_303_966e-11)
                - n * c(2.022_266_248_795_950_6e-21)
        };
        let z = r * r;
        let w = z * z;
        let sine = r.plus::<FUSED>(
            r * z,
            z.polynomial::<FUSED>([
                -1.666_666_666_666_663_2e-1,
                8.333_333_333_322_49e-3,
                -1.984_126_982_985_795e-4,
                2.755_731_370_707_007e-6,
                -2.505_076_025_340_686_3e-8,
                1.589_690_995_211_55e-10,
            ]),
        );
        let half = c(0.5) * z;
        let whole = c(1.0) - half;
        let rest = ((c(1.0) - whole) - half).plus::<FUSED>(
            w,
            z.polynomial::<FUSED>([
                4.166_666_666_666_66e-2,
                -1.388_888_888_887_411e-3,
                2.480_158_728_947_673e-5,
                -2.755_731_435_139_066e-7,
                2.087_572_321_298_175e-9,
                -1.135_964_755_778_819_5e-11,
            ]),
        );
        turned(shifted, sine, whole + rest)
    }

    /// Σ pᵢ zⁱ
    #[inline(always)]
    fn polynomial<const FUSED: bool>(self, p: [f64; 6]) -> Self {
        let (w, c) = (self * self, Self::all);
        let last = c(p[4]).plus::<FUSED>(self, c(p[5]));
        let middle = c(p[2]).plus::<FUSED>(self, c(p[3])).plus::<FUSED>(w, last);
        c(p[0]).plus::<FUSED>(self, c(p[1])).plus::<FUSED>(w, middle)
    }
}

/// Sine and cosine of the angle that is a number of quarter turns larger.
#[inline(always)]
fn turned(quarters: Vector, sine: Vector, cosine: Vector) -> (Vector, Vector) {
    unsafe {
        let quarters = _mm512_castpd_si512(quarters.0);
        let swap = _mm512_test_epi64_mask(quarters, _mm512_set1_epi64(1));
        let s = _mm512_castpd_si512(_mm512_mask_blend_pd(swap, sine.0, cosine.0));
        let c = _mm512_castpd_si512(_mm512_mask_blend_pd(swap, cosine.0, sine.0));
        let sign = _mm512_set1_epi64(i64::MIN);
        let of_sine = _mm512_and_si512(_mm512_slli_epi64(quarters, 62), sign);
        let next = _mm512_add_epi64(quarters, _mm512_set1_epi64(1));
        let of_cosine = _mm512_and_si512(_mm512_slli_epi64(next, 62), sign);
        let (s, c) = (_mm512_xor_si512(s, of_sine), _mm512_xor_si512(c, of_cosine));
        (Vector(_mm512_castsi512_pd(s)), Vector(_mm512_castsi512_pd(c)))
    }
}
