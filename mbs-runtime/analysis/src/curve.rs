//! Motions that are prescribed.

use mbs_runtime::Dual;

use crate::Error;

/// A time in s that carries two derivatives by itself; arithmetic and the functions of
/// [`Real`](mbs_runtime::Real) work on it.
pub type Time = Dual<Dual<f64, 1>, 1>;

/// A coordinate, its rate and its second rate at a moment, in SI units and rad. See the example of [`Curve`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// z
    pub position: f64,
    /// ż
    pub velocity: f64,
    /// z̈
    pub acceleration: f64,
}

/// A coordinate as a function of time.
///
/// # Example
/// ```
/// use mbs_analysis::Curve;
/// use mbs_runtime::{Dual, Real};
///
/// // 0.3 sin 2t, whose derivatives are exact
/// let two = Dual::constant(Dual::constant(2.0));
/// let amplitude = Dual::constant(Dual::constant(0.3));
/// let swing = Curve::function(move |t| amplitude * (two * t).sin());
/// let moment = swing.at(0.5);
/// assert!((moment.velocity - 0.6 * f64::cos(1.0)).abs() < 1e-15);
/// assert!((moment.acceleration + 1.2 * f64::sin(1.0)).abs() < 1e-15);
/// ```
pub struct Curve(Kind);

enum Kind {
    Function(Box<dyn Fn(Time) -> Time>),
    Spline(Spline),
    Polynomial { from: f64, to: f64, start: f64, duration: f64 },
}

impl Curve {
    /// A function of time. Its derivatives are exact: it is computed with numbers that carry them.
    pub fn function(function: impl Fn(Time) -> Time + 'static) -> Self {
        Self(Kind::Function(Box::new(function)))
    }

    /// The cubic spline through samples, whose two first and two last pieces are one cubic each
    /// ("not a knot"). For samples of a smooth motion at distance h its acceleration errs by O(h²).
    /// Before the first and after the last sample the outer pieces go on.
    ///
    /// # Errors
    /// [`Error::Samples`] unless there are four samples or more, finite, with ascending times.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::{Curve, Moment};
    ///
    /// // samples of t³
    /// let cubic = Curve::spline(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 8.0, 27.0])?;
    /// let Moment { position, velocity, acceleration } = cubic.at(1.5);
    /// assert!((position - 3.375).abs() < 1e-12);
    /// assert!((velocity - 6.75).abs() < 1e-12 && (acceleration - 9.0).abs() < 1e-12);
    /// # Ok::<(), mbs_analysis::Error>(())
    /// ```
    ///
    /// # Source
    /// C. de Boor, A Practical Guide to Splines, Springer 1978, chapter IV.
    pub fn spline(times: &[f64], values: &[f64]) -> Result<Self, Error> {
        Spline::through(times, values).map(|spline| Self(Kind::Spline(spline)))
    }

    /// A motion from rest to rest by the 3-4-5 polynomial, from + (to − from)(10τ³ − 15τ⁴ + 6τ⁵) with
    /// τ = (t − start)/duration. Before and after the motion the coordinate stands still.
    ///
    /// # Errors
    /// [`Error::Range`] for a duration that is not finite and above 0.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::Curve;
    ///
    /// // from 1 m to 3 m between 0.5 s and 2.5 s
    /// let lift = Curve::rest_to_rest(1.0, 3.0, 0.5, 2.0)?;
    /// let middle = lift.at(1.5);
    /// // halfway the speed is 15/8 of the mean speed
    /// assert_eq!((middle.position, middle.velocity, middle.acceleration), (2.0, 15.0 / 8.0, 0.0));
    /// assert_eq!((lift.at(0.0).position, lift.at(9.0).position), (1.0, 3.0));
    /// # Ok::<(), mbs_analysis::Error>(())
    /// ```
    ///
    /// # Source
    /// R. L. Norton, Cam Design and Manufacturing Handbook, Industrial Press 2002, section 3.5.
    pub fn rest_to_rest(from: f64, to: f64, start: f64, duration: f64) -> Result<Self, Error> {
        if duration > 0.0 && duration.is_finite() {
            return Ok(Self(Kind::Polynomial { from, to, start, duration }));
        }
        Err(Error::Range { what: "the duration", value: duration, unit: "s" })
    }

    /// The coordinate and its two derivatives at a time in s. See the example of [`Curve`].
    pub fn at(&self, t: f64) -> Moment {
        match &self.0 {
            Kind::Function(function) => {
                let moved = function(Dual::variable(Dual::variable(t, 0), 0));
                let [rate] = moved.partials;
                let [acceleration] = rate.partials;
                Moment { position: moved.value.value, velocity: rate.value, acceleration }
            }
            Kind::Spline(spline) => spline.at(t),
            Kind::Polynomial { from, to, start, duration } => {
                let tau = ((t - start) / duration).clamp(0.0, 1.0);
                let stroke = to - from;
                let rest = tau * (1.0 - tau);
                Moment {
                    position: from + stroke * tau * tau * tau * (10.0 - tau * (15.0 - 6.0 * tau)),
                    velocity: 30.0 * stroke / duration * rest * rest,
                    acceleration: 60.0 * stroke / (duration * duration) * rest * (1.0 - 2.0 * tau),
                }
            }
        }
    }
}

/// A piecewise cubic function with continuous second derivatives, given by those.
struct Spline {
    times: Vec<f64>,
    values: Vec<f64>,
    bends: Vec<f64>,
}

impl Spline {
    fn through(times: &[f64], values: &[f64]) -> Result<Self, Error> {
        let wrong = |reason| Err(Error::Samples { reason });
        if times.len() != values.len() {
            return wrong("there are not as many values as times");
        }
        if times.len() < 4 {
            return wrong("a spline needs four of them or more");
        }
        if times.iter().chain(values).any(|x| !x.is_finite()) {
            return wrong("one is no finite number");
        }
        if times.windows(2).any(|pair| pair[0] >= pair[1]) {
            return wrong("their times have to ascend");
        }
        let bends = bends(times, values);
        Ok(Self { times: times.to_vec(), values: values.to_vec(), bends })
    }

    fn at(&self, t: f64) -> Moment {
        let last = self.times.len() - 2;
        let piece = self.times.partition_point(|time| *time <= t).saturating_sub(1).min(last);
        let [t0, t1] = [self.times[piece], self.times[piece + 1]];
        let [y0, y1] = [self.values[piece], self.values[piece + 1]];
        let [m0, m1] = [self.bends[piece], self.bends[piece + 1]];
        let (h, b) = (t1 - t0, t - t0);
        let a = h - b;
        Moment {
            position: (m0 * a * a * a + m1 * b * b * b) / (6.0 * h)
                + (y0 / h - m0 * h / 6.0) * a
                + (y1 / h - m1 * h / 6.0) * b,
            velocity: (m1 * b * b - m0 * a * a) / (2.0 * h) + (y1 - y0) / h - (m1 - m0) * h / 6.0,
            acceleration: (m0 * a + m1 * b) / h,
        }
    }
}

/// The second derivatives at the samples. The rows of inner samples are tridiagonal; M₀ and M_n are
/// eliminated by the third derivatives that are equal on both sides of the samples beside them.
fn bends(times: &[f64], values: &[f64]) -> Vec<f64> {
    let n = times.len() - 1;
    let h: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slope = |at: usize| (values[at + 1] - values[at]) / h[at];
    let (mut diagonal, mut upper, mut right) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut lower = vec![0.0; n];
    for at in 1..n {
        lower[at] = h[at - 1];
        diagonal[at] = 2.0 * (h[at - 1] + h[at]);
        upper[at] = h[at];
        right[at] = 6.0 * (slope(at) - slope(at - 1));
    }
    // M₀ = M₁ + (M₁ − M₂) h₀/h₁, and the same at the other end
    let (first, last) = (h[0] / h[1], h[n - 1] / h[n - 2]);
    diagonal[1] += h[0] * (1.0 + first);
    upper[1] -= h[0] * first;
    diagonal[n - 1] += h[n - 1] * (1.0 + last);
    lower[n - 1] -= h[n - 1] * last;
    for at in 2..n {
        let share = lower[at] / diagonal[at - 1];
        diagonal[at] -= share * upper[at - 1];
        right[at] -= share * right[at - 1];
    }
    let mut bends = vec![0.0; n + 1];
    for at in (1..n).rev() {
        let behind = if at + 1 < n { upper[at] * bends[at + 1] } else { 0.0 };
        bends[at] = (right[at] - behind) / diagonal[at];
    }
    bends[0] = bends[1] + (bends[1] - bends[2]) * first;
    bends[n] = bends[n - 1] + (bends[n - 1] - bends[n - 2]) * last;
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_gives_a_cubic_back() {
        let cubic = |t: f64| 1.0 + t * (2.0 + t * (-3.0 + t * 0.5));
        let times = [0.0, 0.3, 0.5, 1.2, 2.0];
        let spline = Curve::spline(&times, &times.map(cubic)).unwrap();
        for t in [-0.1, 0.0, 0.4, 1.9, 2.0, 2.3] {
            let moment = spline.at(t);
            assert!((moment.position - cubic(t)).abs() < 1e-13);
            assert!((moment.velocity - (2.0 + t * (-6.0 + 1.5 * t))).abs() < 1e-12);
            assert!((moment.acceleration - (-6.0 + 3.0 * t)).abs() < 1e-12);
        }
    }

    /// The error of the acceleration falls with h².
    #[test]
    fn a_spline_has_its_order() {
        let error = |count: u32| {
            let times: Vec<f64> = (0..=count).map(|at| f64::from(at) / f64::from(count)).collect();
            let values: Vec<f64> = times.iter().map(|t| (3.0 * t).sin()).collect();
            let spline = Curve::spline(&times, &values).unwrap();
            let open = |at: u32| {
                let t = f64::from(at) / 6400.0;
                (spline.at(t).acceleration + 9.0 * (3.0 * t).sin()).abs()
            };
            (0..=6400).map(open).fold(0.0, f64::max)
        };
        let order = (error(320) / error(640)).log2();
        assert!((order - 2.0).abs() < 0.1, "{order}");
    }

    #[test]
    fn the_polynomial_rests_at_both_ends() {
        let curve = Curve::rest_to_rest(1.0, 3.0, 0.5, 2.0).unwrap();
        let still = |position| Moment { position, ..Moment::default() };
        assert_eq!(curve.at(0.5), still(1.0));
        assert_eq!(curve.at(9.0), still(3.0));
        let middle = curve.at(1.5);
        assert_eq!((middle.position, middle.velocity, middle.acceleration), (2.0, 1.875, 0.0));
        // the acceleration is the difference of velocities
        let change = (curve.at(1.0 + 1e-5).velocity - curve.at(1.0 - 1e-5).velocity) / 2e-5;
        assert!((change - curve.at(1.0).acceleration).abs() < 1e-8);
    }

    #[test]
    fn samples_that_are_none() {
        let message = |times: &[f64], values: &[f64]| Curve::spline(times, values).err().unwrap().to_string();
        assert!(message(&[0.0, 1.0, 2.0], &[0.0; 3]).contains("four"));
        assert!(message(&[0.0, 1.0, 1.0, 2.0], &[0.0; 4]).contains("ascend"));
        assert!(message(&[0.0, 1.0, 2.0, 3.0], &[0.0, f64::NAN, 0.0, 0.0]).contains("finite"));
        assert!(Curve::rest_to_rest(0.0, 1.0, 0.0, 0.0).is_err());
    }
}
