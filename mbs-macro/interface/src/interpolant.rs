//! Interpolants for schemes that need more than both ends of a step to be accurate between them.

use crate::Row;
use crate::schemes::row;

/// A polynomial through the ends of a step that is as accurate as the step, by some slopes more.
///
/// With s the share of the step, c = 1 − s, and slopes k₁ of the start and k′ of the end, it is
///
/// ```text
/// y(s) = y₀ + s (Δ + c (β + s (δ + c (t₁ + s (t₂ + c (t₃ + s t₄))))))
/// Δ = y₁ − y₀,  β = h k₁ − Δ,  δ = Δ − h k′ − β,  tᵢ = h Σ w k
/// ```
///
/// It has the values and the slopes of both ends whatever the terms tᵢ are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpolant {
    /// Rows of the additional stages, whose slopes the interpolant takes beside those of the step. Weights in these
    /// rows and in the terms are in one order: all stages of the step, its end, the additional stages.
    pub stages: &'static [Row],
    /// The weights of the terms.
    pub terms: [Row; 4],
    /// Off by O(h^(order + 1)).
    pub order: u32,
}

/// That of order 7 for the scheme of order 8 of Dormand and Prince, with three slopes more.
///
/// # Source
/// Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.6 and II.10.
pub const OF_DOP853: Interpolant = Interpolant {
    stages: &[
        row(
            1.0,
            &[
                0.056167502283047954,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.25350021021662483,
                -0.2462390374708025,
                -0.12419142326381637,
                0.15329179827876568,
                0.00820105229563469,
                0.007567897660545699,
                -0.008298,
            ],
        ),
        row(
            1.0,
            &[
                0.03183464816350214,
                0.0,
                0.0,
                0.0,
                0.0,
                0.028300909672366776,
                0.053541988307438566,
                -0.05492374857139099,
                0.0,
                0.0,
                -0.00010834732869724932,
                0.0003825710908356584,
                -0.00034046500868740456,
                0.1413124436746325,
            ],
        ),
        row(
            1.0,
            &[
                -0.42889630158379194,
                0.0,
                0.0,
                0.0,
                0.0,
                -4.697621415361164,
                7.683421196062599,
                4.06898981839711,
                0.3567271874552811,
                0.0,
                0.0,
                0.0,
                -0.0013990241651590145,
                2.9475147891527724,
                -9.15095847217987,
            ],
        ),
    ],
    terms: [
        row(
            1.0,
            &[
                -8.428938276109013,
                0.0,
                0.0,
                0.0,
                0.0,
                0.5667149535193777,
                -3.0689499459498917,
                2.38466765651207,
                2.117034582445028,
                -0.871391583777973,
                2.2404374302607883,
                0.6315787787694688,
                -0.08899033645133331,
                18.148505520854727,
                -9.194632392478356,
                -4.436036387594894,
            ],
        ),
        row(
            1.0,
            &[
                10.427508642579134,
                0.0,
                0.0,
                0.0,
                0.0,
                242.28349177525817,
                165.20045171727028,
                -374.5467547226902,
                -22.113666853125306,
                7.733432668472264,
                -30.674084731089398,
                -9.332130526430229,
                15.697238121770845,
                -31.139403219565178,
                -9.35292435884448,
                35.81684148639408,
            ],
        ),
        row(
            1.0,
            &[
                19.985053242002433,
                0.0,
                0.0,
                0.0,
                0.0,
                -387.0373087493518,
                -189.17813819516758,
                527.8081592054236,
                -11.57390253995963,
                6.8812326946963,
                -1.0006050966910838,
                0.7777137798053443,
                -2.778205752353508,
                -60.19669523126412,
                84.32040550667716,
                11.99229113618279,
            ],
        ),
        row(
            1.0,
            &[
                -25.69393346270375,
                0.0,
                0.0,
                0.0,
                0.0,
                -154.18974869023643,
                -231.5293791760455,
                357.6391179106141,
                93.40532418362432,
                -37.45832313645163,
                104.0996495089623,
                29.8402934266605,
                -43.53345659001114,
                96.32455395918828,
                -39.17726167561544,
                -149.72683625798564,
            ],
        ),
    ],
    order: 7,
};

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;
    use crate::DOP853;
    use crate::trees::{order, rows, weight};

    /// The weights of all slopes at a share of the step, as one row of a step that is as long.
    fn weights_at(s: f64, interpolant: &Interpolant) -> Vec<f64> {
        let (c, end) = (1.0 - s, DOP853.stage_count());
        let of = |at: usize| {
            let update = weight(&DOP853.update, at);
            let [first, last] = [0, end].map(|of| f64::from(u8::from(at == of)));
            let beta = first - update;
            let [t1, t2, t3, t4] = interpolant.terms.map(|term| weight(&term, at));
            let terms = t1 + s * (t2 + c * (t3 + s * t4));
            s * (update + c * (beta + s * (update - last - beta + c * terms)))
        };
        (0..=end + interpolant.stages.len()).map(of).collect()
    }

    /// Conditions of order at a share s of the step: Σ bᵢ(s) Φᵢ(τ) = s^ρ(τ)/γ(τ) (Hairer, Nørsett, Wanner,
    /// Solving Ordinary Differential Equations I, Theorem II.6.1).
    #[test]
    fn an_interpolant_has_its_order_all_over_the_step() {
        let interpolant = DOP853.interpolant.unwrap();
        let rows: Vec<Row> = rows(&DOP853).into_iter().chain(interpolant.stages.iter().copied()).collect();
        // of terms of up to 500 the weights are sums
        let roundings = 1e4;
        for s in [0.1, 0.3, 0.5, 0.62, 0.9] {
            let weights = weights_at(s, &interpolant).leak();
            let found = order(&rows, &Row { share: 1.0, weights }, roundings, |tree| {
                (0..tree.order).map(|_| s).product::<f64>() / tree.density
            });
            assert_eq!(found, interpolant.order, "{s}");
        }
    }

    /// Where its own slopes stand in the step.
    #[test]
    fn stages_stand_within_the_step() {
        let nodes = OF_DOP853.stages.iter().map(Row::node);
        for (node, expected) in nodes.zip([0.1, 0.2, 7.0 / 9.0]) {
            assert!((node - expected).abs() < 1e-15, "{node} {expected}");
        }
    }
}
