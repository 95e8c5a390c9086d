//! Numbers that carry their partial derivatives.
//!
//! # How derivatives get through a run
//!
//! A dual is a `Real`, so everything generic differentiates itself. Slopes are those of `operators.rs` of
//! `mbs-symbolic`, at kinks too. They are written here once more, as the compiler is not there when a mechanism
//! runs; `tests/tests/duals.rs` compares both.
//!
//! An iteration ends by its value, before its derivatives have converged. `Real::ORDER` more corrections are
//! made then, in `start/assembly.rs` and `adaptive/attempt.rs`. The conjugate gradients of
//! `start/projection.rs` are solved for each partial. The time of an event gets its derivatives in
//! `adaptive/ending.rs`.
//!
//! `gradients.rs` makes a run for every N variables of a sum, for any `System` over duals.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::{Real, Two};

/// A number with its partial derivatives by `N` variables: generated code that computes with
/// `Dual<f64, 4>` computes four derivatives of every result beside it, by the chain rule and
/// not by differences.
///
/// ```text
/// x = (x, ∂x/∂p₁, …, ∂x/∂p_N)      f(x) = (f(x), f′(x) ∂x/∂p₁, …, f′(x) ∂x/∂p_N)
/// ```
///
/// **Values.** The value of every operation is that of the scalar `T`, to the last bit.
/// Comparisons are those of values, and so are all decisions of a run:
/// [`is_finite`](Real::is_finite), [`to_f64`](Real::to_f64), `==` and `<` ask for the value
/// alone. So the values of a run with duals are those of the run without.
///
/// **Kinks.** Where a function has no derivative, its partials are those of the smooth piece
/// that the symbolic derivatives of `mechanism!` take too: |x|′ = sign x with 0 at 0,
/// sign′ = 0, the comparison [`greater`](Real::greater) does not change, and
/// [`min`](Real::min), [`max`](Real::max) take the partials of their second argument where
/// both are equal. Splines take the piece to the right.
///
/// **Where a slope is infinite**, as that of √x at 0, a partial that is 0 stays 0: what does
/// not move may stand there. Others become infinite or NaN; they do not stop a run, whose
/// decisions are those of values.
///
/// A dual of duals, `Dual<Dual<f64, 1>, 1>`, carries second derivatives. See
/// [`gradients`](crate::gradients) for runs.
///
/// # Example
/// ```
/// use mbs_runtime::{Dual, Real};
///
/// // the derivatives of x·sin y by x and by y
/// let (x, y) = (Dual::<f64, 2>::variable(3.0, 0), Dual::variable(0.5, 1));
/// let f = x * y.sin();
/// assert_eq!(f.value, 3.0 * Real::sin(0.5));
/// assert_eq!(f.partials, [Real::sin(0.5), 3.0 * Real::cos(0.5)]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dual<T, const N: usize> {
    /// x
    pub value: T,
    /// ∂x/∂pᵢ
    pub partials: [T; N],
}

impl<T: Real, const N: usize> Dual<T, N> {
    /// A number with these partial derivatives.
    #[inline(always)]
    pub const fn new(value: T, partials: [T; N]) -> Self {
        Self { value, partials }
    }

    /// A number that does not depend on the variables.
    #[inline(always)]
    pub const fn constant(value: T) -> Self {
        Self { value, partials: [T::ZERO; N] }
    }

    /// The variable of this index: its partial derivative by itself is 1. With an index from
    /// `N` on it is a constant.
    #[inline(always)]
    pub fn variable(value: T, index: usize) -> Self {
        let mut variable = Self::constant(value);
        if let Some(partial) = variable.partials.get_mut(index) {
            *partial = T::from_f64(1.0);
        }
        variable
    }

    /// f(x) from f and f′ at x.
    #[inline(always)]
    fn chain(self, value: T, slope: T) -> Self {
        Self { value, partials: T::scaled(slope, &self.partials) }.with_still(slope, self.partials)
    }

    /// f(x, y) from f and its partial derivatives at (x, y).
    #[inline(always)]
    fn chain_of_two(self, other: Self, value: T, [along, across]: [T; 2]) -> Self {
        self.chain(value, along) + other.chain(T::ZERO, across)
    }

    /// A slope that is not finite leaves partials at 0 that were.
    #[inline(always)]
    fn with_still(mut self, slope: T, partials: [T; N]) -> Self {
        if !slope.is_finite() {
            for at in 0..N {
                if partials[at] == T::ZERO {
                    self.partials[at] = partials[at];
                }
            }
        }
        self
    }

    /// `self` where `is_first` is 1, `other` where it is 0, with this value.
    #[inline(always)]
    fn choose(self, other: Self, is_first: T, value: T) -> Self {
        let one = T::from_f64(1.0);
        if is_first == one {
            return Self { value, ..self };
        }
        if is_first == T::ZERO {
            return Self { value, ..other };
        }
        // a vector of both
        let mut partials = self.partials;
        for at in 0..N {
            partials[at] = is_first * partials[at] + (one - is_first) * other.partials[at];
        }
        Self { value, partials }
    }
}

impl<T: Real, const N: usize> Default for Dual<T, N> {
    #[inline(always)]
    fn default() -> Self {
        Self::ZERO
    }
}

impl<T: Real, const N: usize> PartialEq for Dual<T, N> {
    /// True if the values are equal.
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T: Real, const N: usize> PartialOrd for Dual<T, N> {
    /// The order of the values.
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
    #[inline(always)]
    fn lt(&self, other: &Self) -> bool {
        self.value < other.value
    }
    #[inline(always)]
    fn le(&self, other: &Self) -> bool {
        self.value <= other.value
    }
    #[inline(always)]
    fn gt(&self, other: &Self) -> bool {
        self.value > other.value
    }
    #[inline(always)]
    fn ge(&self, other: &Self) -> bool {
        self.value >= other.value
    }
}

impl<T: Real, const N: usize> fmt::Display for Dual<T, N> {
    /// The value, and the partials in brackets.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.value, f)?;
        f.write_str(" [")?;
        for (at, partial) in self.partials.iter().enumerate() {
            f.write_str(if at == 0 { "" } else { ", " })?;
            fmt::Display::fmt(partial, f)?;
        }
        f.write_str("]")
    }
}

// Not `inline(always)`: optimised code has sums and products inlined all the same, and without
// optimisation, as in tests, programs of thousands of them compile in a tenth of the time.
impl<T: Real, const N: usize> Add for Dual<T, N> {
    type Output = Self;
    #[inline]
    fn add(self, y: Self) -> Self {
        Self { value: self.value + y.value, partials: T::sum(&self.partials, &y.partials) }
    }
}

impl<T: Real, const N: usize> Sub for Dual<T, N> {
    type Output = Self;
    #[inline]
    fn sub(self, y: Self) -> Self {
        Self { value: self.value - y.value, partials: T::difference(&self.partials, &y.partials) }
    }
}

impl<T: Real, const N: usize> Mul for Dual<T, N> {
    type Output = Self;
    #[inline]
    fn mul(self, y: Self) -> Self {
        let partials = T::combined(y.value, &self.partials, self.value, &y.partials);
        Self { value: self.value * y.value, partials }
    }
}

impl<T: Real, const N: usize> Div for Dual<T, N> {
    type Output = Self;
    #[inline]
    fn div(self, y: Self) -> Self {
        // two divisions that do not wait for each other
        let (value, inverse) = (self.value / y.value, T::from_f64(1.0) / y.value);
        let partials = T::combined(inverse, &self.partials, -(value * inverse), &y.partials);
        Self { value, partials }
    }
}

impl<T: Real, const N: usize> Neg for Dual<T, N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, partials: T::scaled(-T::from_f64(1.0), &self.partials) }
    }
}

impl<T: Real, const N: usize> Real for Dual<T, N> {
    type Pair = Two<Self>;
    const ZERO: Self = Self::constant(T::ZERO);
    const EPSILON: Self = Self::constant(T::EPSILON);
    const ORDER: usize = T::ORDER + 1;
    const PARTIALS: usize = N;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::constant(T::from_f64(x))
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }
    #[inline(always)]
    fn tan(self) -> Self {
        let f = self.value.tan();
        self.chain(f, T::from_f64(1.0) + f * f)
    }
    #[inline(always)]
    fn asin(self) -> Self {
        let x = self.value;
        self.chain(x.asin(), slope_of_asin(x))
    }
    #[inline(always)]
    fn acos(self) -> Self {
        let x = self.value;
        self.chain(x.acos(), -slope_of_asin(x))
    }
    #[inline(always)]
    fn atan(self) -> Self {
        let (x, one) = (self.value, T::from_f64(1.0));
        self.chain(x.atan(), one / (one + x * x))
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let (dy, dx) = (self.value, x.value);
        let inverse = T::from_f64(1.0) / (dy * dy + dx * dx);
        self.chain_of_two(x, dy.atan2(dx), [dx * inverse, -(dy * inverse)])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let f = self.value.sqrt();
        self.chain(f, T::from_f64(0.5) / f)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let f = self.value.exp();
        self.chain(f, f)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        let x = self.value;
        self.chain(x.ln(), T::from_f64(1.0) / x)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        let f = self.value.tanh();
        self.chain(f, T::from_f64(1.0) - f * f)
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        let (x, y) = (self.value, exponent.value);
        let f = x.pow(y);
        let along = y * x.pow(y - T::from_f64(1.0));
        // ln x is no number below 0, where an exponent that does not move is of use
        self.chain_of_two(exponent, f, [along, f * x.ln()])
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.chain(self.value.abs(), self.value.sign())
    }
    #[inline(always)]
    fn sign(self) -> Self {
        Self::constant(self.value.sign())
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.choose(other, other.value.greater(self.value), self.value.min(other.value))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.choose(other, self.value.greater(other.value), self.value.max(other.value))
    }
    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Self::constant(self.value.greater(other.value))
    }
    #[inline(always)]
    fn gate(self, other: Self) -> Self {
        let gate = self.value;
        Self { value: gate.gate(other.value), partials: other.partials.map(|partial| gate.gate(partial)) }
    }

    #[inline(always)]
    fn is_same(self, other: Self) -> bool {
        let mut partials = self.partials.into_iter().zip(other.partials);
        self.value.is_same(other.value) && partials.all(|(x, y)| x.is_same(y))
    }
    #[inline(always)]
    fn without_partials(self) -> Self {
        Self::constant(self.value.without_partials())
    }
    #[inline(always)]
    fn with_partials_of(self, other: Self) -> Self {
        Self { value: self.value.with_partials_of(other.value), ..other }
    }
    #[inline(always)]
    fn partial(self, index: usize) -> f64 {
        self.partials.get(index).map_or(0.0, |partial| partial.to_f64())
    }
    #[inline(always)]
    fn plus_partial(mut self, index: usize, change: f64) -> Self {
        if let Some(partial) = self.partials.get_mut(index) {
            *partial = *partial + T::from_f64(change);
        }
        self
    }
}

/// 1/√(1 − x²)
#[inline(always)]
fn slope_of_asin<T: Real>(x: T) -> T {
    let one = T::from_f64(1.0);
    one / (one - x * x).sqrt()
}
