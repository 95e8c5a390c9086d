//! Slider-crank under constant torque.
//!
//! Exudyn (jgerstmayr/EXUDYN) TestModels/sliderCrankFloatingTest.py and
//! slidercrankRefSolM0.1_tol1e-6.txt: crank 0.1 m and rod 0.3 m, 0.2 kg each,
//! slender; slider 0.4 kg; no gravity; 0.1 N m on the crank from rest,
//! stretched along +x. Reference: the one-freedom equation in 80-bit
//! arithmetic; the published ode45 run (tolerance 1e-6) drifts off it by 2e-4
//! rad at 2 s and 4.5e-3 rad at 3 s.
//!
//! h = 1e-5 s (shortened to hit the published instants), deadbeat feedback,
//! held. Limit: Heun's truncation at 100 rad/s.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Instant, Single, through_every_path};

mechanism! {
    SliderCrank {
        dof = 1;
        param l1 = 0.1 [m];
        param l2 = 0.3 [m];
        param m = 0.2 [kg];
        body crank (x1, y1, phi) { mass = m; inertia = m*l1^2/12; }
        body rod (x2, y2, theta) { mass = m; inertia = m*l2^2/12; }
        body slider (x3, y3, alpha) { mass = 0.4 [kg]; inertia = 0.0004 [kg*m^2]; }
        point base on crank = (-l1/2, 0);
        point tip on crank = (l1/2, 0);
        point base on rod = (-l2/2, 0);
        point tip on rod = (l2/2, 0);
        revolute bearing (crank.base, ground);
        revolute pin (rod.base, crank.tip);
        revolute end (rod.tip, slider);
        prismatic guide (slider, ground) along (1, 0);
        torque motor on crank = 0.1 [N*m];
        start { phi = 0; der(phi) = 0; guess x3 = l1 + l2; }
    }
}

/// t, then crank angle, crank rate and slider position.
const SAMPLES: [(f64, [f64; 3]); 6] = [
    (0.25804983, [1.197697850616306, 5.79519028163274, 0.32163198117546016]),
    (0.3, [1.4527988230446318, 6.437745628299576, 0.2948599870005706]),
    (1.0, [14.127892217750665, 20.53748285141424, 0.2837716921122589]),
    (1.0015668, [14.160227603219822, 20.741937558662496, 0.28054624971316955]),
    (2.0008434, [55.10591639911452, 39.58705418801129, 0.29590035507164886]),
    (3.0, [121.88627750824783, 101.36564511497019, 0.2136060759145416]),
];

#[test]
fn slider_crank_matlab_exudyn() -> Result<(), Error> {
    for (t, reference) in SAMPLES {
        let start = |h: f64| Simulation::new(SliderCrank::declared(), t / (t / h).ceil());
        // later, what Heun's method gains in energy grows with the cube of the step
        let single = if t < 3.0 { Single::Longer(10.0) } else { Single::LeftOut };
        through_every_path("slider_crank_matlab_exudyn", 1e-5, single, start, |case, run| {
            run.advance_to(t)?;
            let Instant { q, v, .. } = run.now()?;
            case.all_near(["phi", "omega", "x"], t, [q.phi, v.phi, q.x3], reference, [1e-4, 1e-2, 1e-5]);
            Ok(())
        })?;
    }
    Ok(())
}
