//! IFToMM / MbsBenchmark A01: planar simple pendulum over 2000 s.
//!
//! A01 specification (Gonzalez et al. 2005/2006, lim.ii.udc.es/mbsbenchmark)
//! and the IFToMM library's "Planar simple pendulum": 1 kg on a massless link
//! of 1 m, released at rest from the horizontal. Reference: Jacobi elliptic
//! functions with 40 digits.
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's phase error, which grows
//! with time, so the specification's 1e-3 m at 2000 s asks for this step.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Instant, Single, through_every_path};

mechanism! {
    Pendulum {
        dof = 1;
        param length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        distance link (bob, ground) = length;
        start { x = length; der(y) = 0; }
        output omega [rad/s] = (x*der(y) - y*der(x))/length^2;
        output tension [N] = lambda(link);
    }
}

/// t, then x, y, ω and the tension.
const SAMPLES: [(f64, [f64; 4]); 3] = [
    (1.0, [-0.9862917511318753, -0.16501085312554117, -1.7993090169070787, 4.856269407484676]),
    (5.0, [0.9423054350437573, -0.3347543384140006, -2.5627875681926295, 9.851820179524037]),
    (10.0, [0.2750874625761169, -0.961419205099125, -4.343160692864683, 28.29456720606725]),
];
/// The same at 2000 s.
const LATE: [f64; 4] = [-0.8146030685890322, -0.5800188278369355, 3.3734210235546755, 17.06995410324101];

#[test]
fn period() -> Result<(), Error> {
    let start = |h| Simulation::new(Pendulum::declared(), h);
    through_every_path("pendulum_iftomm_a01, period", 1e-4, Single::Longer(10.0), start, |case, run| {
        // 4 K(1/√2) √(l/g): three passages through the lowest point
        let first = run.advance_to_zero(|at| at.q.x)?.t;
        run.advance_to_zero(|at| at.q.x)?;
        let third = run.advance_to_zero(|at| at.q.x)?.t;
        case.near("period", third - first, 2.3678419475762373, 3e-7);
        Ok(())
    })
}

#[test]
fn motion() -> Result<(), Error> {
    let start = |h| Simulation::new(Pendulum::declared(), h);
    through_every_path("pendulum_iftomm_a01", 1e-4, Single::Longer(10.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            case.all_near(NAMES, t, state(&run.now()?), reference, [5e-6, 5e-6, 5e-6, 5e-5]);
        }
        Ok(())
    })
}

/// Twenty million steps: single precision does not keep the phase.
#[test]
fn after_2000_seconds() -> Result<(), Error> {
    let start = |h| Simulation::new(Pendulum::declared(), h);
    through_every_path("pendulum_iftomm_a01, 2000 s", 1e-4, Single::LeftOut, start, |case, run| {
        run.advance_to(2000.0)?;
        case.all_near(NAMES, 2000, state(&run.now()?), LATE, [5e-4, 5e-4, 1e-2, 1e-2]);
        Ok(())
    })
}

const NAMES: [&str; 4] = ["x", "y", "omega", "tension"];

fn state(at: &Instant<Pendulum>) -> [f64; 4] {
    [at.q.x, at.q.y, at.outputs.omega, at.outputs.tension]
}
