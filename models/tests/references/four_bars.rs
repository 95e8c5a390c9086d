//! Four-bar linkages.

use std::f64::consts::{PI, TAU};

use mbs_runtime::{Error, Kinematics, NoComponents, Simulation};
use models::{FourBar, FourBarFree, FourBarParameters};
use paths::{Instant, through_fused_path};

use super::{EXACT, along, near};

/// The rocker's angle by Freudenstein's equation with u = tan(θ4/2):
/// (cos θ2 − K1 − K2 cos θ2 + K3) u² − 2 sin θ2 u + K1 − (K2 + 1) cos θ2 + K3 = 0.
fn freudenstein(p: &FourBarParameters<f64>, theta2: f64) -> f64 {
    let [a, b, c, d] = [p.crank_length, p.coupler_length, p.rocker_length, p.base];
    let (k1, k2, k3) = (d / a, d / c, (a * a - b * b + c * c + d * d) / (2.0 * a * c));
    let (sin, cos) = theta2.sin_cos();
    let (qa, qb, qc) = (cos - k1 - k2 * cos + k3, -2.0 * sin, k1 - (k2 + 1.0) * cos + k3);
    2.0 * ((-qb - (qb * qb - 4.0 * qa * qc).sqrt()) / (2.0 * qa)).atan()
}

#[test]
fn rocker_follows_freudenstein() {
    let p: FourBarParameters<f64> = FourBarParameters::default();
    along(FourBar::declared(), NoComponents::default(), TAU / p.omega, 200, |at| {
        let theta4 = freudenstein(&p, p.omega * at.t);
        near("rocker", at.outputs.rocker_angle, theta4, EXACT);
        // law of cosines in the triangle A, B, C
        let diagonal =
            p.base * p.base + p.crank_length.powi(2) - 2.0 * p.base * p.crank_length * (p.omega * at.t).cos();
        let cosine = (p.coupler_length.powi(2) + p.rocker_length.powi(2) - diagonal)
            / (2.0 * p.coupler_length * p.rocker_length);
        near("transmission angle", at.outputs.transmission_angle, cosine.acos(), EXACT);
    });
}

/// Known to all digits: arccos(4/7) with the crank towards the rocker's pivot,
/// 120° with it away from there.
#[test]
fn extreme_transmission_angles() {
    let p: FourBarParameters<f64> = FourBarParameters::default();
    let mut seen = Vec::new();
    along(FourBar::declared(), NoComponents::default(), PI / p.omega, 100, |at| {
        seen.push(at.outputs.transmission_angle);
    });
    near("smallest", seen[0], (4.0_f64 / 7.0).acos(), EXACT);
    near("largest", seen[100], 120_f64.to_radians(), EXACT);
}

/// The speed from the energy alone, with inertia and height from the kinematics
/// of the driven linkage. Heun's energy error in 1 s at 0.1 ms is about 1e-5 of
/// the kinetic energy (2.8e-4 in 10 s at 0.25 ms, falling with h³).
#[test]
fn free_crank_has_the_speed_of_its_energy() -> Result<(), Error> {
    let driven = FourBar::new(FourBarParameters { omega: 1.0, ..Default::default() }).unwrap();
    let inertia_and_height = |kinematics: &mut Kinematics<_>, theta: f64| {
        let state = kinematics.at(theta)?.state;
        Ok::<_, Error>((2.0 * driven.kinetic_energy(&state), driven.potential_energy(&state)))
    };
    let start = |step| Simulation::new(FourBarFree::declared(), step);
    through_fused_path("free four-bar", 1e-4, start, |case, run| {
        let mut kinematics = Kinematics::new(driven)?;
        let omega = run.now()?.v.theta2;
        let (inertia, height) = inertia_and_height(&mut kinematics, 0.0)?;
        let energy = 0.5 * inertia * omega * omega + height;
        let mut seen = Vec::new();
        for k in 1..=200 {
            run.advance_to(f64::from(k) * 5e-3)?;
            let Instant { q, v, .. } = run.now()?;
            let (inertia, height) = inertia_and_height(&mut kinematics, q.theta2)?;
            let speed_squared = 2.0 * (energy - height) / inertia;
            case.near("speed squared", v.theta2.powi(2), speed_squared, 2e-5 * 2.0 * energy / inertia);
            seen.push(v.theta2);
        }
        // it is a motion worth the name: the speed changes by more than half
        let fastest = seen.iter().copied().fold(0.0, f64::max);
        assert!(seen.iter().any(|v| v.abs() < fastest / 2.0), "{seen:?}");
        Ok(())
    })
}
