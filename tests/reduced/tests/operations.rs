//! Operations of a right-hand side with reduced states, and the coordinates that are integrated.
#![allow(clippy::expect_used, reason = "a test says by panicking what is wrong")]

use mbs_runtime::{Info, Mechanism};

/// Multiplications, additions and divisions, and pairs of sine and cosine.
fn count(info: &Info) -> [u32; 2] {
    let o = info.operations("stabilized").expect("a function");
    [o.mul + o.add + o.div + o.other, o.sin_cos]
}

fn integrated(info: &Info) -> Vec<&str> {
    info.states.iter().map(|&at| info.coordinates[at].name).collect()
}

#[test]
fn slider_cranks_are_left_with_their_angles() {
    let (driven, free) = (reduced::SliderCrank::<f64>::INFO, reduced::SliderCrankFree::<f64>::INFO);
    assert_eq!(integrated(driven), ["theta2"]);
    assert_eq!(integrated(free), ["theta1", "theta2"]);
    let [operations, sines] = count(driven);
    assert!(operations <= 30 && sines == 2, "{operations}, {sines}");
    let [operations, sines] = count(free);
    assert!(operations <= 100 && sines == 2, "{operations}, {sines}");
}

#[test]
fn chains_are_left_with_an_angle_per_link() {
    let info = reduced::NPendulum40::<f64>::INFO;
    assert_eq!(info.states.len(), 40);
    assert!(integrated(info).iter().all(|name| name.starts_with("theta")), "{:?}", integrated(info));
}

/// Whose constraints are no such rows.
#[test]
fn what_no_constraint_gives_is_integrated() {
    for info in [reduced::Pendulum::<f64>::INFO, reduced::SpringMassDamper::<f64>::INFO] {
        assert_eq!(info.states.len(), info.coordinates.len(), "{}", info.name);
    }
}
