//! The Kalman filter of `models/examples/observer`: from a wrong start it finds the crank, its deviations bound its
//! errors, and its Jacobians are those of differences.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

#[path = "../../../models/examples/observer/filter.rs"]
mod filter;
#[path = "../../../models/examples/observer/rig.rs"]
mod rig;

use models::SliderCrankFree;
use models::slider_crank_free::SliderCrankFreeCoordinates;

#[test]
fn errors_are_within_the_deviations_of_the_filter() {
    let mut rig = rig::Rig::new().unwrap();
    let (mut outside, mut ticks) = ([0; 2], 0);
    for tick in 0..3000 {
        rig.tick().unwrap();
        // two periods of the crank to find it
        if tick < 500 {
            continue;
        }
        let rig::Seen { truth, estimate, deviation, .. } = rig.seen();
        ticks += 1;
        for at in 0..2 {
            outside[at] += usize::from((truth[at] - estimate[at]).abs() > 3.0 * deviation[at]);
        }
        assert!((truth[0] - estimate[0]).abs() < 0.03 && (truth[1] - estimate[1]).abs() < 1.5);
    }
    // of a normal distribution 0.3 % are beyond three deviations
    assert!(outside.iter().all(|count| 100 * count < ticks), "{outside:?} of {ticks}");
    assert!((rig.seen().truth[1] - rig::TARGET).abs() < 4.0);
}

/// Without noise and from a correct start only the steps of plant and observer differ: the one feeds violations
/// back, the other assembles. Both are of second order, so that half the step leaves a quarter.
#[test]
fn what_is_known_stays_known_to_the_order_of_the_steps() {
    let apart = |step: f64| -> f64 {
        let mut plant = mbs_runtime::Simulation::new(SliderCrankFree::declared(), step).unwrap();
        let start = [plant.state().q.theta1, plant.state().v.theta1];
        let mut observer = filter::Observer::new(plant.mechanism(), step, start, [1e-12, 1e-12]).unwrap();
        observer.noise = [0.0, 0.0];
        while plant.time() < 0.25 {
            // so inexact that it corrects nothing
            let measured = filter::Measured { slider: plant.state().q.x3, variance: 1.0 };
            observer.tick(&measured, 0.0).unwrap();
            plant.step().unwrap();
        }
        (plant.state().q.theta1 - observer.estimate[0]).abs()
    };
    let [long, short] = [apart(1e-3), apart(0.5e-3)];
    assert!(long < 1e-3 && 3.0 < long / short && long / short < 5.0, "{long} {short}");
}
