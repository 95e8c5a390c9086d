//! Hanging four-bar linkage: equilibrium and small oscillation.
//!
//! Drake examples/multibody/four_bar (README.md, four_bar.sdf): three links of
//! 4 m and 20 kg (cuboids 4.2 × 0.2 m), pivots 2 m apart, g = 9.8. It hangs as
//! a trapezoid with q = arctan √15; Drake prints 75.52° and 104.48°. Reference:
//! gradient and curvature of the potential, 80-bit integration.
//!
//! Equilibrium and frequency from accelerations, no step; motion with h = 1e-4
//! s, deadbeat feedback, held. Limits: the central difference for the
//! frequency (1e-10), Heun's truncation for the motion.

use mbs_runtime::{Error, Mechanism, Simulation, mechanism, start};
use paths::{Case, Instant, Single, bisect, through_every_path};

mechanism! {
    FourBar {
        dof = 1;
        const l = 4 [m];
        const m = 20 [kg];
        const j = m*((4.2 [m])^2 + (0.2 [m])^2)/12;
        gravity = (0, -9.8) [m/s^2];
        body a (xa, ya, angle_a) { mass = m; inertia = j; }
        body b (xb, yb, angle_b) { mass = m; inertia = j; }
        body c (xc, yc, angle_c) { mass = m; inertia = j; }
        point w on ground = (-2, 0) [m];
        point top on a = (-l/2, 0);
        point bottom on a = (l/2, 0);
        point left on b = (-l/2, 0);
        point right on b = (l/2, 0);
        point top on c = (-l/2, 0);
        point bottom on c = (l/2, 0);
        revolute pin_w (a.top, ground.w);
        revolute pin_a (b.left, a.bottom);
        revolute pin_c (b.right, c.bottom);
        revolute pin_o (c.top, ground);
        start {
            angle_a = 255 [deg]; der(angle_a) = 0;
            guess angle_b = 360 [deg]; guess angle_c = 285 [deg];
            guess xa = -2.5 [m]; guess ya = -2 [m]; guess xb = -1 [m]; guess yb = -4 [m];
            guess xc = 0.5 [m]; guess yc = -2 [m];
        }
    }
}

/// At rest with link A at `q` below the −x direction.
fn at_rest(q: f64, step: f64) -> Result<Simulation<FourBar<f64>>, Error> {
    let mut start = FourBar::<f64>::declared().declared_start();
    start.q.angle_a = std::f64::consts::PI + q;
    let start = start::consistent(&FourBar::declared(), &start)?;
    Simulation::builder(FourBar::declared(), step).from_state(start).build()
}

/// t, then the angle of link A and its rate.
const SAMPLES: [(f64, [f64; 2]); 2] =
    [(1.0, [1.273696034070255, -0.5236920446519064]), (3.0, [1.446180976811454, 0.4688344678700429])];

#[test]
fn fourbar_drake_equilibrium() -> Result<(), Error> {
    let mut case = Case::new("fourbar_drake_equilibrium, instants");
    let acceleration = |q: f64| Ok::<_, Error>(at_rest(q, 1e-4)?.reactions()?.acceleration.angle_a);
    let equilibrium = bisect(1.2, 1.4, acceleration)?;
    let hanging = at_rest(equilibrium, 1e-4)?.state().q;
    case.near("angle of A", equilibrium.to_degrees(), 75.52248781407008, 1e-11);
    case.near("angle at B", (hanging.angle_b - hanging.angle_a).to_degrees(), 104.47751218592992, 1e-11);

    let epsilon = 1e-5;
    let slope =
        (acceleration(equilibrium + epsilon)? - acceleration(equilibrium - epsilon)?) / (2.0 * epsilon);
    let omega = (-slope).sqrt();
    case.near("frequency", omega, 1.726511131738735, 1e-9);
    case.near("period", std::f64::consts::TAU / omega, 3.639238225386891, 1e-9);
    case.finish();

    let exact = 15_f64.sqrt().atan();
    let start = |h| at_rest(exact + 0.3, h);
    through_every_path("fourbar_drake_equilibrium", 1e-4, Single::Longer(50.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let Instant { q, v, .. } = run.now()?;
            let ours = [q.angle_a - std::f64::consts::PI, v.angle_a];
            case.all_near(["q", "q rate"], t, ours, reference, [5e-8; 2]);
        }
        Ok(())
    })?;
    // released in equilibrium, nothing moves
    let start = |h| at_rest(exact, h);
    through_every_path("fourbar_drake_equilibrium, at rest", 1e-4, Single::Rounding, start, |case, run| {
        run.advance_to(3.0)?;
        case.near("rest", run.now()?.q.angle_a - std::f64::consts::PI, exact, 1e-12);
        Ok(())
    })
}
