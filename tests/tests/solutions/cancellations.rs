//! Mechanisms in whose equations terms cancel that are written differently: the compiler
//! ran without end on them. They move as M q̈ + Φ_qᵀλ = Q, Φ_q q̈ = γ, solved densely.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Error, Simulation, mechanism};
use nalgebra::{DMatrix, DVector};

mechanism! {
    /// A crank of 90°, turned by a wheel through a link.
    BellCrank {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body wheel (angle = a) { inertia = 1 [kg*m^2]; }
        body left (x1, y1, p1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body link (xa, ya, qa) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point pin on wheel = (1 [m], 0);
        point pivot on left = (-2 [m], 0);
        point horn on left = (-2 [m], -2 [m]);
        point e on link = (2 [m], 0);
        revolute pl (left.pivot, ground);
        revolute j1 (wheel.pin, link);
        revolute j2 (link.e, left.horn);
        start { guess x1 = 1 [m]; guess y1 = 1 [m]; guess p1 = 1.57; der(a) = 0.5 [rad/s]; }
    }
}

mechanism! {
    /// A wheel that rolls along a plate, which tilts about a point that slides.
    TiltingPlate {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body a (x, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body b (x = s) { mass = 1 [kg]; }
        point p on a = (0.1 [m], -0.7 [m]);
        rolling j (b, a.p) along (1, 0) radius 0.25 [m];
        start { guess theta = 60 [deg]; guess s = -0.5 [m]; der(x) = 0.4 [m/s]; }
    }
}

/// Compares accelerations and multipliers with a dense LU on the way.
macro_rules! assert_moves_as_its_equations {
    ($Mechanism:ident) => {{
        let mut run = Simulation::new($Mechanism::declared(), 1e-3)?;
        for _ in 0..200 {
            let at = run.state();
            let mechanism = run.mechanism();
            let (mass, phi_q) = (mechanism.mass(&at.q), mechanism.phi_q(at.t, &at.q));
            let (n, m) = (mass.nrows(), phi_q.nrows());
            let mut matrix = DMatrix::zeros(n + m, n + m);
            matrix.view_mut((0, 0), (n, n)).copy_from(&mass);
            matrix.view_mut((n, 0), (m, n)).copy_from(&phi_q);
            matrix.view_mut((0, n), (n, m)).copy_from(&phi_q.transpose());
            let forces = mechanism.forces(&at, &Default::default()).into_array();
            let gamma = mechanism.gamma(&at).into_array();
            let right = DVector::from_iterator(n + m, forces.into_iter().chain(gamma));
            let dense = matrix.lu().solve(&right).expect("a regular position");
            let found = mechanism.accelerations(&at, &Default::default());
            let found = found.acceleration.into_array().into_iter().chain(found.multipliers.into_array());
            for (found, dense_value) in found.zip(&dense) {
                // backward-stable solutions of a system of condition below 1e3
                assert!(
                    (found - dense_value).abs() <= 1e-12 * dense.amax(),
                    "{found} {dense_value} at {}",
                    at.t
                );
            }
            run.step()?;
        }
        assert!(run.violation() < 1e-6, "{}", run.violation());
    }};
}

#[test]
fn a_bell_crank_moves_as_its_equations() -> Result<(), Error> {
    assert_moves_as_its_equations!(BellCrank);
    Ok(())
}

#[test]
fn a_wheel_on_a_tilting_plate_moves_as_its_equations() -> Result<(), Error> {
    assert_moves_as_its_equations!(TiltingPlate);
    Ok(())
}
