//! The reference result of every mechanism in the library: a closed form, a
//! published number or an exact geometric property, as its file states it.
//!
//! Driven mechanisms are compared without integration. Newton's iteration ends
//! within 4ε (1 + ‖q‖) of Φ = 0; the condition of the linkages here is below a
//! few hundred along their motion, so 1e-12 of their size is safe. The
//! slider-cranks are compared in `paper.rs` and in the crate `tests`.
//!
//! Motions are integrated by fused steps. The crate `long` holds references on every path that a step can take, in lanes and in
//! single precision too.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

mod cams;
mod chains;
mod curves;
mod excavator;
mod four_bars;
mod friction;
mod laws;
mod legs;
mod particles;
mod sampled;
mod sliders;
mod squeezer;
mod states;
mod stops;
mod swings;
mod transmissions;
mod wheels;

use mbs_runtime::{
    Adaptive, AdaptiveBuilder, Components, Dop853, Kinematics, Mechanism, Motion, State, Tolerances,
};

/// Of the size of a linkage; see above.
const EXACT: f64 = 1e-12;

#[track_caller]
fn near(what: &str, ours: f64, reference: f64, tolerance: f64) {
    // written so that a NaN fails
    let is_near = (ours - reference).abs() <= tolerance;
    assert!(is_near, "{what}: {ours} against {reference}, off by {:e}", ours - reference);
}

/// A driven mechanism at an instant.
struct Instant<M: Mechanism> {
    t: f64,
    motion: Motion<M::Coordinates>,
    outputs: M::Outputs,
}

/// Looks at a driven mechanism at `count` instants from 0 to `end`.
fn along<M: Mechanism<Real = f64>>(
    mechanism: M,
    inputs: M::Inputs,
    end: f64,
    count: u32,
    mut look: impl FnMut(Instant<M>),
) {
    let mut kinematics = Kinematics::new(mechanism).unwrap();
    for k in 0..=count {
        let t = end * f64::from(k) / f64::from(count);
        let motion = kinematics.at(t).unwrap();
        let none = M::Constraints::splat(0.0);
        let reactions = mechanism.reactions(&motion.state, &inputs, &none);
        let outputs = mechanism.outputs(&motion.state, &inputs, &reactions);
        look(Instant { t, motion, outputs });
    }
}

/// A run to a share of the motion in a step, to be started.
fn to_tolerance<M: Mechanism<Real = f64>>(mechanism: M, rtol: f64) -> AdaptiveBuilder<M, Dop853> {
    let tolerances = Tolerances { rtol, atol: 1e-2 * rtol, ..Tolerances::default() };
    Adaptive::builder(mechanism).scheme::<Dop853>().tolerances(tolerances)
}

/// Accelerations, with the rates of own states, and outputs.
fn found<M: Mechanism<Real = f64>>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
) -> (M::Coordinates, M::Outputs) {
    let reactions = mechanism.reactions(at, inputs, &M::Constraints::splat(0.0));
    (reactions.acceleration, mechanism.outputs(at, inputs, &reactions))
}

/// The intersection of two circles that lies to the left (1) or right (−1) of
/// the way from the first centre to the second.
fn intersection(first: [f64; 2], r1: f64, second: [f64; 2], r2: f64, side: f64) -> [f64; 2] {
    let (dx, dy) = (second[0] - first[0], second[1] - first[1]);
    let d = dx.hypot(dy);
    let along = (d * d + r1 * r1 - r2 * r2) / (2.0 * d);
    let across = side * (r1 * r1 - along * along).sqrt();
    [first[0] + (along * dx - across * dy) / d, first[1] + (along * dy + across * dx) / d]
}
