//! Heun's method is second order on the free slider-crank with both kinds of
//! feedback and without, its errors are those of an independent computation,
//! and it balances energy to second order.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Baumgarte, Held, Method, PerStage, Simulation};
use models::slider_crank_free::{SliderCrankFree, SliderCrankFreeInputs};

/// θ1 after 0.3 s with 0.5 N·m on the crank from 200 rpm, by DOP853 with a
/// tolerance of 1e-12.
const REFERENCE: f64 = 5.644159549774;
const END: f64 = 0.3;
const TORQUE: f64 = 0.5;

fn run<X: Method>(steps: u32, baumgarte: impl Fn(f64) -> Baumgarte<X>) -> Simulation<SliderCrankFree, X> {
    let h = END / f64::from(steps);
    let mut simulation = Simulation::builder(SliderCrankFree::declared(), h)
        .baumgarte(baumgarte(h))
        .inputs(SliderCrankFreeInputs { crank_torque: TORQUE })
        .build()
        .expect("a valid start");
    simulation.advance_to(END).expect("a regular motion");
    assert_eq!(simulation.steps(), u64::from(steps));
    simulation
}

fn error<X: Method>(steps: u32, baumgarte: impl Fn(f64) -> Baumgarte<X>) -> f64 {
    (run(steps, baumgarte).state().q.theta1 - REFERENCE).abs()
}

/// The gains for which the errors were computed independently.
fn both_stages(h: f64) -> Baumgarte<PerStage> {
    Baumgarte::new(1.0 / h, 1.0 / h).expect("valid gains")
}

fn held(h: f64) -> Baumgarte<Held> {
    Baumgarte::new(0.75 / h, 1.0 / h).expect("valid gains")
}

fn none(_: f64) -> Baumgarte<Held> {
    Baumgarte::NONE
}

/// log2 of the ratio of the errors at h and h/2. At 1/32 and 1/64 ms the h³
/// term is below 2 % of the error, and the reference (1e-12) and rounding
/// (about 2e4 steps of 1e-15) are below 1e-4 of it.
fn observed_order<X: Method>(baumgarte: impl Fn(f64) -> Baumgarte<X>) -> f64 {
    (error(9600, &baumgarte) / error(19200, &baumgarte)).log2()
}

#[test]
fn order_is_two() {
    for (what, order) in [
        ("both stages", observed_order(both_stages)),
        ("both stages, deadbeat", observed_order(Baumgarte::<PerStage>::deadbeat)),
        ("held, deadbeat", observed_order(held)),
        ("none", observed_order(none)),
    ] {
        println!("{what}: {order:.4}");
        assert!((order - 2.0).abs() < 0.05, "{what}: {order}");
    }
}

/// Computed with a dense solver in another language; three digits are known,
/// and the method is the same, so 2 % is generous to neither.
#[test]
fn errors_are_those_of_an_independent_computation() {
    let steps = [300, 600, 1200, 2400];
    for (what, expected, found) in [
        ("both stages", [2.93e-3, 7.09e-4, 1.73e-4, 4.26e-5], steps.map(|n| error(n, both_stages))),
        ("held", [1.66e-3, 3.39e-4, 7.48e-5, 1.74e-5], steps.map(|n| error(n, held))),
        ("none", [9.31e-4, 2.32e-4, 5.79e-5, 1.45e-5], steps.map(|n| error(n, none))),
    ] {
        println!("{what}: {found:?}");
        for (expected, found) in expected.into_iter().zip(found) {
            assert!((found / expected - 1.0).abs() < 0.02, "{what}: {found:e} for {expected:e}");
        }
    }
}

/// The energy gained is the work of the torque, τ (θ1(t) − θ1(0)), up to an
/// error that falls with h² (or faster).
#[test]
fn energy_gained_is_work_done() {
    fn imbalance<X: Method>(steps: u32, baumgarte: impl Fn(f64) -> Baumgarte<X>) -> f64 {
        let start = Simulation::new(SliderCrankFree::declared(), END).expect("a valid start");
        let end = run(steps, baumgarte);
        let work = TORQUE * (end.state().q.theta1 - start.state().q.theta1);
        (end.energy() - start.energy() - work).abs()
    }
    let work = TORQUE * REFERENCE;
    for (what, coarse, fine) in [
        ("both stages", imbalance(600, both_stages), imbalance(2400, both_stages)),
        ("held", imbalance(600, held), imbalance(2400, held)),
        ("none", imbalance(600, none), imbalance(2400, none)),
    ] {
        println!("{what}: {:.2e} and {:.2e} of the work", coarse / work, fine / work);
        // θ1 is off by 7e-4 of 5.6 at this step; energies share that
        assert!(coarse < 1e-3 * work, "{what}: {coarse:e}");
        // two halvings gain 16; 12 leaves room for the h³ term
        assert!(fine < coarse / 12.0, "{what}: {coarse:e} {fine:e}");
    }
}
