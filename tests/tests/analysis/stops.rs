//! Equilibria on stops, and small motions about them.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_analysis::{Error, OperatingPoint, Ports, Search, Strategy, equilibrium, linearize};
use mbs_live::{Live, Text};
use mbs_runtime::mechanism;

/// A car on two springs of 20 kN/m, 2 m apart, between end stops 0.2 m below; a load is over the front one.
const CAR: &str = "Car {
    dof = 2;
    param load = 3000 [N];
    gravity = (0, -9.81) [m/s^2];
    body car (y, phi) { mass = 500 [kg]; inertia = 600 [kg*m^2]; }
    point front on car = (1, 0) [m];
    point rear on car = (-1, 0) [m];
    force f on car.front = (0 [N], -20000 [N/m]*car.front.y - load);
    force r on car.rear = (0 [N], -20000 [N/m]*car.rear.y);
    stop low_front: car.front.y >= -0.2 [m] { restitution = 0; }
    stop low_rear: car.rear.y >= -0.2 [m] { restitution = 0; }
    output front [m] = car.front.y;
}";

fn car(load: f64) -> Live {
    let live = Text::declaration("car.mbs", CAR).compile().unwrap_or_else(|error| panic!("{error}"));
    live.with_parameters(|values| values[0] = load).unwrap()
}

/// The front stop is pressed, or none, or both: forces and moments about the centre balance.
#[test]
fn stops_that_push_and_no_others_are_rested_on() {
    let weight = 500.0 * 9.81;
    for (load, expected) in [(0.0, &[][..]), (3000.0, &[1452.5]), (40_000.0, &[38_452.5, 0.0])] {
        let rest = equilibrium(&car(load), &Search::default()).unwrap();
        let forces: Vec<f64> = rest.rests.iter().map(|(_, force)| *force).collect();
        match expected {
            // half of the weight bends each spring, and half of the load the front one and the car
            [] => assert!((rest.q[0] + weight / 40_000.0).abs() < 1e-12 && rest.rests.is_empty()),
            [front, ..] => {
                // the rear spring carries half of the weight; the front one 4 kN at its stop
                assert!((forces[0] - (load + 0.5 * weight - 4000.0)).abs() < 1e-8, "{forces:?}");
                assert!((forces[0] - front).abs() < 1e-8 && rest.rests[0].0 == 0, "{forces:?}");
                assert!((rest.q[0] + rest.q[1].sin() + 0.2).abs() < 1e-14, "{:?}", rest.q);
            }
        }
    }
}

/// About the pressed stop the car turns: J + m c² moves, with c its half length, and the rear spring holds.
#[test]
fn small_motions_are_those_that_stops_leave() {
    let live = car(3000.0);
    let rest = equilibrium(&live, &Search::default()).unwrap();
    assert!(rest.is_stable() && rest.stiffness.len() == 1);
    let point = OperatingPoint::from(&rest);
    let modes = linearize(&live, &point, &Ports::default()).unwrap().modes().unwrap();
    assert_eq!(modes.len(), 1);
    // φ about the front: y = −0.2 − sin φ, rear = −0.2 − 2 sin φ; kinetic energy ½ (J + m cos²φ) φ̇², and the potential
    // energy m g y + ½ k rear², whose second derivative is that over φ at rest
    let (m, g, k, inertia, phi) = (500.0, 9.81, 20_000.0, 600.0, rest.q[1]);
    let (s, c) = phi.sin_cos();
    let rear = -0.2 - 2.0 * s;
    let second = m * g * s + k * (4.0 * c * c + 2.0 * rear * s);
    let omega = (second / (inertia + m * c * c)).sqrt();
    assert!(
        (modes[0].natural_frequency() - omega).abs() < 1e-9 * omega,
        "{} {omega}",
        modes[0].natural_frequency()
    );
    assert!((rest.stiffness[0] - omega * omega).abs() < 1e-9 * omega * omega);
}

mechanism! {
    /// A ball on a step, or beside it.
    Ball {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body ball (x, y) { mass = 2 [kg]; }
        force pull on x = -5 [N/m]*x;
        stop floor: y >= 0 [m] { restitution = 0.5; }
        stop wall: x >= 0.3 [m] { restitution = 0.5; }
        stop far: y <= 4 [m] { restitution = 0; }
        start { x = 1 [m]; y = 3 [m]; }
    }
}

/// Without stops it falls for ever. Types have no derivatives by the chain rule.
#[test]
fn what_falls_is_found_where_it_lies() {
    for strategy in [Strategy::Automatic, Strategy::Newton, Strategy::Relaxation] {
        let rest = equilibrium(&Ball::declared(), &Search { strategy, ..Search::default() }).unwrap();
        assert_eq!(rest.rests.iter().map(|(stop, _)| *stop).collect::<Vec<_>>(), [0, 1], "{strategy:?}");
        assert!((rest.rests[0].1 - 19.62).abs() < 1e-12 && (rest.rests[1].1 - 1.5).abs() < 1e-12);
        assert_eq!(rest.q, [0.3, 0.0]);
        // the memories of what is rested on
        assert_eq!(rest.inputs, [1.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    }
}

/// Regression: a block on two stops was found where it balances on one of its corners, since sets of one stop come before those
/// of two. It stood flat at the start.
#[test]
fn a_block_stands_flat_and_not_on_its_corner() {
    let text = "Block {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        body block (x, y, a) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        point l on block = (-0.1, -0.05) [m]; point r on block = (0.1, -0.05) [m];
        stop left: block.l.y >= 0 [m] { restitution = 0; }
        stop right: block.r.y >= 0 [m] { restitution = 0; }
        start { y = 0.05 [m]; }
    }";
    let live = Text::declaration("block.mbs", text).compile().unwrap_or_else(|error| panic!("{error}"));
    for from in [vec![0.0, 0.05, 0.0], vec![0.3, 0.5, 0.2]] {
        let rest = equilibrium(&live, &Search { from: Some(from.clone()), ..Search::default() }).unwrap();
        let forces: Vec<f64> = rest.rests.iter().map(|(_, force)| *force).collect();
        assert!(forces.len() == 2 && forces.iter().all(|force| (force - 4.905).abs() < 1e-9), "{forces:?}");
        // nothing moves it along the floor
        assert!((rest.q[0] - from[0]).abs() < 1e-9 && rest.q[2].abs() < 1e-12, "{:?}", rest.q);
    }
}

/// The forces on three feet are not unique, and the motions that they leave are: all feet stay where they are as long as the
/// centre of mass lies within them, however near to the end. On the outer foot, the others touch without force.
#[test]
fn a_block_on_three_feet_moves_as_on_two() {
    let block = |first: f64| {
        let text = format!(
            "Block {{
                dof = 3;
                gravity = (0, -9.81) [m/s^2];
                body block (x, y, a) {{ mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }}
                point p on block = ({first:?}, -0.05) [m]; point r on block = (0.1, -0.05) [m];
                point s on block = (0.2, -0.05) [m];
                stop left: block.p.y >= 0 [m] {{ restitution = 0; }}
                stop middle: block.r.y >= 0 [m] {{ restitution = 0; }}
                stop right: block.s.y >= 0 [m] {{ restitution = 0; }}
                force back on x = -25 [N/m]*x;
                start {{ y = 0.05 [m]; }}
            }}"
        );
        let live = Text::declaration("block.mbs", text).compile().unwrap_or_else(|error| panic!("{error}"));
        let at = OperatingPoint::at_rest(0.0, &[0.0, 0.05, 0.0], &[0.0; 6]);
        linearize(&live, &at, &Ports::default()).and_then(|system| system.modes())
    };
    for first in [-0.1, -0.001] {
        let modes = block(first).unwrap();
        assert!(modes.len() == 1 && (modes[0].natural_frequency() - 5.0).abs() < 1e-9, "{}", modes.len());
    }
    let error = block(0.0).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("touches a stop without force"), "{error}");
}

/// About a rest on a stop the motion by parameters is not known, and no impact is to blame.
#[test]
fn a_rest_on_a_stop_has_no_linear_system_by_parameters() {
    let text = "Heavy {
        dof = 1;
        param m = 2 [kg] where m > 0;
        gravity = (0, -9.81) [m/s^2];
        body block (y) { mass = m; }
        stop floor: y >= 0 [m] { restitution = 0; }
        start { y = 1 [m]; }
    }";
    let live = Text::declaration("heavy.mbs", text).compile().unwrap();
    let rest = OperatingPoint::from(&equilibrium(&live, &Search::default()).unwrap());
    let ports = Ports { parameters: vec!["m".into()], ..Ports::default() };
    let error = linearize(&live, &rest, &ports).map(|_| ()).unwrap_err();
    assert!(matches!(error, Error::ByParameters { holds: "floor" }), "{error}");
}

/// A force that drives away from a stop leaves no rest, on the stop neither. A position that touches a stop without force has
/// two sides, and no linear system.
#[test]
fn what_cannot_be_told_is_refused() {
    let text = "Hover {
        dof = 1;
        input push [N];
        body block (x) { mass = 1 [kg]; }
        force all on x = push + 3 [N];
        stop end: x >= 0 [m] { restitution = 0; }
        start { x = 1 [m]; }
    }";
    let live = Text::declaration("hover.mbs", text).compile().unwrap();
    let error = equilibrium(&live, &Search::default()).unwrap_err();
    assert!(matches!(error, Error::NoEquilibrium { coordinate: "x", .. }), "{error}");
    // Regression: at the stop it was told to be behind it, by 0
    let from_stop = Search { from: Some(vec![0.0]), ..Search::default() };
    let error = equilibrium(&live, &from_stop).unwrap_err();
    assert!(matches!(error, Error::Pulls { stop: "end" }), "{error}");
    let loose = Search { inputs: Some(vec![-3.0, 0.0, 0.0]), from: Some(vec![0.0]), ..Search::default() };
    let rest = equilibrium(&live, &loose).unwrap();
    let error = linearize(&live, &OperatingPoint::from(&rest), &Ports::default()).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("touches a stop without force"), "{error}");
}
