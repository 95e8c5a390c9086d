//! Explicit methods: a scheme, the way in which constraints are kept, and the gains that follow.

use crate::roots::sqrt;
use crate::{HEUN, Tableau};

/// The way in which the constraints are kept.
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
    /// The way in which the constraints are kept.
    pub stabilization: Stabilization,
}

/// Heun's method, the feedback held over each step.
impl Default for Explicit {
    fn default() -> Self {
        Self::held(&HEUN)
    }
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

    /// True if all stages of a step are given the feedback of the first one.
    pub const fn is_held(&self) -> bool {
        matches!(self.stabilization, Stabilization::Held)
    }

    /// True if the state is projected onto the constraints.
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

    /// True if violations do not grow with steps of `h` seconds under the gains α and β: both
    /// eigenvalues of the step map of ë + 2αė + β²e = 0 lie in the closed unit disc.
    ///
    /// It counts as stable to rounding, so that the exact limit does. It is a statement on the linear
    /// model: a mechanism whose constraints curve strongly within a step may need smaller gains.
    ///
    /// With projection violations do not grow, whatever the gains are.
    pub const fn is_stable(&self, [alpha, beta]: [f64; 2], h: f64) -> bool {
        let (a, b) = (2.0 * alpha * h, beta * h * (beta * h));
        match self.stabilization {
            Stabilization::Held => self.is_stable_held(a, b),
            Stabilization::PerStage => self.is_stable_per_stage(a, b),
            Stabilization::Projection => true,
        }
    }

    /// Of the force −aė − be of the start the step map has the trace τ = 2 − mb − wa and the determinant
    /// δ = 1 − mb − wa + w²b. Jury's criterion, |τ| ≤ 1 + δ and δ ≤ 1, is then (w² − m)b ≤ wa and
    /// 2wa ≤ 4 + (w² − 2m)b, where large terms do not cancel.
    const fn is_stable_held(&self, a: f64, b: f64) -> bool {
        let [m, w] = self.tableau.response.moments;
        is_at_most((w * w - m) * b, w * a) && is_at_most(2.0 * w * a - (w * w - 2.0 * m) * b, 4.0)
    }

    /// The step map is R(L) with L = [[0, 1], [−b, −a]] and the stability function R. Its eigenvalues are the values of R
    /// at the roots of z² + az + b.
    const fn is_stable_per_stage(&self, a: f64, b: f64) -> bool {
        let (middle, discriminant) = (-0.5 * a, 0.25 * a * a - b);
        let square = discriminant.abs();
        // no stability function is bounded there, where roots are far from 0 or no numbers
        if square.is_nan() || square > 1e200 {
            return false;
        }
        // less does not change the rounded values of R
        let distance = if square > 1e-60 { sqrt(square) } else { 0.0 };
        if discriminant < 0.0 {
            return self.does_not_grow([middle, distance]);
        }
        self.does_not_grow([middle - distance, 0.0]) && self.does_not_grow([middle + distance, 0.0])
    }

    /// True if |R(x + iy)| ≤ 1, to rounding of the terms of R.
    const fn does_not_grow(&self, [x, y]: [f64; 2]) -> bool {
        let mut coefficients: &[f64] = &self.tableau.response.stability_function;
        let (mut real, mut imaginary, mut size) = (0.0, 0.0, 0.0);
        while let [before @ .., c] = coefficients {
            (real, imaginary) = (x * real - y * imaginary + *c, x * imaginary + y * real);
            size = (x.abs() + y.abs()) * size + c.abs();
            coefficients = before;
        }
        let most = (1.0 + ROUNDINGS * size) * (1.0 + ROUNDINGS * size);
        most.is_finite() && real * real + imaginary * imaginary <= most
    }
}

/// A handful of roundings.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

/// True if one number is at most as large as another, to their roundings; neither is infinite.
const fn is_at_most(one: f64, other: f64) -> bool {
    let size = one.abs() + other.abs();
    size.is_finite() && one - other <= ROUNDINGS * size
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
            let [[p, q], [r, s]] = map(scheme, [2.0 * alpha, beta * beta]);
            let square = [p * p + q * r, q * (p + s), r * (p + s), s * s + q * r];
            assert!(square.iter().all(|entry| entry.abs() < 1e-13), "{scheme:?}: {square:?}");
            assert!(scheme.is_stable([alpha, beta], 1.0));
        }
    }

    /// The matrix with which a step of length 1 multiplies (e, ė) of ë + aė + be = 0: with feedback in every stage
    /// R(L) with L = [[0, 1], [−b, −a]], by Horner's scheme.
    fn map(scheme: Explicit, [a, b]: [f64; 2]) -> [[f64; 2]; 2] {
        let response = &scheme.tableau.response;
        if scheme.is_held() {
            let [m, w] = response.moments;
            return [[1.0 - m * b, w - m * a], [-w * b, 1.0 - w * a]];
        }
        response
            .stability_function
            .iter()
            .rev()
            .fold([[0.0; 2]; 2], |[[p, q], [r, s]], c| [[r + c, s], [-b * p - a * r, -b * q - a * s + c]])
    }

    /// The criterion against the larger eigenvalue of the map itself, away from the limit.
    #[test]
    fn stable_gains_are_those_whose_map_does_not_grow() {
        let spectral_radius = |[[p, q], [r, s]]: [[f64; 2]; 2]| {
            let (middle, determinant) = (0.5 * (p + s), p * s - q * r);
            let discriminant = middle * middle - determinant;
            if discriminant < 0.0 { determinant.sqrt() } else { middle.abs() + discriminant.sqrt() }
        };
        let (mut stable, mut unstable) = (0, 0);
        for scheme in SCHEMES.into_iter().flat_map(|t| [Explicit::held(t), Explicit::per_stage(t)]) {
            for (i, k) in (0..40).flat_map(|i| (0..40).map(move |k| (i, k))) {
                let (alpha, beta) = (0.061 * f64::from(i), 0.083 * f64::from(k));
                let radius = spectral_radius(map(scheme, [2.0 * alpha, beta * beta]));
                // entries of 1e3 at most have rounded to 1e-12, whose root is that of a double eigenvalue
                if (radius - 1.0).abs() > 1e-5 {
                    let is_stable = scheme.is_stable([alpha, beta], 1.0);
                    assert_eq!(is_stable, radius < 1.0, "{scheme:?}, {alpha}, {beta}: {radius}");
                    *(if is_stable { &mut stable } else { &mut unstable }) += 1;
                }
            }
        }
        assert!(stable > 1000 && unstable > 1000, "{stable} and {unstable}");
    }

    /// The rounding that the criterion allowed for grew with the square of the entries of the map, and was larger than
    /// they are: α = β = 1e9 1/s was taken with steps of 2 ms.
    #[test]
    fn absurd_gains_are_not_stable() {
        for scheme in SCHEMES.into_iter().flat_map(|t| [Explicit::held(t), Explicit::per_stage(t)]) {
            for power in 2..300 {
                let gain = 10_f64.powi(power);
                for gains in [[gain, gain], [0.0, gain], [gain, 0.0], [gain, gain.sqrt()], [gain, f64::NAN]] {
                    assert!(!scheme.is_stable(gains, 2.0), "{scheme:?}, {gains:?}");
                }
            }
            assert!(!scheme.is_stable([f64::INFINITY; 2], 1.0));
            // without feedback a violation stays as it is
            assert!(scheme.is_stable([0.0; 2], 1.0));
        }
    }
}
