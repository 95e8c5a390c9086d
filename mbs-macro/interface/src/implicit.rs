//! Diagonally implicit one-step schemes as data.

use crate::schemes::row;
use crate::{Estimate, Row};

/// A diagonally implicit Runge–Kutta scheme whose first stage is explicit (ESDIRK), for stiff forces.
///
/// The first stage stands at the start of the step. With the slopes k of the stages before it, every other
/// stage is the solution of
///
/// ```text
/// x = x₀ + (share · h) (w₁ k₁ + w₂ k₂ + …) + γ h k(x)
/// ```
///
/// with the same γ in all of them. The last stage is the end of the step (the scheme is stiffly accurate), so
/// that its slope is the first one of the next step. All schemes here are L-stable: what is too fast for the
/// step is damped, and the slow motion is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Implicit {
    /// The word that asks for it on the command line.
    pub word: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// The error of a step is O(h^(order + 1)).
    pub order: u32,
    /// γ: the share of a step that a stage has of its own slope.
    pub own: f64,
    /// Shares of the slopes before, of the second stage and of those behind it.
    pub stages: &'static [Row],
    /// So many steps of Newton's method solve for a stage, from the slope of the stage before.
    pub iterations: u32,
    /// The estimate of the error of a step. Behind the weights of the stages stands that of the last
    /// corrections of Newton's method, added up: γ.
    pub estimate: Estimate,
    /// Where it was published.
    pub source: &'static str,
}

/// Calls a macro with a line per implicit scheme: the documentation and the name of its type, and its table.
#[macro_export]
macro_rules! implicit_schemes {
    ($call:ident) => {
        $call! {
            /// TR-BDF2: second order, two implicit stages. For coarse tolerances.
            TrBdf2 = $crate::implicit::TRBDF2;
            /// The implicit part of ARK4(3)6L\[2\]SA of Kennedy and Carpenter: fourth order, five implicit stages.
            Esdirk4 = $crate::implicit::ESDIRK4;
        }
    };
}

macro_rules! list {
    ($($(#[$doc:meta])* $name:ident = $scheme:path;)*) => {
        /// All of them.
        pub const IMPLICIT: [&Implicit; [$(stringify!($name)),*].len()] = [$(&$scheme),*];
    };
}

implicit_schemes!(list);

/// 1 − 1/√2
const OWN_OF_TRBDF2: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;

/// Half a step of the trapezoidal rule, and a backward difference over both halves.
pub const TRBDF2: Implicit = Implicit {
    word: "trbdf2",
    title: "TR-BDF2",
    order: 2,
    own: OWN_OF_TRBDF2,
    stages: &[row(OWN_OF_TRBDF2, &[1.0]), row(0.5 * core::f64::consts::FRAC_1_SQRT_2, &[1.0, 1.0])],
    iterations: 2,
    // from the scheme of third order with the weights (1 − w)/3, (1 + 3w)/3, γ/3, where w = √2/4
    estimate: Estimate {
        differences: &[row(
            1.0 / 3.0,
            &[2.0 * core::f64::consts::FRAC_1_SQRT_2 - 1.0, -1.0, 2.0 * OWN_OF_TRBDF2, 3.0 * OWN_OF_TRBDF2],
        )],
        power: 3,
    },
    source: "M. E. Hosea, L. F. Shampine, Appl. Numer. Math. 20 (1996) 21-37",
};

/// Six stages of second order that make a scheme of fourth order.
pub const ESDIRK4: Implicit = Implicit {
    word: "esdirk4",
    title: "the implicit part of ARK4(3)6L[2]SA",
    order: 4,
    own: 0.25,
    stages: &[
        row(1.0, &[0.25]),
        row(1.0, &[8611.0 / 62500.0, -1743.0 / 31250.0]),
        row(1.0, &[5012029.0 / 34652500.0, -654441.0 / 2922500.0, 174375.0 / 388108.0]),
        row(
            1.0,
            &[
                15267082809.0 / 155376265600.0,
                -71443401.0 / 120774400.0,
                730878875.0 / 902184768.0,
                2285395.0 / 8070912.0,
            ],
        ),
        row(1.0, &[82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0]),
    ],
    iterations: 3,
    // from the scheme of third order with the weights b̂
    estimate: Estimate {
        differences: &[row(
            1.0,
            &[
                82889.0 / 524892.0 - 4586570599.0 / 29645900160.0,
                0.0,
                15625.0 / 83664.0 - 178811875.0 / 945068544.0,
                69875.0 / 102672.0 - 814220225.0 / 1159782912.0,
                -2260.0 / 8211.0 + 3700637.0 / 11593932.0,
                0.25 - 61727.0 / 225920.0,
                0.25,
            ],
        )],
        power: 4,
    },
    source: "C. A. Kennedy, M. H. Carpenter, Appl. Numer. Math. 44 (2003) 139-181",
};

impl Implicit {
    /// The number of stages of a step.
    #[inline(always)]
    pub const fn stage_count(&self) -> usize {
        self.stages.len() + 1
    }

    /// The time of the stage that a row leads to, in steps.
    pub const fn node(&self, stage: &Row) -> f64 {
        const ROUNDING: f64 = 1e-13;
        let node = stage.node() + self.own;
        let is_end = 1.0 - ROUNDING < node && node < 1.0 + ROUNDING;
        if is_end { 1.0 } else { node }
    }

    /// The scheme with this word.
    pub fn find(word: &str) -> Option<&'static Self> {
        IMPLICIT.into_iter().find(|scheme| scheme.word == word)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec;
    use std::vec::Vec;

    use super::*;
    use crate::trees::order;

    /// The rows with γ on the diagonal, and once more the last one, which leads to the end.
    fn rows(scheme: &Implicit) -> Vec<Row> {
        let whole = |(at, stage): (usize, &Row)| {
            let mut weights: Vec<f64> = stage.weights.iter().map(|weight| stage.share * weight).collect();
            weights.resize(at + 1, 0.0);
            weights.push(scheme.own);
            row(1.0, weights.leak())
        };
        let mut rows: Vec<Row> = scheme.stages.iter().enumerate().map(whole).collect();
        rows.extend(rows.last().copied());
        rows
    }

    /// R(z) of ẋ = λx with z = hλ, a complex number, and the estimate of the error of that step.
    fn responses(scheme: &Implicit, z: [f64; 2]) -> [[f64; 2]; 2] {
        let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
        let sum = |row: &Row, values: &[[f64; 2]]| {
            let terms = row.weights.iter().zip(values);
            terms.fold([0.0; 2], |[x, y], (w, [a, b])| [x + row.share * w * a, y + row.share * w * b])
        };
        let [x, y] = [1.0 - scheme.own * z[0], -scheme.own * z[1]];
        let inverse = [x / (x * x + y * y), -y / (x * x + y * y)];
        let mut values = vec![[1.0, 0.0]];
        for stage in scheme.stages {
            let [a, b] = times(z, sum(stage, &values));
            values.push(times(inverse, [1.0 + a, b]));
        }
        [values[scheme.stages.len()], times(z, sum(&scheme.estimate.differences[0], &values))]
    }

    /// The conditions of order of Butcher for every rooted tree, as for explicit schemes; coefficients that
    /// were published as fractions add up to some roundings.
    #[test]
    fn every_scheme_and_its_estimate_have_their_orders() {
        for scheme in IMPLICIT {
            let rows = rows(scheme);
            let end = rows[rows.len() - 1];
            assert_eq!(order(&rows, &end, 64.0, |tree| 1.0 / tree.density), scheme.order, "{}", scheme.word);
            let Estimate { differences: [difference], power } = scheme.estimate else { unreachable!() };
            let (weights, of_newton) = difference.weights.split_at(scheme.stage_count());
            let found = order(&rows, &Row { weights: weights.to_vec().leak(), ..*difference }, 64.0, |_| 0.0);
            assert_eq!(found + 1, power, "{}", scheme.word);
            assert!((difference.share * of_newton[0] - scheme.own).abs() < 1e-16, "{}", scheme.word);
        }
    }

    /// Σ aᵢⱼ cⱼ = cᵢ²/2: every stage is of second order itself, without which stiff forces lower the order of
    /// a step.
    #[test]
    fn stages_are_of_second_order() {
        for scheme in IMPLICIT {
            let rows = rows(scheme);
            let nodes: Vec<f64> = [0.0].into_iter().chain(rows.iter().map(Row::node)).collect();
            for (at, (row, stage)) in rows.iter().zip(scheme.stages).enumerate() {
                let sum: f64 = row.weights.iter().zip(&nodes).map(|(w, c)| w * c).sum();
                assert!((sum - 0.5 * nodes[at + 1] * nodes[at + 1]).abs() < 1e-15, "{} {at}", scheme.word);
                assert!((scheme.node(stage) - nodes[at + 1]).abs() < 1e-15);
            }
            assert_eq!(scheme.node(&scheme.stages[scheme.stages.len() - 1]), 1.0);
        }
    }

    /// Vibrations do not grow at any step, and what is infinitely fast is gone after one.
    #[test]
    fn steps_are_l_stable() {
        for scheme in IMPLICIT {
            for power in -60..60 {
                let y = 1.3_f64.powi(power);
                let [[a, b], _] = responses(scheme, [0.0, y]);
                assert!(a.hypot(b) <= 1.0 + 1e-14, "{} {y}", scheme.word);
            }
            let [[a, b], _] = responses(scheme, [-1e12, 0.0]);
            assert!(a.hypot(b) < 1e-10, "{}: {a}", scheme.word);
            assert_eq!(Implicit::find(scheme.word), Some(scheme));
        }
    }
}
