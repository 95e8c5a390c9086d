//! What follows from a tableau for the feedback of the constraint violation.

use crate::roots::sqrt;
use crate::{HEUN, Tableau};

/// What keeps the constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stabilization {
    /// Baumgarte's feedback −2αΦ̇ − β²Φ of the constraint violation, evaluated in the first
    /// stage of a step and held over it.
    #[default]
    Held,
    /// The same feedback, evaluated in every stage.
    PerStage,
    /// The state at the end of each step is projected onto the constraints. It needs no gains.
    Projection,
}

impl Stabilization {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Held, Self::PerStage, Self::Projection];

    /// The one with this word.
    pub fn find(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stabilization| stabilization.word() == word)
    }

    /// The word that asks for it on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Held => "held",
            Self::PerStage => "per-stage",
            Self::Projection => "projection",
        }
    }
}

/// A scheme with what keeps the constraints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explicit {
    /// The scheme.
    pub tableau: &'static Tableau,
    /// What keeps the constraints.
    pub stabilization: Stabilization,
}

/// Heun's method, the feedback held over each step.
impl Default for Explicit {
    fn default() -> Self {
        Self::held(&HEUN)
    }
}

/// The matrix with which a step of length 1 multiplies (e, ė) of ë + aė + be = 0, and a bound
/// of the terms that its entries are summed from.
struct Map {
    entries: [[f64; 2]; 2],
    size: f64,
}

impl Explicit {
    /// A scheme with feedback that is held over each step.
    pub const fn held(tableau: &'static Tableau) -> Self {
        Self { tableau, stabilization: Stabilization::Held }
    }

    /// A scheme with feedback in every stage.
    pub const fn per_stage(tableau: &'static Tableau) -> Self {
        Self { tableau, stabilization: Stabilization::PerStage }
    }

    /// A scheme with projection.
    pub const fn projected(tableau: &'static Tableau) -> Self {
        Self { tableau, stabilization: Stabilization::Projection }
    }

    /// Whether all stages of a step are given the feedback of the first one.
    pub const fn is_held(&self) -> bool {
        matches!(self.stabilization, Stabilization::Held)
    }

    /// Whether the state is projected onto the constraints.
    pub const fn is_projected(&self) -> bool {
        matches!(self.stabilization, Stabilization::Projection)
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
    ///
    /// With projection there is no feedback: both are 0.
    pub const fn deadbeat(&self, h: f64) -> [f64; 2] {
        let [a, b] = match self.stabilization {
            Stabilization::Held => {
                let [m, w] = self.tableau.response.moments;
                [(2.0 - m / w) / w, 1.0 / w]
            }
            Stabilization::PerStage => self.tableau.response.factor,
            Stabilization::Projection => return [0.0, 0.0],
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
    ///
    /// With projection violations do not grow, whatever the gains are.
    pub const fn is_stable(&self, [alpha, beta]: [f64; 2], h: f64) -> bool {
        let (a, b) = (2.0 * alpha * h, beta * h * (beta * h));
        let Map { entries: [[p, q], [r, s]], size } = match self.stabilization {
            Stabilization::Held => self.map_of_held(a, b),
            Stabilization::PerStage => self.map_per_stage(a, b),
            Stabilization::Projection => return true,
        };
        let (trace, determinant) = (p + s, p * s - q * r);
        // a handful of roundings of products of two such entries
        let slack = 8.0 * f64::EPSILON * size * size;
        trace.abs() <= 1.0 + determinant + slack && determinant <= 1.0 + slack
    }

    /// The map with the force −aė − be of the start.
    const fn map_of_held(&self, a: f64, b: f64) -> Map {
        let [m, w] = self.tableau.response.moments;
        Map { entries: [[1.0 - m * b, w - m * a], [-w * b, 1.0 - w * a]], size: 1.0 + a + b }
    }

    /// R(L) with L = [[0, 1], [−b, −a]], by Horner's scheme.
    const fn map_per_stage(&self, a: f64, b: f64) -> Map {
        let mut coefficients: &[f64] = &self.tableau.response.stability_function;
        let (mut entries, mut size) = ([[0.0; 2]; 2], 0.0);
        while let [before @ .., c] = coefficients {
            let [[p, q], [r, s]] = entries;
            entries = [[r + *c, s], [-b * p - a * r, -b * q - a * s + *c]];
            size = (1.0 + a + b) * size + *c;
            coefficients = before;
        }
        Map { entries, size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BS3, DOPRI5, RK4, SCHEMES};

    /// Of a scheme with as many stages as its order it is the series of the exponential.
    #[test]
    fn stability_functions_are_those_of_the_literature() {
        for scheme in SCHEMES {
            let found = scheme.response.stability_function;
            let mut expected = 1.0;
            for (power, &c) in found.iter().enumerate().take(scheme.order as usize + 1) {
                // sums of terms of up to 43 that come down to 1 at most
                assert!((c - expected).abs() < 1e-14, "{}: {power}", scheme.word);
                expected /= (power + 1) as f64;
            }
            let is_zero = |c: &f64| *c == 0.0;
            assert!(found[scheme.stage_count() + 1..].iter().all(is_zero), "{}", scheme.word);
        }
        // z⁶/600 beyond the exponential (Hairer, Wanner, Solving ODEs II, IV.2)
        let dopri5 = DOPRI5.response.stability_function;
        assert!((dopri5[6] - 1.0 / 600.0).abs() < 1e-16);
    }

    /// The well-known end of the interval on the negative real axis: with β = 0 the rate 2α.
    #[test]
    fn real_stability_intervals_end_where_the_literature_has_them() {
        for (tableau, end) in [(&HEUN, 2.0), (&BS3, 2.512_745_326_618_329), (&RK4, 2.785_293_563_405_282)] {
            let is_stable = |rate: f64| Explicit::per_stage(tableau).is_stable([0.5 * rate, 0.0], 1.0);
            assert!(is_stable(end * (1.0 - 1e-12)) && !is_stable(end * (1.0 + 1e-12)), "{}", tableau.word);
        }
    }

    #[test]
    fn deadbeat_gains_of_heun_are_closed_forms() {
        assert_eq!(Explicit::held(&HEUN).deadbeat(0.5), [1.5, 2.0]);
        assert_eq!(Explicit::per_stage(&HEUN).deadbeat(1.0), [1.0, core::f64::consts::SQRT_2]);
    }

    /// The square of the step map vanishes to rounding of entries of order 1 (and a factor that
    /// Newton's iteration leaves to a few roundings).
    #[test]
    fn deadbeat_gains_remove_a_violation_within_two_steps() {
        for scheme in SCHEMES.into_iter().flat_map(|t| [Explicit::held(t), Explicit::per_stage(t)]) {
            let [alpha, beta] = scheme.deadbeat(1.0);
            let (a, b) = (2.0 * alpha, beta * beta);
            let map = if scheme.is_held() { scheme.map_of_held(a, b) } else { scheme.map_per_stage(a, b) };
            let [[p, q], [r, s]] = map.entries;
            let square = [p * p + q * r, q * (p + s), r * (p + s), s * s + q * r];
            assert!(square.iter().all(|entry| entry.abs() < 1e-13), "{scheme:?}: {square:?}");
            assert!(scheme.is_stable([alpha, beta], 1.0));
        }
    }
}
