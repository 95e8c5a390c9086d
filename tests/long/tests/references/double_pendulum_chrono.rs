//! Double pendulum of two rigid bodies.
//!
//! Project Chrono, unit_tests/physics/utest_CH_double_pend.cpp: two bodies of
//! 1 kg, 1 m and 1 kg m² about their centres, g = 10, stretched along +x,
//! released at rest; Chrono asks for 1e-3 over 1 s at h = 2e-4. Reference:
//! Lagrange's equations in 80-bit arithmetic.
//!
//! h = 1e-5 s, deadbeat feedback, held. Limit: Heun's truncation.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Instant, Single, through_every_path};

mechanism! {
    DoublePendulum {
        dof = 2;
        const length = 1 [m];
        gravity = (0, -10) [m/s^2];
        body upper (x1, y1, phi1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body lower (x2, y2, phi2) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point top on upper = (-length/2, 0);
        point bottom on upper = (length/2, 0);
        point top on lower = (-length/2, 0);
        revolute hook (upper.top, ground);
        revolute elbow (lower.top, upper.bottom);
        start { phi1 = 0; phi2 = 0; der(phi1) = 0; der(phi2) = 0; }
    }
}

/// t, then the angles, and the lower body's place and velocity.
const SAMPLES: [(f64, [f64; 6]); 3] = [
    (
        0.5,
        [
            -0.7691815668316885,
            -0.21317990803386502,
            1.2071617131268626,
            -0.8013318881493122,
            -2.1299957063856074,
            -2.6060060941569314,
        ],
    ),
    (
        1.0,
        [
            -2.2272028399655324,
            -1.489687701107504,
            -0.5697642104689806,
            -1.2905466025895125,
            -3.5119840579115,
            1.0298541161706833,
        ],
    ),
    (
        2.0,
        [
            -1.8797000877253494,
            -4.912935116148111,
            -0.20441219281083098,
            -0.4626884491555565,
            2.9044751955499017,
            -0.7945176501941792,
        ],
    ),
];

#[test]
fn double_pendulum_chrono() -> Result<(), Error> {
    let start = |h| Simulation::new(DoublePendulum::declared(), h);
    through_every_path("double_pendulum_chrono", 1e-5, Single::Longer(200.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let Instant { q, v, .. } = run.now()?;
            case.all_near(
                ["phi1", "phi2", "x2", "y2", "vx2", "vy2"],
                t,
                [q.phi1, q.phi2, q.x2, q.y2, v.x2, v.y2],
                reference,
                [1e-8; 6],
            );
        }
        Ok(())
    })
}
