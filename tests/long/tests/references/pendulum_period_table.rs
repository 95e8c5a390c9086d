//! Large-amplitude periods of pendulums.
//!
//! Classical: T = 4 K(sin(θ₀/2))/ω₀ for a point mass on 1 m (ω₀² = g/l) and a
//! uniform rod of 0.8 m (ω₀² = 3g/2L), g = 9.81, released from rest at θ₀ from
//! the downward vertical; and the time of one revolution of the point mass with
//! 8 rad/s at the bottom. The references are elliptic integrals with 30 digits.
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's phase error.

use mbs_runtime::{Error, Mechanism, Simulation, State, mechanism, start};
use paths::{Single, through_every_path};

mechanism! {
    /// The angle is counted from the downward vertical.
    Point {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y, theta) { mass = 1 [kg]; inertia = 0; }
        point hook on bob = (0, 1) [m];
        revolute pin (bob.hook, ground);
        start { theta = 0; der(theta) = 0; }
    }
}

mechanism! {
    Rod {
        dof = 1;
        param length = 0.8 [m];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg]*length^2/12; }
        point hook on rod = (0, length/2);
        revolute pin (rod.hook, ground);
        start { theta = 0; der(theta) = 0; }
    }
}

/// Release angle in degrees, period of the point mass, period of the rod.
const PERIODS: [(f64, f64, f64); 7] = [
    (10.0, 2.009892627298601, 1.4678180401796896),
    (30.0, 2.0409898895191305, 1.4905282695061395),
    (60.0, 2.152874666880516, 1.5722373580425049),
    (90.0, 2.3678419475762373, 1.7292272630592938),
    (120.0, 2.7540898288878255, 2.011302832903207),
    (150.0, 3.5350981863815236, 2.58167069290235),
    (170.0, 4.893524274105486, 3.573724840835558),
];
const REVOLUTION: f64 = 0.9820032573112512;

const STEP: f64 = 1e-4;

const SINGLE: Single = Single::Longer(10.0);

/// From here on the rounding of single precision decides how long the pendulum
/// lingers near the top.
const HIGH: f64 = 150.0;

/// The time between the first and the third passage through the lowest point.
fn period<M: Mechanism<Real = f64>>(
    name: &str,
    mechanism: M,
    single: Single,
    start: State<M::Coordinates>,
    theta: impl Fn(&M::Coordinates) -> f64,
    reference: f64,
) -> Result<(), Error> {
    let start = start::consistent(&mechanism, &start)?;
    let start = |h| Simulation::builder(mechanism, h).from_state(start).build();
    through_every_path(name, STEP, single, start, |case, swing| {
        let mut passage = || swing.advance_to_zero(|at| theta(&at.q)).map(|at| at.t);
        let first = passage()?;
        passage()?;
        case.near("period", passage()? - first, reference, 3e-7);
        Ok(())
    })
}

#[test]
fn periods() -> Result<(), Error> {
    for (degrees, point, rod) in PERIODS {
        let single = if degrees < HIGH { SINGLE } else { Single::LeftOut };
        let mut start = Point::<f64>::declared().declared_start();
        start.q.theta = degrees.to_radians();
        let name = format!("pendulum_period_table, point, {degrees} degrees");
        period(&name, Point::declared(), single, start, |q| q.theta, point)?;

        let mut start = Rod::<f64>::declared().declared_start();
        start.q.theta = degrees.to_radians();
        let name = format!("pendulum_period_table, rod, {degrees} degrees");
        period(&name, Rod::declared(), single, start, |q| q.theta, rod)?;
    }
    Ok(())
}

#[test]
fn revolution() -> Result<(), Error> {
    let mut start = Point::<f64>::declared().declared_start();
    start.v.theta = 8.0;
    let start = start::consistent(&Point::declared(), &start)?;
    let start = |h| Simulation::builder(Point::declared(), h).from_state(start).build();
    through_every_path("pendulum_period_table, revolution", STEP, SINGLE, start, |case, turning| {
        let turned = turning.advance_to_zero(|at| at.q.theta - std::f64::consts::TAU)?;
        case.near("revolution", turned.t, REVOLUTION, 3e-7);
        Ok(())
    })
}
