//! Baumgarte's feedback of the constraint violation.

use core::marker::PhantomData;

use crate::{Error, Gains, Real};

/// Feedback evaluated in both stages of Heun's method, as Eq. (8) of the paper
/// has it.
///
/// The predictor's O(h²) position error is fed back with β² ~ 1/h², so the
/// second stage's acceleration is off by O(1): positions stay second order, but
/// multipliers taken with these terms are wrong however small ‖Φ‖ looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PerStage {}

/// Feedback evaluated once, at the start of the step, and held over it. The
/// default: it leaves the second stage free of the predictor's error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::PerStage {}
    impl Sealed for super::Held {}
}

/// When the feedback is evaluated: [`PerStage`] or [`Held`].
pub trait Feedback: sealed::Sealed + Copy + core::fmt::Debug + Send + Sync + 'static {
    /// `per-stage` or `held`.
    const NAME: &'static str;
    /// Whether it is the same in both stages of a step.
    const IS_HELD: bool;
}

impl Feedback for PerStage {
    const NAME: &'static str = "per-stage";
    const IS_HELD: bool = false;
}

impl Feedback for Held {
    const NAME: &'static str = "held";
    const IS_HELD: bool = true;
}

/// Baumgarte stabilization: Φ̈ = 0 is replaced by Φ̈ + 2αΦ̇ + β²Φ = 0, so that
/// a violation decays instead of growing (Baumgarte 1972; Jiang 2025, §4.2).
///
/// # Example
/// ```
/// use mbs_runtime::{Baumgarte, Held, PerStage};
///
/// let h = 0.5e-3;
/// let paper = Baumgarte::<PerStage>::new(2000.0, 2000.0)?;
/// assert!(paper.is_stable(h));
/// assert!(!Baumgarte::<PerStage>::new(2600.0, 2000.0)?.is_stable(h));
///
/// // The gains that remove a violation within two steps.
/// let best = Baumgarte::<Held>::deadbeat(h);
/// assert_eq!((best.alpha(), best.beta()), (1500.0, 2000.0));
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Baumgarte<F: Feedback = Held> {
    alpha: f64,
    beta: f64,
    feedback: PhantomData<F>,
}

impl<F: Feedback> Baumgarte<F> {
    /// No feedback: violations drift.
    pub const NONE: Self = Self::from_gains(0.0, 0.0);

    const fn from_gains(alpha: f64, beta: f64) -> Self {
        Self { alpha, beta, feedback: PhantomData }
    }

    /// Feedback with gains α, β in 1/s.
    ///
    /// # Errors
    /// [`Error::Gain`] if one is negative or not finite.
    pub const fn new(alpha: f64, beta: f64) -> Result<Self, Error> {
        if !(alpha >= 0.0 && alpha.is_finite()) {
            return Err(Error::Gain { name: "alpha", value: alpha });
        }
        if !(beta >= 0.0 && beta.is_finite()) {
            return Err(Error::Gain { name: "beta", value: beta });
        }
        Ok(Self::from_gains(alpha, beta))
    }

    /// α in 1/s.
    pub const fn alpha(&self) -> f64 {
        self.alpha
    }

    /// β in 1/s.
    pub const fn beta(&self) -> f64 {
        self.beta
    }

    /// The gains that bring the violation of the linear model
    /// ë + 2αė + β²e = 0 to zero within two steps of `h` seconds.
    ///
    /// Per stage, 1 + z + z²/2 vanishes at both roots of z² + 2αh z + (βh)²,
    /// which gives αh = 1, βh = √2; held, the step map is nilpotent for
    /// αh = 3/4, βh = 1.
    pub const fn deadbeat(h: f64) -> Self {
        if F::IS_HELD {
            Self::from_gains(0.75 / h, 1.0 / h)
        } else {
            Self::from_gains(1.0 / h, core::f64::consts::SQRT_2 / h)
        }
    }

    /// Whether violations do not grow with steps of `h` seconds: both
    /// eigenvalues of the step map of ë + 2αė + β²e = 0 under Heun's method lie
    /// in the closed unit disc.
    ///
    /// With a = 2αh and b = (βh)² the map has trace τ and determinant δ:
    /// per stage τ = 2 − a + a²/2 − b and δ = 1 − a + a²/2 − ab/2 + b²/4, held
    /// τ = 2 − a − b/2 and δ = 1 − a + b/2; by Jury's criterion it is stable if
    /// |τ| ≤ 1 + δ and δ ≤ 1 (to rounding, so that the exact limit counts as
    /// stable). It is a statement on the linear model: a mechanism whose
    /// constraints curve strongly within a step may need smaller gains.
    pub const fn is_stable(&self, h: f64) -> bool {
        let a = 2.0 * self.alpha * h;
        let b = self.beta * h * (self.beta * h);
        let (trace, determinant) = if F::IS_HELD {
            (2.0 - a - b / 2.0, 1.0 - a + b / 2.0)
        } else {
            (2.0 - a + a * a / 2.0 - b, 1.0 - a + a * a / 2.0 - a * b / 2.0 + b * b / 4.0)
        };
        // a handful of roundings of terms of this size
        let slack = 8.0 * f64::EPSILON * (1.0 + a * a + b * b);
        trace.abs() <= 1.0 + determinant + slack && determinant <= 1.0 + slack
    }

    /// −2α and −β², as generated code takes them.
    pub fn gains<T: Real>(&self) -> Gains<T> {
        Gains {
            minus_two_alpha: T::from_f64(-2.0 * self.alpha),
            minus_beta_squared: T::from_f64(-self.beta * self.beta),
        }
    }
}
