//! The driven slider-crank as a person writes it: the angle θ of the rod is the only state.
//!
//! Φ = r sin ωt + l sin θ = 0, so that
//! l cos θ θ̈ = r ω² sin ωt + l θ̇² sin θ − 2αΦ̇ − β²Φ.

use mbs_runtime::Gains;
use mbs_runtime::Real;

/// Numbers that do not change in a run.
#[derive(Clone, Copy)]
pub struct Crank {
    pub r: f64,
    pub l: f64,
    pub omega: f64,
    pub h: f64,
    pub gains: Gains<f64>,
}

/// Angle and rate behind so many steps of Heun's method from t = 0, with the feedback of the first
/// stage in both. There is no watch for singular positions; a run ends where it is not finite.
pub fn run(crank: &Crank, [mut angle, mut rate]: [f64; 2], steps: u64) -> [f64; 2] {
    let Crank { r, l, omega, h, gains } = *crank;
    for step in 0..steps {
        let [t, t_next] = [step, step + 1].map(|step| step as f64 * h);
        let (sine, cosine) = Real::sin_cos(angle);
        let (crank_sine, crank_cosine) = Real::sin_cos(omega * t);
        let violation = r * crank_sine + l * sine;
        let its_rate = r * omega * crank_cosine + l * cosine * rate;
        let feedback = gains.minus_two_alpha * its_rate + gains.minus_beta_squared * violation;
        let first = (r * (omega * omega) * crank_sine + l * sine * (rate * rate) + feedback) / (l * cosine);

        let (there, its_rate) = (angle + h * rate, rate + h * first);
        let (sine, cosine) = Real::sin_cos(there);
        let crank_sine = Real::sin_cos(omega * t_next).0;
        let second =
            (r * (omega * omega) * crank_sine + l * sine * (its_rate * its_rate) + feedback) / (l * cosine);

        angle += 0.5 * h * (rate + its_rate);
        rate += 0.5 * h * (first + second);
        if !(angle + rate).is_finite() {
            break;
        }
    }
    [angle, rate]
}
