//! Exact arithmetic in the field of (2⁶¹ − 1)² elements.
//!
//! Its elements are a + b i with a and b modulo the prime p = 2⁶¹ − 1 and i² = −1; p leaves 3
//! when divided by 4, so that −1 has no root modulo p. Square roots of all integers are in this
//! field, and so are the sines and cosines of all tenths of a degree. A relation between such
//! numbers holds here if it holds, and one that does not hold is met by chance once in 2⁶¹.

use std::ops::{Add, Mul, Neg, Sub};

/// 2⁶¹ − 1
const PRIME: u64 = (1 << 61) - 1;

/// The angle π has this many parts that are exact.
const PARTS: i64 = 100_800;

/// An element of order 2 · [`PARTS`]: a turn by one part.
const PART: Residue = Residue(995_737_247_895_112_412, 435_976_810_033_681_573);

/// An element of the field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Residue(u64, u64);

impl Residue {
    /// 0
    pub const ZERO: Self = Self(0, 0);
    /// 1
    pub const ONE: Self = Self(1, 0);

    /// An integer.
    pub fn integer(value: impl Into<i128>) -> Self {
        let value = value.into();
        let magnitude = Self(fold(value.unsigned_abs()), 0);
        if value < 0 { -magnitude } else { magnitude }
    }

    /// numerator / denominator; `None` for a denominator of 0.
    pub fn ratio(numerator: impl Into<i128>, denominator: impl Into<i128>) -> Option<Self> {
        let (numerator, denominator) = (Self::integer(numerator), Self::integer(denominator));
        if denominator == Self::ONE { Some(numerator) } else { Some(numerator * denominator.inverse()?) }
    }

    /// A float, which is an integer times a power of two; `None` if it is not finite.
    pub fn float(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        let bits = value.to_bits();
        let (fraction, exponent) = (bits & ((1 << 52) - 1), (bits >> 52) & 0x7ff);
        let (mantissa, power) =
            if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent as i64 - 1075) };
        // 2⁶¹ = 1
        let magnitude = Self(fold(u128::from(mantissa) << power.rem_euclid(61)), 0);
        Some(if value < 0.0 { -magnitude } else { magnitude })
    }

    /// A number that is related to no other: always the same one for the same reason.
    pub fn stand_in(reason: u64, of: &[Self]) -> Self {
        let mut state = mix(reason);
        for part in of {
            state = mix(mix(state ^ part.0) ^ part.1);
        }
        Self(fold(mix(state ^ 1).into()), fold(mix(state ^ 2).into()))
    }

    /// Likewise, among the integers modulo the prime.
    pub fn stand_in_integer(reason: u64, at: u64) -> Self {
        Self(fold(mix(mix(reason) ^ at).into()), 0)
    }

    /// x to an integer power; `None` for 0 to a negative one.
    pub fn power(self, exponent: i64) -> Option<Self> {
        let base = if exponent < 0 { self.inverse()? } else { self };
        Some(base.positive_power(exponent.unsigned_abs().into()))
    }

    fn positive_power(self, mut exponent: u128) -> Self {
        let (mut base, mut power) = (self, Self::ONE);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = power * base;
            }
            base = base * base;
            exponent >>= 1;
        }
        power
    }

    /// 1/x = x̄/(x x̄), by Fermat's little theorem; `None` for 0.
    pub fn inverse(self) -> Option<Self> {
        let norm = self.norm();
        (norm != Self::ZERO)
            .then(|| Self(self.0, negative(self.1)) * norm.positive_power(u128::from(PRIME) - 2))
    }

    /// x x̄ = a² + b²
    fn norm(self) -> Self {
        Self(fold(u128::from(product(self.0, self.0)) + u128::from(product(self.1, self.1))), 0)
    }

    /// A number whose square this is, always the same one of the two; `None` if there is none.
    pub fn root(self) -> Option<Self> {
        if self.1 == 0 {
            return Some(self.root_of_integer());
        }
        // (c + d i)² = a + b i with c² = (a ± √(a² + b²))/2 and d = b/2c
        let size = self.norm().root_of_integer();
        let half = Self(PRIME.div_ceil(2), 0);
        let of_sign = |size: Self| {
            let c = ((Self(self.0, 0) + size) * half).root_of_integer();
            let root = Self(c.0, 0) + Self(0, (Self(self.1, 0) * half * c.inverse()?).0);
            (root * root == self).then_some(root)
        };
        of_sign(size).or_else(|| of_sign(-size))
    }

    /// √a, or i√−a: of the one of a and −a that is a square, x^((p + 1)/4) is a root.
    fn root_of_integer(self) -> Self {
        let of_square = |x: Self| {
            let root = x.positive_power(1 << 59);
            (root * root == x).then_some(root)
        };
        of_square(self).or_else(|| of_square(-self).map(|root| Self(0, root.0))).unwrap_or(Self::ZERO)
    }

    /// √(numerator/denominator), the product of the roots of prime factors: so √6 = √2 √3. Those
    /// of 2, 3 and 5 are made of cosines, to which they are related. `None` below 0.
    pub fn root_of_ratio(numerator: i64, denominator: i64) -> Option<Self> {
        let of_denominator = root_of_positive(denominator)?;
        Some(root_of_positive(numerator)? * of_denominator.inverse()?)
    }

    /// The turn by (numerator/denominator) π, whose cosine is [`Residue::cosine`]; `None` where
    /// that is no number of parts.
    pub fn turn(numerator: i64, denominator: i64) -> Option<Self> {
        let count = numerator.rem_euclid(denominator.checked_mul(2)?).checked_mul(PARTS)?;
        (count % denominator == 0).then(|| PART.positive_power((count / denominator) as u128))
    }

    /// cos x = (z + 1/z)/2 of the turn z = exp(i x).
    pub fn cosine(self) -> Option<Self> {
        Some((self + self.inverse()?) * Self(PRIME.div_ceil(2), 0))
    }

    /// sin x = (z − 1/z)/2i of the turn z = exp(i x).
    pub fn sine(self) -> Option<Self> {
        let twice = Self::turn(1, 2)? * Self::integer(2);
        Some((self - self.inverse()?) * twice.inverse()?)
    }

    /// tan x of the turn exp(i x).
    pub fn tangent(self) -> Option<Self> {
        Some(self.sine()? * self.cosine()?.inverse()?)
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(sum(self.0, other.0), sum(self.1, other.1))
    }
}

impl Neg for Residue {
    type Output = Self;
    fn neg(self) -> Self {
        Self(negative(self.0), negative(self.1))
    }
}

impl Sub for Residue {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Residue {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.1 == 0 && other.1 == 0 {
            return Self(product(self.0, other.0), 0);
        }
        let real = sum(product(self.0, other.0), negative(product(self.1, other.1)));
        Self(real, sum(product(self.0, other.1), product(self.1, other.0)))
    }
}

/// x modulo the prime: 2⁶¹ = 1.
fn fold(x: u128) -> u64 {
    let prime = u128::from(PRIME);
    let once = (x & prime) + (x >> 61);
    let twice = ((once & prime) + (once >> 61)) as u64;
    if twice >= PRIME { twice - PRIME } else { twice }
}

fn sum(a: u64, b: u64) -> u64 {
    if a + b >= PRIME { a + b - PRIME } else { a + b }
}

fn negative(a: u64) -> u64 {
    if a == 0 { 0 } else { PRIME - a }
}

fn product(a: u64, b: u64) -> u64 {
    fold(u128::from(a) * u128::from(b))
}

/// A step of SplitMix64 (Steele et al. 2014).
fn mix(state: u64) -> u64 {
    let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Larger prime factors are not looked for: what is left is treated as one.
const LARGEST_FACTOR: i64 = 1 << 12;

fn root_of_positive(mut n: i64) -> Option<Residue> {
    if n <= 0 {
        return (n == 0).then_some(Residue::ZERO);
    }
    let mut root = Residue::ONE;
    let mut prime = 2;
    while prime <= LARGEST_FACTOR && prime * prime <= n {
        while n % (prime * prime) == 0 {
            n /= prime * prime;
            root = root * Residue::integer(prime);
        }
        if n % prime == 0 {
            n /= prime;
            root = root * root_of_prime(prime)?;
        }
        prime += 1;
    }
    let whole = n.isqrt();
    let rest = if whole * whole == n { Residue::integer(whole) } else { root_of_prime(n)? };
    Some(root * rest)
}

/// √2 = 2 cos π/4, √3 = 2 cos π/6, √5 = 4 cos π/5 − 1.
fn root_of_prime(n: i64) -> Option<Residue> {
    let cosine = |denominator| Residue::turn(1, denominator).and_then(Residue::cosine);
    match n {
        2 => Some(cosine(4)? * Residue::integer(2)),
        3 => Some(cosine(6)? * Residue::integer(2)),
        5 => Some(cosine(5)? * Residue::integer(4) - Residue::ONE),
        _ => Residue::integer(n).root(),
    }
}

#[cfg(test)]
mod tests {
    use super::{PART, PARTS, Residue};

    fn some() -> [Residue; 3] {
        [0, 1, 2].map(|reason| Residue::stand_in(reason, &[]))
    }

    #[test]
    fn a_field() {
        let [x, y, z] = some();
        assert_eq!(x * (y + z), x * y + x * z);
        assert_eq!((x * y) * z, x * (y * z));
        assert_eq!(x.inverse().map(|inverse| x * inverse), Some(Residue::ONE));
        assert_eq!(x.power(-3).zip(x.power(3)).map(|(a, b)| a * b), Some(Residue::ONE));
        assert_eq!(Residue::ratio(1, 3).zip(Residue::ratio(1, 6)).map(|(a, b)| a + b), Residue::ratio(1, 2));
        assert_eq!(Residue::ZERO.inverse(), None);
    }

    #[test]
    fn floats_are_the_fractions_that_they_are() {
        assert_eq!(Residue::float(0.375), Residue::ratio(3, 8));
        assert_eq!(Residue::float(-1e15), Some(Residue::integer(-1_000_000_000_000_000_i64)));
        assert_eq!(
            Residue::float(f64::MIN_POSITIVE / 4.0).map(|x| x + x),
            Residue::float(f64::MIN_POSITIVE / 2.0)
        );
        assert_eq!(Residue::float(f64::NAN), None);
    }

    #[test]
    fn roots_multiply() {
        let root = |n, d| Residue::root_of_ratio(n, d).expect("a root");
        for n in 1..200 {
            assert_eq!(root(n, 1) * root(n, 1), Residue::integer(n));
            assert_eq!(root(n, 7) * root(6, 5), root(6 * n, 35));
        }
        let [x, ..] = some();
        let square = x * x;
        let again = square.root().expect("the root of a square");
        assert!(again == x || again == -x);
    }

    #[test]
    fn turns_are_those_of_the_circle() {
        let turn = |n, d| Residue::turn(n, d).expect("whole parts");
        assert_eq!(PART.power(PARTS), Some(Residue::integer(-1)));
        for divisor in [2, 3, 5, 7] {
            assert_ne!(PART.power(2 * PARTS / divisor), Some(Residue::ONE), "{divisor}");
        }
        let (cosine, sine) =
            (turn(61, 180).cosine().expect("a cosine"), turn(61, 180).sine().expect("a sine"));
        assert_eq!(cosine * cosine + sine * sine, Residue::ONE);
        assert_eq!(turn(1, 3).cosine(), Residue::ratio(1, 2));
        assert_eq!(turn(-1, 6).sine(), Residue::ratio(-1, 2));
        assert_eq!(turn(1, 2).sine(), Some(Residue::ONE));
        assert_eq!(turn(2, 5).then_cosine(turn(1, 5)), turn(3, 5).cosine());
        assert_eq!(Residue::turn(1, 11), None);
    }

    impl Residue {
        /// cos(a + b) = cos a cos b − sin a sin b
        fn then_cosine(self, other: Self) -> Option<Self> {
            Some(self.cosine()? * other.cosine()? - self.sine()? * other.sine()?)
        }
    }
}
