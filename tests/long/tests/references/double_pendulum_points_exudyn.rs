//! Double pendulum of point masses with distance constraints.
//!
//! Exudyn test suite, TestModels/coordinateVectorConstraint.py: 2.5 kg on each
//! of two massless links of 0.8 m, stretched along +x, released at rest. Its
//! asserted x₁ + y₁ = −1.08252658 at t = 1 carries the error of h = 1e-3
//! (generalized α, 1e-5). Reference: Lagrange's equations in 80-bit arithmetic.
//!
//! h = 1e-5 s, deadbeat feedback, held. Limit: Heun's truncation.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Single, through_every_path};

mechanism! {
    DoublePendulum {
        dof = 2;
        const length = 0.8 [m];
        gravity = (0, -9.81) [m/s^2];
        body upper (x1, y1) { mass = 2.5 [kg]; }
        body lower (x2, y2) { mass = 2.5 [kg]; }
        distance link1 (upper, ground) = length;
        distance link2 (lower, upper) = length;
        start { x1 = length; x2 = 2*length; der(y1) = 0; der(y2) = 0; }
    }
}

/// t, then both places and both tensions.
const SAMPLES: [(f64, [f64; 6]); 2] = [
    (
        0.5,
        [
            0.3236939264854679,
            -0.7315888476162143,
            0.989982969921561,
            -1.1743742477786587,
            86.62811604878546,
            59.24893451211,
        ],
    ),
    (
        1.0,
        [
            -0.7056945693023682,
            -0.3768224712741334,
            -1.420682879756353,
            -0.7356980986356972,
            87.27901221769334,
            43.68741142076355,
        ],
    ),
];

#[test]
fn double_pendulum_points_exudyn() -> Result<(), Error> {
    let start = |h| Simulation::new(DoublePendulum::declared(), h);
    through_every_path("double_pendulum_points_exudyn", 1e-5, Single::Longer(100.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let (q, lambda) = (run.now()?.q, run.now()?.multipliers);
            case.all_near(
                ["x1", "y1", "x2", "y2", "tension 1", "tension 2"],
                t,
                [q.x1, q.y1, q.x2, q.y2, lambda.link1, lambda.link2],
                reference,
                [1e-8, 1e-8, 1e-8, 1e-8, 2e-6, 2e-6],
            );
        }
        let q = run.now()?.q;
        case.near("x1 + y1 at 1", q.x1 + q.y1, -1.0825170405765017, 1e-8);
        Ok(())
    })
}
