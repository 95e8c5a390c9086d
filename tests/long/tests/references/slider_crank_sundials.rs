//! Slider-crank with spring-damper and horizontal force.
//!
//! SUNDIALS examples/ida/serial/idaSlCrank_dns.c (LLNL/sundials): crank of
//! 0.5 m with 1 kg m² about its pivot, rod A-B-C with its centre B guided on the
//! x axis (1 kg, 2 kg m², |AB| = |BC| = 1 m), no gravity, spring-damper (1 N/m,
//! 1 N s/m, free length 1 m) between the middles of crank and AB, 1 N along x
//! at C. Reference: the one-freedom equation in 80-bit arithmetic; it has the
//! five digits that the example's output file prints (rtol = atol = 1e-6).
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's truncation.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Instant, Single, through_every_path};

mechanism! {
    SliderCrank {
        dof = 1;
        const crank_length = 0.5 [m];
        const half_rod = 1 [m];
        body crank (angle = q) { inertia = 1 [kg*m^2]; }
        body rod (x, angle = p) { mass = 1 [kg]; inertia = 2 [kg*m^2]; }
        point tip on crank = (crank_length, 0);
        point middle on crank = (crank_length/2, 0);
        point a on rod = (-half_rod, 0);
        point middle on rod = (-half_rod/2, 0);
        point c on rod = (half_rod, 0);
        revolute pin (crank.tip, rod.a);
        spring link (crank.middle, rod.middle) {
            stiffness = 1 [N/m]; damping = 1 [N*s/m]; length = 1 [m];
        }
        force pull on rod.c = (1, 0) [N];
        start { q = 90 [deg]; der(q) = 0; guess p = -30 [deg]; guess x = 0.9 [m]; }
    }
}

/// t, then crank angle, slider position, rod angle and crank rate.
const SAMPLES: [(f64, [f64; 4]); 6] = [
    (0.25, [1.5548000857457829, 0.8740601123405597, -0.5235249126333898, -0.12785241591331237]),
    (1.0, [1.3154205708816982, 1.0014918072308003, -0.5049734706420015, -0.5087929769098691]),
    (2.5, [0.07223610546591182, 1.4980447181497496, -0.03609448680772366, -1.0605265538684836]),
    (5.0, [-1.4299969676472273, 0.9390306135782662, 0.5178947564898863, 0.05499161053776448]),
    (7.5, [0.1804184666939867, 1.487851315824067, -0.08984144198250137, 0.9941507551197134]),
    (10.0, [1.2756758486502393, 1.0235785589798394, -0.49881304918249875, -0.23991499719600068]),
];

#[test]
fn slider_crank_sundials() -> Result<(), Error> {
    let start = |h| Simulation::new(SliderCrank::declared(), h);
    through_every_path("slider_crank_sundials", 1e-4, Single::Longer(50.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let Instant { q, v, .. } = run.now()?;
            case.all_near(["q", "x", "p", "q rate"], t, [q.q, q.x, q.p, v.q], reference, [2e-8; 4]);
        }
        Ok(())
    })
}
