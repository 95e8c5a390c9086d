//! A scalar that carries its first and second derivative along one direction,
//! so that generated code, run with it, differentiates itself.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use mbs_runtime::Real;

/// x, x′ and x″ with respect to one variable s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Jet {
    /// x
    pub value: f64,
    /// dx/ds
    pub first: f64,
    /// d²x/ds²
    pub second: f64,
}

impl Jet {
    /// x(s) = value + s·first
    pub fn line(value: f64, first: f64) -> Self {
        Self { value, first, second: 0.0 }
    }

    /// f(x) from f, f′ and f″ at x: (f∘x)″ = f″ x′² + f′ x″.
    fn chain(self, f: f64, df: f64, ddf: f64) -> Self {
        Self { value: f, first: df * self.first, second: ddf * self.first * self.first + df * self.second }
    }

    fn recip(self) -> Self {
        let r = 1.0 / self.value;
        self.chain(r, -r * r, 2.0 * r * r * r)
    }
}

impl PartialEq for Jet {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Jet {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl fmt::Display for Jet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, y: Self) -> Self {
        Self { value: self.value + y.value, first: self.first + y.first, second: self.second + y.second }
    }
}

impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, first: -self.first, second: -self.second }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, y: Self) -> Self {
        Self {
            value: self.value * y.value,
            first: self.first * y.value + self.value * y.first,
            second: self.second * y.value + 2.0 * self.first * y.first + self.value * y.second,
        }
    }
}

impl Div for Jet {
    type Output = Self;
    fn div(self, y: Self) -> Self {
        self.mul(y.recip())
    }
}

impl Real for Jet {
    const EPSILON: Self = Self { value: f64::EPSILON, first: 0.0, second: 0.0 };
    type Pair = mbs_runtime::Two<Self>;

    fn from_f64(x: f64) -> Self {
        Self::line(x, 0.0)
    }
    fn to_f64(self) -> f64 {
        self.value
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.first.is_finite() && self.second.is_finite()
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c, -s), self.chain(c, -s, -c))
    }
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    fn tan(self) -> Self {
        let (s, c) = self.sin_cos();
        s / c
    }
    fn asin(self) -> Self {
        let x = self.value;
        let r = 1.0 / (1.0 - x * x).sqrt();
        self.chain(x.asin(), r, x * r * r * r)
    }
    fn acos(self) -> Self {
        Self::from_f64(std::f64::consts::FRAC_PI_2) - self.asin()
    }
    fn atan(self) -> Self {
        let x = self.value;
        let r = 1.0 / (1.0 + x * x);
        self.chain(x.atan(), r, -2.0 * x * r * r)
    }
    /// The angle of a vector changes as the angle of the vector seen from
    /// itself, where the arctangent is smooth.
    fn atan2(self, x: Self) -> Self {
        let along = self * Self::from_f64(self.value) + x * Self::from_f64(x.value);
        let across = self * Self::from_f64(x.value) - x * Self::from_f64(self.value);
        let turned = (across / along).atan();
        Self { value: self.value.atan2(x.value), ..turned }
    }
    fn sqrt(self) -> Self {
        let r = self.value.sqrt();
        self.chain(r, 0.5 / r, -0.25 / (r * self.value))
    }
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e, e)
    }
    fn ln(self) -> Self {
        let r = 1.0 / self.value;
        self.chain(self.value.ln(), r, -r * r)
    }
    fn tanh(self) -> Self {
        let f = self.value.tanh();
        let df = 1.0 - f * f;
        self.chain(f, df, -2.0 * f * df)
    }
    fn pow(self, exponent: Self) -> Self {
        let power = (exponent * self.ln()).exp();
        Self { value: self.value.powf(exponent.value), ..power }
    }
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    fn sign(self) -> Self {
        Self::from_f64(Real::sign(self.value))
    }
    fn min(self, other: Self) -> Self {
        if self.value < other.value { self } else { other }
    }
    fn max(self, other: Self) -> Self {
        if self.value > other.value { self } else { other }
    }
    fn greater(self, other: Self) -> Self {
        Self::from_f64(f64::from(u8::from(self.value > other.value)))
    }
}

/// Compares all that a mechanism generates with what jets find in a Φ of (t, q):
/// Φ itself, Φ_q column by column, Φ_t along t, Φ̇ and −γ as the first and second
/// derivative of Φ(q + s v, t + s) at s = 0.
#[macro_export]
macro_rules! check_against_jets {
    ($mechanism:ident, $coordinates:ident, $phi:expr, $position:expr, $rate:expr, $tolerance:expr) => {{
        use $crate::jet::Jet;
        let plain = $mechanism::<f64>::default();
        let mut random = $crate::random::Random::new(6);
        let mut worst = 0.0_f64;
        for _ in 0..1000 {
            let q: [f64; $coordinates::<f64>::NAMES.len()] = random.around_zero($position);
            let v: [f64; $coordinates::<f64>::NAMES.len()] = random.around_zero($rate);
            let t = random.between(0.0, 1.0);
            let at = mbs_runtime::State { t, q: $coordinates::from_array(q), v: $coordinates::from_array(v) };
            let along = |direction: &dyn Fn(usize) -> f64, of_time: f64| {
                $phi(Jet::line(t, of_time), std::array::from_fn(|i| Jet::line(q[i], direction(i))))
            };
            let mut compare = |what: &str, ours: f64, jet: f64, scale: f64| {
                let deviation = (ours - jet).abs() / (1.0 + scale);
                worst = worst.max(deviation);
                assert!(deviation <= $tolerance, "{what}: {ours:e} and {jet:e} at {at:?}");
            };

            let rows = plain.phi(t, &at.q).into_array();
            for (ours, jet) in rows.iter().zip(along(&|_| 0.0, 0.0)) {
                compare("Φ", *ours, jet.value, jet.value.abs());
            }
            let phi_q = plain.phi_q(t, &at.q);
            for column in 0..q.len() {
                let jets = along(&|i| f64::from(u8::from(i == column)), 0.0);
                for (row, jet) in jets.iter().enumerate() {
                    compare("Φ_q", phi_q[(row, column)], jet.first, jet.first.abs());
                }
            }
            let rows = plain.phi_t(t, &at.q).into_array();
            for (ours, jet) in rows.iter().zip(along(&|_| 0.0, 1.0)) {
                compare("Φ_t", *ours, jet.first, jet.first.abs());
            }
            let (phi_dot, gamma) = (plain.phi_dot(&at).into_array(), plain.gamma(&at).into_array());
            for (row, jet) in along(&|i| v[i], 1.0).iter().enumerate() {
                compare("Φ̇", phi_dot[row], jet.first, $rate);
                compare("γ", gamma[row], -jet.second, $rate * $rate);
            }
        }
        println!("{}: {worst:.1e}", stringify!($mechanism));
    }};
}
