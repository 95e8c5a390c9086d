//! Mechanisms with dry friction.
//!
//! With s = sin α, c = μ cos α and w the transition speed, a block on an incline
//! has v̇ = −g(s + c tanh(v/w)). Coulomb's friction is that with w = 0.

use std::f64::consts::PI;

use mbs_runtime::{Error, Simulation};
use models::{BlockOnIncline, BlockOnInclineParameters};
use paths::{Instant, through_fused_path};

use super::EXACT;

const G: f64 = 9.81;
const STEP: f64 = 1e-5;

/// A block in motion, and s, c and w.
fn block(
    speed: f64,
    coefficient: f64,
) -> (impl Fn(f64) -> Result<Simulation<BlockOnIncline>, Error>, [f64; 3]) {
    let p = BlockOnInclineParameters { speed, coefficient, ..Default::default() };
    let start = move |step| Simulation::new(BlockOnIncline::new(p)?, step);
    (start, [p.slope.sin(), coefficient * p.slope.cos(), p.transition])
}

/// The error of Heun's method in the speed, once through the transition.
///
/// Its error per step is h³(F′²F/6 − F″F²/12) for v̇ = F; with z = g c h/w that is
/// below 0.6 w z³ for s < 2c, and the transition takes some 2/z steps.
fn heun([_, c, w]: [f64; 3]) -> f64 {
    2.0 * w * (G * c * STEP / w).powi(2)
}

/// From rest: g t = ∫ dv/(s − c tanh(v/w)) = (s v + c w ln(cosh(v/w) − c/s sinh(v/w)))/(s² − c²),
/// and so v = (s − c) g t + c w ln(2s/(s − c))/(s + c) beyond the transition.
#[test]
fn block_slides_down() -> Result<(), Error> {
    let (start, law) = block(0.0, 0.3);
    let [s, c, w] = law;
    let late = c * w * (2.0 * s / (s - c)).ln() / (s + c);
    assert!(late > 100.0 * heun(law), "the smooth law shows");
    let BlockOnInclineParameters { mass, slope, .. } = BlockOnInclineParameters::<f64>::default();
    through_fused_path("block, sliding", STEP, start, |case, run| {
        run.advance_to(1.0)?;
        let Instant { acceleration, outputs, .. } = run.now()?;
        let slowly = -G * (s - c) * slope.cos();
        case.near_within("acceleration", acceleration.x, slowly, 0.0, 10.0 * EXACT);
        case.near_within("normal", outputs.normal, mass * G * slope.cos(), 0.0, 1e2 * EXACT);
        case.near_within("friction", outputs.friction, mass * G * c, 0.0, 1e2 * EXACT);
        case.near("speed", -outputs.rate, (s - c) * G + late, heun(law));
        Ok(())
    })
}

/// Smooth friction brakes less at the end: Coulomb's distance v₀²/(2g(s + c)) is
/// passed by ∫ v c (1 − tanh(v/w))/((s + c tanh(v/w))(s + c)g) dv, at most
/// c w² π²/(24 s (s + c) g).
///
/// That is 3e-8 m here.
#[test]
fn block_climbs_as_far_as_it_can() -> Result<(), Error> {
    let speed = 2.0;
    let (start, law) = block(speed, 0.3);
    let [s, c, w] = law;
    let coulomb = speed * speed / (2.0 * G * (s + c));
    let further = c * w * w * PI * PI / (24.0 * s * (s + c) * G);
    // the error in speed while it is below 3 w, and half a step to the highest point
    let tolerance = heun(law) * 3.0 * w / (G * s) + G * (s + c) * STEP * STEP / 8.0;
    through_fused_path("block, climbing", STEP, start, |case, run| {
        let (mut highest, mut speed) = (0.0_f64, speed);
        while speed > 0.0 {
            run.advance(1)?;
            let Instant { outputs, .. } = run.now()?;
            (highest, speed) = (highest.max(outputs.distance), outputs.rate);
        }
        let passed = highest - coulomb;
        println!("passes Coulomb's distance by {passed:e} m of {further:e} m at most");
        case.near("further than smooth friction goes", passed, passed.clamp(0.0, further), tolerance);
        Ok(())
    })
}

/// Stuck, it creeps with tanh(v/w) = tan α/μ. The speed settles with the time
/// constant w/(g c (1 − tan²α/μ²)), 0.3 ms; what is left is what the feedback
/// takes out in a step of the rounding of the position.
#[test]
fn block_stays_but_for_its_creep() -> Result<(), Error> {
    let (start, [s, c, w]) = block(0.5, 0.8);
    let stopped = 0.5 * 0.5 / (2.0 * G * (s + c));
    through_fused_path("block, creeping", STEP, start, |case, run| {
        run.advance_to(0.2)?;
        let outputs = run.now()?.outputs;
        let rounding = 10.0 * f64::EPSILON * outputs.distance / STEP;
        case.near("creep", -outputs.rate, w * (s / c).atanh(), rounding);
        case.near("distance, within the creep of 0.2 s", outputs.distance, stopped, 0.2 * w);
        Ok(())
    })
}
