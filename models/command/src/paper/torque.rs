//! The drive torque in closed form, as a yardstick for the simulated one.
//!
//! At constant crank speed the slider-crank has the single unknown τ. With
//! θ = ωt and ′ = d/dθ every velocity is ω times a function of θ, so the
//! kinetic energy is T = ½ I(θ) ω² with
//!
//! ```text
//! I = m1 l1²/4 + J1 + m2 (x2′² + y2′²) + J2 θ2′² + m3 x3′²
//! ```
//!
//! and the power balance τω = Ṫ + V̇ gives, after division by ω,
//!
//! ```text
//! τ(θ) = ½ I′(θ) ω² + V′(θ)
//! ```
//!
//! (the same as Lagrange's equation of the one remaining coordinate with
//! θ̈ = 0). The crank's own inertia is constant and drops out. The guide
//! l1 sin θ + l2 sin θ2 = 0 gives, differentiated once and twice,
//!
//! ```text
//! θ2′ = −l1 cos θ / (l2 cos θ2)
//! θ2″ = (l1 sin θ + l2 sin θ2 θ2′²) / (l2 cos θ2)
//! ```
//!
//! and makes y2 = l1 sin θ + ½ l2 sin θ2 = ½ l1 sin θ. The rest is
//! differentiation of x2 = l1 cos θ + ½ l2 cos θ2 and x3 = l1 cos θ + l2 cos θ2.
//! Gravity acts along −y on both rods: V = ½ g l1 (m1 + m2) sin θ.

use super::crank::Parameters;

/// Standard gravity as the paper has it, in m/s².
const GRAVITY: f64 = 9.81;

/// τ(θ) in N·m at the crank angle `theta` in rad.
pub fn closed_form(p: &Parameters, theta: f64) -> f64 {
    let (s1, c1) = theta.sin_cos();
    let s2 = -p.l1 / p.l2 * s1;
    let c2 = (1.0 - s2 * s2).sqrt();
    // First and second derivatives with respect to θ.
    let d_theta2 = -p.l1 * c1 / (p.l2 * c2);
    let dd_theta2 = (p.l1 * s1 + p.l2 * s2 * d_theta2 * d_theta2) / (p.l2 * c2);
    let bend = c2 * d_theta2 * d_theta2 + s2 * dd_theta2;
    let (d_x2, dd_x2) = (-p.l1 * s1 - 0.5 * p.l2 * s2 * d_theta2, -p.l1 * c1 - 0.5 * p.l2 * bend);
    let (d_y2, dd_y2) = (0.5 * p.l1 * c1, -0.5 * p.l1 * s1);
    let (d_x3, dd_x3) = (-p.l1 * s1 - p.l2 * s2 * d_theta2, -p.l1 * c1 - p.l2 * bend);
    let j2 = p.inertia_factor * p.m2 * p.l2 * p.l2;

    let half_d_inertia =
        p.m2 * (d_x2 * dd_x2 + d_y2 * dd_y2) + j2 * d_theta2 * dd_theta2 + p.m3 * d_x3 * dd_x3;
    half_d_inertia * p.omega * p.omega + 0.5 * GRAVITY * p.l1 * (p.m1 + p.m2) * c1
}

/// The largest τ over a turn: the best of a fine grid, refined by golden
/// section search between its neighbours.
pub fn peak(p: &Parameters) -> f64 {
    const GRID: u32 = 3600;
    let spacing = std::f64::consts::TAU / f64::from(GRID);
    let torque = |theta: f64| closed_form(p, theta);
    let best = (0..GRID)
        .map(|k| f64::from(k) * spacing)
        .fold(0.0, |best, theta| if torque(theta) > torque(best) { theta } else { best });

    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (best - spacing, best + spacing);
    // 0.618^60 of a tenth of a degree is far below rounding.
    for _ in 0..60 {
        let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if torque(a) > torque(b) { high = b } else { low = a }
    }
    torque(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

    use super::*;
    use crate::paper::crank::Crank;

    #[test]
    fn work_over_a_turn_is_zero() {
        // Gravity and inertia forces are conservative: ∮ τ dθ = 0.
        let p = Crank::new().unwrap().parameters();
        let work: f64 = (0..360).map(|k| closed_form(&p, f64::from(k).to_radians())).sum();
        assert!(work.abs() < 1e-10, "{work}");
    }

    #[test]
    fn torque_is_the_slope_of_the_energy() {
        // I(θ) by the definition, differenced centrally.
        let p = Crank::new().unwrap().parameters();
        let energy = |theta: f64| {
            let h = 1e-5;
            let places = |theta: f64| {
                let theta2 = (-p.l1 / p.l2 * f64::sin(theta)).asin();
                let x2 = p.l1 * theta.cos() + 0.5 * p.l2 * theta2.cos();
                let y2 = p.l1 * theta.sin() + 0.5 * p.l2 * theta2.sin();
                [x2, y2, theta2, p.l1 * theta.cos() + p.l2 * theta2.cos()]
            };
            let (a, b) = (places(theta - h), places(theta + h));
            let weights = [p.m2, p.m2, p.inertia_factor * p.m2 * p.l2 * p.l2, p.m3];
            let speed = |i: usize| p.omega * (b[i] - a[i]) / (2.0 * h);
            let kinetic: f64 = (0..4).map(|i| 0.5 * weights[i] * speed(i) * speed(i)).sum();
            kinetic + GRAVITY * (0.5 * p.m1 * p.l1 * theta.sin() + p.m2 * places(theta)[1])
        };
        for theta in [0.1, 1.3, 2.9, 4.4, 6.0] {
            let slope = (energy(theta + 1e-4) - energy(theta - 1e-4)) / 2e-4;
            assert!((slope - closed_form(&p, theta)).abs() < 1e-4, "at {theta}");
        }
    }
}
