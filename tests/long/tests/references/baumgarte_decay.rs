//! Exact decay of a constraint violation under Baumgarte stabilization.
//!
//! Baumgarte (1972): with Φ̈ + 2αΦ̇ + β²Φ = 0 enforced, the violation obeys that
//! linear equation exactly, whatever the motion does. A pendulum of 1 kg with
//! Φ = x² + y² − 1 starts at rest off it, at (1.001, 0): Φ(0) = 0.002001.
//!
//! h = 2e-5 s, feedback per stage (held feedback is of first order in h).
//! Limit: Heun's truncation, in that equation and along the circle.

use mbs_runtime::{Baumgarte, Error, PerStage, Simulation, mechanism};
use paths::{Case, Instant, Single, through_every_path};

mechanism! {
    Pendulum {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        start { x = 1.001 [m]; guess y = 0; }
    }
}

/// α, β, then Φ at 0.1 s and at 0.5 s.
const VIOLATIONS: [(f64, f64, [f64; 2]); 4] = [
    (5.0, 5.0, [0.001820501775127194, 0.0005748822878623883]),
    (10.0, 10.0, [0.0014722535235678895, 8.089579167100789e-05]),
    (5.0, 8.0, [0.0015527467198620526, -0.00016171134766948688]),
    (20.0, 10.0, [0.0016453491112272721, 0.0005646245191241967]),
];

#[test]
fn baumgarte_decay() -> Result<(), Error> {
    for (alpha, beta, reference) in VIOLATIONS {
        let start = |h| {
            let gains = Baumgarte::<PerStage>::new(alpha, beta)?;
            Simulation::builder(Pendulum::declared(), h).baumgarte(gains).as_declared().build()
        };
        let mut case = Case::new("baumgarte_decay, start");
        case.near("violation", start(2e-5)?.violation(), 0.0020009999999996975, 1e-15);
        case.finish();
        through_every_path("baumgarte_decay", 2e-5, Single::Longer(50.0), start, |case, run| {
            let phi = |at: Instant<Pendulum>| Pendulum::declared().phi(at.t, &at.q).rod;
            for (t, reference) in [0.1, 0.5].into_iter().zip(reference) {
                run.advance_to(t)?;
                let what = format_args!("alpha = {alpha}, beta = {beta}, t = {t}").to_string();
                case.near(what, phi(run.now()?), reference, 1e-8);
            }
            Ok(())
        })?;
    }
    Ok(())
}
