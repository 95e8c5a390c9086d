//! A mechanism as a system of first order: its Jacobian against differences, the decay of violations,
//! and what is refused.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_analysis::nalgebra::{DMatrix, DVector};
use mbs_analysis::{Error, FirstOrder};
use mbs_live::{Run, Text};
use mbs_runtime::equations::{Differentiated, Equations};
use mbs_runtime::{Simulation, mechanism};

mechanism! {
    /// A crank at a speed of its own with a swinging rod, all of whose coordinates are integrated or,
    /// as a text, those that are left.
    pub Swing {
        dof = 1;
        input push [N*m];
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, a) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body rod (x2, y2, b) { mass = 2 [kg]; inertia = 0.06 [kg*m^2]; }
        point pin on crank = (0.1, 0) [m];
        point end on rod = (-0.3, 0) [m];
        revolute bearing (crank, ground);
        revolute joint (crank.pin, rod.end);
        drive motor: a = 7 [rad/s]*t + 0.5 [rad/s^2]*t^2;
        torque damper on rod = push - 0.4 [N*m*s]*der(b);
        start { b = -0.8; guess x2 = 0.3 [m]; guess y2 = -0.2 [m]; }
    }
}

/// f by differences over `h`, which is off by h² times a third derivative and by roundings over h.
fn by_differences(system: &FirstOrder, t: f64, y: &[f64], h: f64) -> DMatrix<f64> {
    let n = y.len();
    let mut columns = Vec::new();
    for at in 0..n {
        let slope = |step: f64| {
            let mut there = y.to_vec();
            there[at] += step;
            let mut slope = vec![0.0; n];
            system.derivative(t, &there, &mut slope);
            DVector::from_vec(slope)
        };
        columns.push((slope(h) - slope(-h)) / (2.0 * h));
    }
    DMatrix::from_columns(&columns)
}

/// Of a type with all coordinates and of a text with reduced states: the entries are up to 10⁴, and the
/// third derivatives of sines with these speeds not above 10⁶, so that differences over 10⁻⁵ are off by
/// 10⁻⁴ at most.
#[test]
fn jacobians_are_those_of_differences() {
    let mut of_type = FirstOrder::new(Differentiated(Swing::declared())).expect("derivatives");
    of_type.inputs_mut()[0] = 0.7;
    let start = of_type.state(&Simulation::new(Swing::declared(), 1e-3).expect("a start"));
    let text = include_str!("first_order.rs").replacen("dof = 1;", "dof = 1; states = reduced;", 1);
    let live = Text::rust(file!(), text).named("Swing").compile().expect("a declaration");
    let of_text = FirstOrder::new(live.clone()).expect("derivatives");
    let reduced = of_text.state(&Run::builder(&live, 1e-3).build().expect("a start"));
    assert!(of_type.dimension() == 12 && of_text.dimension() < 12);
    for (system, y) in [(&of_type, &start), (&of_text, &reduced)] {
        let mut exact = DMatrix::zeros(y.len(), y.len());
        system.jacobian(0.2, y, &mut exact);
        let differences = by_differences(system, 0.2, y, 1e-5);
        assert!((&exact - differences).amax() < 1e-4, "{exact}");
        assert!(exact.amax() > 1.0);
        // positions and velocities of all coordinates meet the constraints where they are completed
        let [q, _] = system.completed(0.0, y);
        assert_eq!(q.len(), 6);
    }
    let mut phi = vec![1.0; live.declared_info().constraints.len()];
    let [q, _] = of_text.completed(0.0, &reduced);
    live.phi(0.0, &q, &mut phi);
    assert!(phi.iter().all(|x| x.abs() < 1e-15), "{phi:?}");
}

/// Φ̈ = −2αΦ̇ − α²Φ: of a bob off its rod by 1 mm along it, the radial acceleration is α² times that,
/// beside gravity, whose share is what the same bob has on the circle.
#[test]
fn violations_are_fed_back() {
    let text = "Pendulum {
        dof = 1;
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x = 1 [m];
        start { x = 1 [m]; }
    }";
    let live = Text::declaration("pendulum.mbs", text).compile().expect("a declaration");
    let system = FirstOrder::new(live).expect("derivatives");
    let mut slope = [0.0; 4];
    system.derivative(0.0, &[1.001, 0.0, 0.02, 3.0], &mut slope);
    let gain = FirstOrder::FEEDBACK;
    assert_eq!(slope[..2], [0.02, 3.0]);
    assert!((slope[2] + gain * gain * 1e-3 + 2.0 * gain * 0.02).abs() < 1e-10 && slope[3] == 0.0);
}

/// A type without equations over duals is refused with what to do.
#[test]
fn types_without_derivatives_are_refused() {
    assert!(!Swing::declared().is_differentiable());
    let refused = FirstOrder::new(Swing::declared()).expect_err("a refusal");
    assert!(matches!(&refused, Error::NoDerivatives { mechanism } if mechanism == "Swing"));
    assert!(refused.to_string().contains("`Differentiated(…)`"), "{refused}");
}
