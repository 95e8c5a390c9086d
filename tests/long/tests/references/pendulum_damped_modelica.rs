//! Damped physical pendulum.
//!
//! Modelica Standard Library 4.0.0, Mechanics.MultiBody.Examples.Elementary.
//! Pendulum: 1 kg, centre of mass 0.5 m from the joint, 0.001 kg m² about it,
//! damper 0.1 N m s/rad, g = 9.80665, at rest along +x. Reference: the
//! one-freedom equation in 80-bit arithmetic, with which the published Dymola
//! run (MAP-LIB_ReferenceResults, tolerance 1e-6) agrees to 3e-6.
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's truncation.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Instant, Single, through_every_path};

mechanism! {
    Pendulum {
        dof = 1;
        gravity = (0, -9.80665) [m/s^2];
        body bob (x, y, phi) { mass = 1 [kg]; inertia = 0.001 [kg*m^2]; }
        point end on bob = (-0.5, 0) [m];
        revolute pin (bob.end, ground);
        torsion_spring damper (bob, ground) { damping = 0.1 [N*m*s]; }
        start { phi = 0; der(phi) = 0; }
    }
}

/// t, then φ and its rate.
const SAMPLES: [(f64, [f64; 2]); 6] = [
    (0.25, [-0.5836926031379756, -4.483905446818116]),
    (0.5, [-1.9469279930789167, -5.381722519863143]),
    (1.0, [-2.5807109685691056, 3.174142566050099]),
    (2.0, [-1.576185973677353, -4.292343069399408]),
    (3.0, [-0.853825981201225, 1.558757593118822]),
    (5.0, [-1.6796315650791949, -2.318170232991577]),
];

#[test]
fn pendulum_damped_modelica() -> Result<(), Error> {
    let start = |h| Simulation::new(Pendulum::declared(), h);
    through_every_path("pendulum_damped_modelica", 1e-4, Single::Longer(10.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let Instant { q, v, .. } = run.now()?;
            case.all_near(["phi", "omega"], t, [q.phi, v.phi], reference, [1e-6, 1e-5]);
        }
        Ok(())
    })
}
