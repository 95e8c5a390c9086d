//! Exact arithmetic modulo the prime 2⁶¹ − 1.
//!
//! A polynomial identity that holds for numbers holds here; one that does not
//! hold shows at a random point, but for a chance of its degree over 2⁶¹
//! (Schwartz, Zippel), below 1e-12 for anything a person writes.

use std::ops::{Add, Mul, Neg, Sub};

use super::sparse::{Pivots, SparseRow, subtract};

/// 2⁶¹ − 1
const PRIME: u64 = (1 << 61) - 1;

/// A number modulo the prime.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Residue(u64);

impl Residue {
    pub const ZERO: Self = Self(0);
    pub const ONE: Self = Self(1);

    /// From random bits: uniform but for 8 of 2⁶⁴ values.
    pub fn from_bits(bits: u64) -> Self {
        Self(bits % PRIME)
    }

    pub fn integer(value: i64) -> Self {
        let magnitude = Self::from_bits(value.unsigned_abs());
        if value < 0 { -magnitude } else { magnitude }
    }

    pub fn power(self, mut exponent: u64) -> Self {
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

    /// 1/x by Fermat's little theorem; `None` for 0.
    pub fn inverse(self) -> Option<Self> {
        (self != Self::ZERO).then(|| self.power(PRIME - 2))
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self((self.0 + other.0) % PRIME)
    }
}

impl Neg for Residue {
    type Output = Self;
    fn neg(self) -> Self {
        Self((PRIME - self.0) % PRIME)
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
        Self((u128::from(self.0) * u128::from(other.0) % u128::from(PRIME)) as u64)
    }
}

/// A point of the circle c² + s² = 1: an angle that is added, and multiplied by
/// integers, as angles are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    pub cos: Residue,
    pub sin: Residue,
}

impl Turn {
    /// No turn at all.
    pub const NONE: Self = Self { cos: Residue::ONE, sin: Residue::ZERO };
    /// A right angle.
    pub const RIGHT: Self = Self { cos: Residue::ZERO, sin: Residue::ONE };

    /// The point of half-angle tangent u; `None` where 1 + u² = 0.
    pub fn of_half_tangent(u: Residue) -> Option<Self> {
        let inverse = (Residue::ONE + u * u).inverse()?;
        Some(Self { cos: (Residue::ONE - u * u) * inverse, sin: (u + u) * inverse })
    }

    /// The sum of two angles.
    pub fn then(self, other: Self) -> Self {
        Self {
            cos: self.cos * other.cos - self.sin * other.sin,
            sin: self.sin * other.cos + self.cos * other.sin,
        }
    }

    /// `count` times the angle.
    pub fn times(self, count: i64) -> Self {
        let once = if count < 0 { Self { sin: -self.sin, ..self } } else { self };
        let (mut left, mut doubled, mut sum) = (count.unsigned_abs(), once, Self::NONE);
        while left > 0 {
            if left & 1 == 1 {
                sum = sum.then(doubled);
            }
            doubled = doubled.then(doubled);
            left >>= 1;
        }
        sum
    }
}

/// The rows that are combinations of earlier ones, and of which: exact.
pub fn dependent_rows(rows: Vec<SparseRow<Residue>>) -> Vec<(usize, Vec<usize>)> {
    /// Divided by its pivot, with how it came from the given rows.
    struct Reduced {
        entries: SparseRow<Residue>,
        history: SparseRow<Residue>,
    }
    let mut basis: Vec<Reduced> = Vec::new();
    let mut pivots = Pivots::default();
    let mut dependent = Vec::new();
    for (at, mut entries) in rows.into_iter().enumerate() {
        entries.retain(|(_, entry)| *entry != Residue::ZERO);
        let mut history = vec![(at, Residue::ONE)];
        let mut next = 0;
        while let Some((earlier, _, factor)) = pivots.first(&entries, next) {
            entries = subtract(&entries, factor, &basis[earlier].entries);
            history = subtract(&history, factor, &basis[earlier].history);
            next = earlier + 1;
        }
        let first = entries.first().and_then(|(pivot, entry)| Some((*pivot, entry.inverse()?)));
        let Some((pivot, inverse)) = first else {
            dependent.push((at, history.into_iter().map(|(row, _)| row).filter(|&row| row != at).collect()));
            continue;
        };
        for (_, entry) in entries.iter_mut().chain(&mut history) {
            *entry = *entry * inverse;
        }
        pivots.insert(pivot, basis.len());
        basis.push(Reduced { entries, history });
    }
    dependent
}

#[cfg(test)]
mod tests {
    use super::{Residue, SparseRow, Turn, dependent_rows};

    #[test]
    fn a_field() {
        let x = Residue::from_bits(0x1234_5678_9abc_def0);
        let inverse = x.inverse().expect("not 0");
        assert_eq!(x * inverse, Residue::ONE);
        assert_eq!(Residue::integer(-3) + Residue::integer(3), Residue::ZERO);
        assert_eq!(Residue::ZERO.inverse(), None);
    }

    #[test]
    fn turns_add_up() {
        let a = Turn::of_half_tangent(Residue::integer(7)).expect("1 + 49 is not 0");
        assert_eq!(a.cos * a.cos + a.sin * a.sin, Residue::ONE);
        assert_eq!(a.times(5), a.times(7).then(a.times(-2)));
        assert_eq!(Turn::RIGHT.times(4), Turn::NONE);
    }

    #[test]
    fn a_dependent_row_names_the_rows_it_is_made_of() {
        let row = |entries: &[i64]| -> SparseRow<Residue> {
            entries.iter().enumerate().map(|(at, &x)| (at, Residue::integer(x))).collect()
        };
        let rows = vec![row(&[1, 2, 3]), row(&[0, 1, 1]), row(&[1, 0, 0]), row(&[2, 5, 7]), row(&[0, 0, 0])];
        assert_eq!(dependent_rows(rows), [(3, vec![0, 1]), (4, vec![])]);
    }
}
