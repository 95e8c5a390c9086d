//! Baumgarte's feedback of the constraint violation.

use core::marker::PhantomData;

use crate::{Error, Gains, Held, Method, Real};

/// Baumgarte stabilization: Φ̈ = 0 is replaced by Φ̈ + 2αΦ̇ + β²Φ = 0, so that
/// a violation decays instead of growing (Baumgarte 1972; Jiang 2025, §4.2). Of an equation between rates, which has no
/// Φ, Φ̈ + αΦ̇ = 0.
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
pub struct Baumgarte<X: Method = Held> {
    alpha: f64,
    beta: f64,
    method: PhantomData<X>,
}

impl<X: Method> Baumgarte<X> {
    /// No feedback: violations drift.
    pub const NONE: Self = Self::from_gains(0.0, 0.0);

    const fn from_gains(alpha: f64, beta: f64) -> Self {
        Self { alpha, beta, method: PhantomData }
    }

    /// Feedback with gains α, β in 1/s.
    ///
    /// # Errors
    /// [`Error::Gain`] if one is negative or not finite, [`Error::NoUseOfGain`] for one that is
    /// not 0 with [`Projected`](crate::Projected).
    pub const fn new(alpha: f64, beta: f64) -> Result<Self, Error> {
        if !(alpha >= 0.0 && alpha.is_finite()) {
            return Err(Error::Gain { name: "alpha", value: alpha });
        }
        if !(beta >= 0.0 && beta.is_finite()) {
            return Err(Error::Gain { name: "beta", value: beta });
        }
        if X::EXPLICIT.is_projected() && alpha != 0.0 {
            return Err(Error::NoUseOfGain { name: "alpha", value: alpha });
        }
        if X::EXPLICIT.is_projected() && beta != 0.0 {
            return Err(Error::NoUseOfGain { name: "beta", value: beta });
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

    /// The gains that bring the violation of the linear model ë + 2αė + β²e = 0 to zero
    /// within two steps of `h` seconds; see [`Explicit::deadbeat`](crate::Explicit::deadbeat)
    /// for where they come from.
    ///
    /// Held, with any scheme, αh = 3/4 and βh = 1. Per stage, αh = 1 and βh = √2 with
    /// Heun's method.
    pub const fn deadbeat(h: f64) -> Self {
        let [alpha, beta] = X::EXPLICIT.deadbeat(h);
        Self::from_gains(alpha, beta)
    }

    /// True if violations do not grow with steps of `h` seconds: both eigenvalues of the
    /// step map of ë + 2αė + β²e = 0 lie in the closed unit disc; see
    /// [`Explicit::is_stable`](crate::Explicit::is_stable).
    ///
    /// It is a statement on the linear model: a mechanism whose constraints curve strongly
    /// within a step may need smaller gains.
    pub const fn is_stable(&self, h: f64) -> bool {
        X::EXPLICIT.is_stable([self.alpha, self.beta], h)
    }

    /// −2α and −β², as generated code takes them.
    pub fn gains<T: Real>(&self) -> Gains<T> {
        Gains {
            minus_two_alpha: T::from_f64(-2.0 * self.alpha),
            minus_beta_squared: T::from_f64(-self.beta * self.beta),
        }
    }
}
