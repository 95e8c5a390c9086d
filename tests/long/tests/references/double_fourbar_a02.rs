//! IFToMM / MbsBenchmark A02: two four-bar windows, N = 2.
//!
//! A02 specification (lim.ii.udc.es/mbsbenchmark) and the IFToMM library's
//! "N-four-bar mechanism": five uniform links of 1 m and 1 kg, three uprights
//! and two bars, upright with B0 moving at 1 m/s. Where the uprights lie flat the
//! freedom jumps from 1 to 3. All uprights stay parallel, so the motion is that
//! of one physical pendulum: reference by Jacobi's amplitude; the converging
//! runs of Exudyn (TestModels/fourBarMechanismIftomm.py) agree to 7e-7.
//!
//! h = 1/11000 s, deadbeat feedback, held. Limit: Heun's truncation. No step of
//! this length ends nearer than 3e-5 rad to a flat position; with 1e-4 s one ends
//! 1e-6 rad from it, where ten bits of the pivots are left.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::through_double_paths;

mechanism! {
    DoubleFourBar {
        dof = 1;
        const m = 1 [kg];
        const l = 1 [m];
        const j = m*l^2/12;
        gravity = (0, -9.81) [m/s^2];
        body upright0 (x0, y0, phi0) { mass = m; inertia = j; }
        body upright1 (x1, y1, phi1) { mass = m; inertia = j; }
        body upright2 (x2, y2, phi2) { mass = m; inertia = j; }
        body bar1 (x3, y3, phi3) { mass = m; inertia = j; }
        body bar2 (x4, y4, phi4) { mass = m; inertia = j; }
        point foot on upright0 = (-l/2, 0);
        point head on upright0 = (l/2, 0);
        point foot on upright1 = (-l/2, 0);
        point head on upright1 = (l/2, 0);
        point foot on upright2 = (-l/2, 0);
        point head on upright2 = (l/2, 0);
        point left on bar1 = (-l/2, 0);
        point right on bar1 = (l/2, 0);
        point left on bar2 = (-l/2, 0);
        point right on bar2 = (l/2, 0);
        point a1 on ground = (l, 0);
        point a2 on ground = (2*l, 0);
        revolute foot0 (upright0.foot, ground);
        revolute foot1 (upright1.foot, ground.a1);
        revolute foot2 (upright2.foot, ground.a2);
        revolute head0 (bar1.left, upright0.head);
        revolute head1 (bar1.right, upright1.head);
        revolute head2 (bar2.left, upright1.head);
        revolute head3 (bar2.right, upright2.head);
        start {
            phi0 = 90 [deg]; der(phi0) = -1 [rad/s];
            guess phi1 = 90 [deg]; guess phi2 = 90 [deg];
            guess x1 = l; guess x2 = 2*l; guess x3 = l/2; guess x4 = 3/2*l;
            guess y0 = l/2; guess y1 = l/2; guess y2 = l/2; guess y3 = l; guess y4 = l;
        }
        output head_x [m] = upright0.head.x;
        output head_y [m] = upright0.head.y;
        output head_vx [m/s] = der(upright0.head.x);
        output head_vy [m/s] = der(upright0.head.y);
    }
}

/// t, then place and velocity of B0.
const SAMPLES: [(f64, [f64; 4]); 3] = [
    (1.0, [-0.1950203019494351, -0.9807992056621738, -6.6766780368811585, 1.3275783251604871]),
    (4.0, [0.11761610237680861, 0.9930591384513251, 1.0690392650289686, -0.12661504916672028]),
    (10.0, [0.3284581115408154, 0.944518538178601, 1.4230514702069441, -0.49486884548704296]),
];

#[test]
fn double_fourbar_a02() -> Result<(), Error> {
    let h = 1.0 / 11_000.0;
    let start = |h| Simulation::new(DoubleFourBar::declared(), h);
    through_double_paths("double_fourbar_a02, a turn", h, start, |case, run| {
        let once = run.advance_to_zero(|at| at.q.phi0 + 1.5 * std::f64::consts::PI)?.t;
        case.near("revolution", once, 1.9425149226070837, 2e-7);
        Ok(())
    })?;
    through_double_paths("double_fourbar_a02", h, start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let head = run.now()?.outputs;
            case.all_near(
                ["x", "y", "vx", "vy"],
                t,
                [head.head_x, head.head_y, head.head_vx, head.head_vy],
                reference,
                [1e-6, 1e-6, 5e-6, 5e-6],
            );
        }
        Ok(())
    })
}
