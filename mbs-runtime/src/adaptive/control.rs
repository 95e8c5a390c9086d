//! How long steps are that keep a tolerance.

use mbs_interface::Estimate;

use crate::{Error, Real};

/// The tolerances of a run, its longest step and its first one.
///
/// The error that a step adds is estimated per component: it is allowed to be
///
/// ```text
/// atol + rtol · max(|x before|, |x after|)
/// ```
///
/// for positions and velocities, in SI units and rad, and for coordinates and states of the mechanism's own in the
/// units in which they are declared. The steps are as long as the root mean
/// square of error/allowed permits. The errors of all steps add up, so that the error at the end
/// of a run is a few times the tolerance, and more where the motion itself amplifies errors.
///
/// # Example
/// ```
/// use mbs_runtime::{Error, Tolerances};
///
/// let fine = Tolerances { rtol: 1e-10, atol: 1e-12, ..Tolerances::default() };
/// assert!(fine.check::<f64>().is_ok());
/// assert!(matches!(fine.check::<f32>(), Err(Error::Tolerance { name: "rtol", .. })));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// The relative error that a step may add.
    pub rtol: f64,
    /// The absolute error that a step may add, in m, rad, m/s or rad/s, or in the unit in which a coordinate or a
    /// state is declared.
    pub atol: f64,
    /// The longest step in s; infinite for none.
    pub max_step: f64,
    /// The first step in s that is tried; `None` for one that the motion suggests.
    pub first_step: Option<f64>,
}

impl Default for Tolerances {
    /// 10⁻⁶ and 10⁻⁹.
    fn default() -> Self {
        Self::relative(1e-6)
    }
}

impl Tolerances {
    /// The smallest relative error that can be asked for, in roundings.
    const FINEST: f64 = 100.0;

    /// This relative error, and a thousandth of it as the absolute error, which then decides for small numbers only.
    ///
    /// # Example
    /// ```
    /// use mbs_runtime::Tolerances;
    ///
    /// assert_eq!(Tolerances::relative(1e-6), Tolerances::default());
    /// assert_eq!(Tolerances::relative(1e-12).atol, 1e-15);
    /// ```
    pub const fn relative(rtol: f64) -> Self {
        Self { rtol, atol: rtol / 1000.0, max_step: f64::INFINITY, first_step: None }
    }

    /// `Ok` if they can be kept with the scalar `T`.
    ///
    /// # Errors
    /// [`Error::Tolerance`] of one that is not positive, or that is below 100 roundings;
    /// [`Error::Step`].
    pub fn check<T: Real>(&self) -> Result<(), Error> {
        let finest = Self::FINEST * T::EPSILON.to_f64();
        for (name, value, least) in [("rtol", self.rtol, finest), ("atol", self.atol, f64::MIN_POSITIVE)] {
            if !(value >= least && value.is_finite()) {
                return Err(Error::Tolerance { name, value, least });
            }
        }
        let first = self.first_step.unwrap_or(1.0);
        if !(first > 0.0 && first.is_finite()) {
            return Err(Error::Step { step: first });
        }
        // infinity is a longest step
        if self.max_step > 0.0 { Ok(()) } else { Err(Error::Step { step: self.max_step }) }
    }
}

/// Steps are asked to stay below the tolerance by this factor, so that few are rejected.
const SAFETY: f64 = 0.9;
/// A step is at least and at most this much longer than the one before it.
const LEAST: f64 = 0.2;
const MOST: f64 = 10.0;
/// Where nothing happens, steps grow to so many seconds and no further.
const LONGEST: f64 = 1e9;
/// The step after one that could not be taken at all.
const AFTER_FAILURE: f64 = 0.25;

/// The proportional-integral control of the step: with the ratio e of error and allowed error,
/// and that of the step before,
///
/// ```text
/// h ← h · 0.9 e^(0.15/k − 1/k) e_before^(0.2/k)
/// ```
///
/// where e falls with hᵏ.
///
/// # Source
/// K. Gustafsson, Control theoretic techniques for stepsize selection in explicit Runge-Kutta
/// methods, ACM Trans. Math. Software 17 (1991) 533-554; the constants are those of Hairer,
/// Wanner, Solving Ordinary Differential Equations II, IV.2.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// The length of the next step in s.
    pub next: f64,
    /// Error over allowed error of the last step.
    before: f64,
    /// True if the step at hand was rejected.
    is_again: bool,
}

impl Control {
    /// Before the first step.
    pub fn new(first: f64) -> Self {
        Self { next: first, before: 1e-4, is_again: false }
    }

    /// True if a step of `h` seconds with this ratio of error and allowed error is good; says
    /// how long the next one is. A ratio that is no number is that of a step that failed.
    pub fn judge(&mut self, h: f64, ratio: f64, estimate: &Estimate) -> bool {
        let power = 1.0 / f64::from(estimate.power);
        let is_good = ratio <= 1.0;
        let factor = if is_good {
            // of no error the logarithm would be infinite
            let error = if ratio > 1e-10 { ratio } else { 1e-10 };
            let factor = SAFETY * pow(error, -0.85 * power) * pow(self.before, 0.2 * power);
            let most = if self.is_again { 1.0 } else { MOST };
            self.before = if error > 1e-4 { error } else { 1e-4 };
            clamp(factor, most)
        } else if ratio.is_finite() {
            clamp(SAFETY * pow(ratio, -power), 1.0)
        } else {
            AFTER_FAILURE
        };
        self.is_again = !is_good;
        self.next = (h * factor).min(LONGEST);
        is_good
    }
}

fn pow(x: f64, exponent: f64) -> f64 {
    Real::pow(x, exponent)
}

fn clamp(factor: f64, most: f64) -> f64 {
    if factor > most {
        most
    } else if factor > LEAST {
        factor
    } else {
        LEAST
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dopri5;
    use crate::Scheme;

    #[test]
    fn tolerances_that_mean_nothing_are_refused() {
        let of = |rtol, atol| Tolerances { rtol, atol, ..Tolerances::default() }.check::<f64>();
        assert!(of(1e-6, 1e-9).is_ok());
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-15] {
            assert!(matches!(of(value, 1e-9), Err(Error::Tolerance { name: "rtol", .. })), "{value}");
        }
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(of(1e-6, value), Err(Error::Tolerance { name: "atol", .. })), "{value}");
        }
        let longest = |max_step| Tolerances { max_step, ..Tolerances::default() }.check::<f64>();
        assert!(longest(0.0).is_err() && longest(f64::NAN).is_err() && longest(1e-3).is_ok());
        let first = |first| Tolerances { first_step: Some(first), ..Tolerances::default() }.check::<f64>();
        assert!(first(0.0).is_err() && first(f64::INFINITY).is_err() && first(1e-3).is_ok());
    }

    /// With an error of c hᵏ the control settles where the error is what is asked for.
    #[test]
    fn steps_settle_where_the_tolerance_is_met() {
        let estimate = Dopri5::TABLEAU.estimate.unwrap();
        let mut control = Control::new(1.0);
        let ratio = |h: f64| 1e7 * h.powi(5);
        let mut taken = 0;
        for _ in 0..60 {
            let h = control.next;
            taken += u32::from(control.judge(h, ratio(h), &estimate));
        }
        let settled = ratio(control.next);
        assert!(taken > 50 && settled < 1.0 && settled > 0.4, "{taken} {settled}");
    }

    #[test]
    fn a_step_is_not_longer_right_after_a_rejection() {
        let estimate = Dopri5::TABLEAU.estimate.unwrap();
        let mut control = Control::new(1.0);
        assert!(!control.judge(1.0, 32.0, &estimate) && control.next < 0.5);
        let shorter = control.next;
        assert!(control.judge(shorter, 1e-6, &estimate) && control.next == shorter);
        assert!(control.judge(shorter, 1e-6, &estimate) && control.next > 2.0 * shorter);
        assert!(!control.judge(1.0, f64::NAN, &estimate) && control.next == 0.25);
    }
}
