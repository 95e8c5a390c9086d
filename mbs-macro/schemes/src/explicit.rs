//! What follows from a tableau for the feedback of the constraint violation.

use crate::roots::{quadratic_factor, sqrt};
use crate::{HEUN, MOST_STAGES, Tableau};

/// A scheme with Baumgarte's feedback −2αΦ̇ − β²Φ of the constraint violation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explicit {
    /// The scheme.
    pub tableau: &'static Tableau,
    /// Whether all stages of a step are given the feedback of the first one. Else each stage
    /// has its own.
    pub is_held: bool,
}

/// Heun's method, the feedback held over each step.
impl Default for Explicit {
    fn default() -> Self {
        Self { tableau: &HEUN, is_held: true }
    }
}

/// The matrix with which a step of length 1 multiplies (e, ė) of ë + aė + be = 0, and a bound
/// of the terms that its entries are summed from.
struct Map {
    entries: [[f64; 2]; 2],
    size: f64,
}

impl Explicit {
    /// How the feedback is called: `held` or `per-stage`.
    pub const fn feedback_name(&self) -> &'static str {
        if self.is_held { "held" } else { "per-stage" }
    }

    /// The gains α and β, in 1/s, that bring the violation of the linear model
    /// ë + 2αė + β²e = 0 to zero within two steps of `h` seconds.
    ///
    /// Each stage with its own feedback: R(z) vanishes at both roots of z² + 2αh z + (βh)²,
    /// where R is the stability function of the scheme; of several such quadratic factors of
    /// R it is the most damped one. Heun's method has αh = 1, βh = √2.
    ///
    /// Held: the step is that of a constant force, so its map is nilpotent for
    /// (βh)² = 1/w and 2αh = (2 − m/w)/w with w = Σ bᵢ and m = Σ bᵢ cᵢ. Every scheme of
    /// second order or higher has αh = 3/4, βh = 1.
    pub const fn deadbeat(&self, h: f64) -> [f64; 2] {
        let [a, b] = if self.is_held {
            let [m, w] = self.moments();
            [(2.0 - m / w) / w, 1.0 / w]
        } else {
            quadratic_factor(&self.stability_function())
        };
        [0.5 * a / h, sqrt(b) / h]
    }

    /// Whether violations do not grow with steps of `h` seconds under the gains α and β: both
    /// eigenvalues of the step map of ë + 2αė + β²e = 0 lie in the closed unit disc.
    ///
    /// With trace τ and determinant δ of the map that is |τ| ≤ 1 + δ and δ ≤ 1 (Jury's
    /// criterion), to rounding, so that the exact limit counts as stable. It is a statement on
    /// the linear model: a mechanism whose constraints curve strongly within a step may need
    /// smaller gains.
    pub const fn is_stable(&self, [alpha, beta]: [f64; 2], h: f64) -> bool {
        let (a, b) = (2.0 * alpha * h, beta * h * (beta * h));
        let Map { entries: [[p, q], [r, s]], size } =
            if self.is_held { self.held(a, b) } else { self.per_stage(a, b) };
        let (trace, determinant) = (p + s, p * s - q * r);
        // a handful of roundings of products of two such entries
        let slack = 8.0 * f64::EPSILON * size * size;
        trace.abs() <= 1.0 + determinant + slack && determinant <= 1.0 + slack
    }

    /// The map with the force −aė − be of the start.
    const fn held(&self, a: f64, b: f64) -> Map {
        let [m, w] = self.moments();
        Map { entries: [[1.0 - m * b, w - m * a], [-w * b, 1.0 - w * a]], size: 1.0 + a + b }
    }

    /// R(L) with L = [[0, 1], [−b, −a]], by Horner's scheme.
    const fn per_stage(&self, a: f64, b: f64) -> Map {
        let coefficients = self.stability_function();
        let (mut entries, mut size) = ([[0.0; 2]; 2], 0.0);
        let mut at = coefficients.len();
        while at > 0 {
            at -= 1;
            let [[p, q], [r, s]] = entries;
            let c = coefficients[at];
            entries = [[r + c, s], [-b * p - a * r, -b * q - a * s + c]];
            size = (1.0 + a + b) * size + c;
        }
        Map { entries, size }
    }

    /// m = Σ bᵢ cᵢ and w = Σ bᵢ, with which a constant force acts on e and on ė.
    const fn moments(&self) -> [f64; 2] {
        let Tableau { update, stages, .. } = self.tableau;
        let (mut sum, mut at) = (0.0, 1);
        while at < update.weights.len() {
            sum += update.weights[at] * stages[at - 1].node();
            at += 1;
        }
        [update.share * sum, update.node()]
    }

    /// R(z) = 1 + z Σ bᵢ pᵢ(z), where pᵢ = 1 + z Σ aᵢⱼ pⱼ(z) is the value in stage i; its
    /// coefficients, the constant one first.
    const fn stability_function(&self) -> [f64; MOST_STAGES + 1] {
        let mut values = [[0.0; MOST_STAGES + 1]; MOST_STAGES + 1];
        values[0][0] = 1.0;
        let mut stage = 1;
        while stage <= self.tableau.stage_count() {
            let row = if stage == self.tableau.stage_count() {
                &self.tableau.update
            } else {
                &self.tableau.stages[stage - 1]
            };
            values[stage][0] = 1.0;
            let mut power = 1;
            while power <= MOST_STAGES {
                let (mut sum, mut of) = (0.0, 0);
                while of < row.weights.len() {
                    sum += row.weights[of] * values[of][power - 1];
                    of += 1;
                }
                values[stage][power] = row.share * sum;
                power += 1;
            }
            stage += 1;
        }
        values[self.tableau.stage_count()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RK4, SCHEMES};

    const fn method(tableau: &'static Tableau, is_held: bool) -> Explicit {
        Explicit { tableau, is_held }
    }

    /// Of a scheme with as many stages as its order it is the series of the exponential.
    #[test]
    fn stability_functions_are_those_of_the_literature() {
        let of = |tableau| method(tableau, false).stability_function();
        assert_eq!(of(&HEUN), [1.0, 1.0, 0.5, 0.0, 0.0]);
        let expected = [1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0];
        // a sum of four terms below 1
        assert!(of(&RK4).iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-15));
    }

    /// The well-known end of the interval on the negative real axis: with β = 0 the rate 2α.
    #[test]
    fn real_stability_intervals_end_where_the_literature_has_them() {
        for (tableau, end) in [(&HEUN, 2.0), (&RK4, 2.785_293_563_405_282)] {
            let is_stable = |rate: f64| method(tableau, false).is_stable([0.5 * rate, 0.0], 1.0);
            assert!(is_stable(end * (1.0 - 1e-12)) && !is_stable(end * (1.0 + 1e-12)), "{}", tableau.word);
        }
    }

    #[test]
    fn deadbeat_gains_of_heun_are_closed_forms() {
        assert_eq!(method(&HEUN, true).deadbeat(0.5), [1.5, 2.0]);
        assert_eq!(method(&HEUN, false).deadbeat(1.0), [1.0, core::f64::consts::SQRT_2]);
    }

    /// The square of the step map vanishes to rounding of entries of order 1 (and a factor that
    /// Newton's iteration leaves to a few roundings).
    #[test]
    fn deadbeat_gains_remove_a_violation_within_two_steps() {
        for (tableau, is_held) in SCHEMES.into_iter().flat_map(|t| [(t, true), (t, false)]) {
            let scheme = method(tableau, is_held);
            let [alpha, beta] = scheme.deadbeat(1.0);
            let (a, b) = (2.0 * alpha, beta * beta);
            let map = if is_held { scheme.held(a, b) } else { scheme.per_stage(a, b) };
            let [[p, q], [r, s]] = map.entries;
            let square = [p * p + q * r, q * (p + s), r * (p + s), s * s + q * r];
            assert!(square.iter().all(|entry| entry.abs() < 1e-13), "{} {is_held}: {square:?}", tableau.word);
            assert!(scheme.is_stable([alpha, beta], 1.0));
        }
    }
}
