//! Cartesian pendulum with period exactly 2.
//!
//! SUNDIALS examples/cvode/serial/cvPendulum_dns.c: unit mass on a unit rod,
//! released at rest from (1, 0), g "chosen such that the pendulum has period
//! 2"; after 15 periods it is where it was. Its printed errors at t = 30 without
//! projection are 2.6e-4 in x and 3.5e-2 in y (rtol = atol = 1e-7), with
//! projection 3e-9 and 7.8e-5. The raw constraint of the example, x² + y² = 1.
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's phase error.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Instant, Single, through_every_path};

mechanism! {
    Pendulum {
        dof = 1;
        gravity = (0, -13.750371636040745) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        start { x = 1 [m]; der(y) = 0; }
    }
}

/// t, then x, y and their rates.
const SAMPLES: [(f64, [f64; 4]); 4] = [
    (0.25, [0.9101797211244547, -0.41421356237309503, -1.3980048816155906, -3.0719315079629914]),
    (0.5, [0.0, -1.0, -5.244115108584239, 0.0]),
    (1.0, [-1.0, 0.0, 0.0, 0.0]),
    (30.0, [1.0, 0.0, 0.0, 0.0]),
];

#[test]
fn period() -> Result<(), Error> {
    let start = |h| Simulation::new(Pendulum::declared(), h);
    through_every_path("pendulum_sundials_period2, period", 1e-4, Single::Longer(10.0), start, |case, run| {
        let first = run.advance_to_zero(|at| at.q.x)?.t;
        run.advance_to_zero(|at| at.q.x)?;
        let third = run.advance_to_zero(|at| at.q.x)?.t;
        case.near("period", third - first, 2.0, 3e-7);
        Ok(())
    })
}

#[test]
fn motion() -> Result<(), Error> {
    let start = |h| Simulation::new(Pendulum::declared(), h);
    through_every_path("pendulum_sundials_period2", 1e-4, Single::Longer(20.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let Instant { q, v, .. } = run.now()?;
            case.all_near(
                ["x", "y", "vx", "vy"],
                t,
                [q.x, q.y, v.x, v.y],
                reference,
                if t > 1.0 { [1e-8, 5e-5, 1e-8, 5e-5] } else { [5e-7, 5e-7, 2e-6, 2e-6] },
            );
        }
        Ok(())
    })
}
