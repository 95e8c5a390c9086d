//! Rod sliding between wall and floor guides, both bilateral.
//!
//! Textbook result (sliding ladder without friction), θ from the floor, at rest
//! at 60°: wall force ¾ m g cos θ (3 sin θ − 2 sin θ₀), floor force
//! m g/4 (1 + 9 sin² θ − 6 sin θ sin θ₀), θ̈ = −(3g/2L) cos θ; the wall force
//! vanishes when the top is at 2/3 of its first height. Values over time by
//! Gauss quadrature.
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's truncation.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Case, Single, through_every_path};

mechanism! {
    Ladder {
        dof = 1;
        param length = 2 [m];
        param mass = 3 [kg];
        gravity = (0, -9.81) [m/s^2];
        body ladder (x, y, phi) { mass = mass; inertia = mass*length^2/12; }
        point foot on ladder = (length/2, 0);
        point head on ladder = (-length/2, 0);
        point_on_line floor (ladder.foot, ground) along (1, 0);
        point_on_line wall (ladder.head, ground) along (0, 1);
        start { phi = -60 [deg]; der(phi) = 0; }
        // −λ n with n = (0, 1) at the floor, (−1, 0) at the wall
        output wall_force [N] = lambda(wall);
        output floor_force [N] = -lambda(floor);
    }
}

/// t, then θ and its rate.
const SAMPLES: [(f64, [f64; 2]); 2] =
    [(0.3, [0.8737590087843495, -1.2086667191530436]), (0.5, [0.5273606656550797, -2.310449329607855])];

#[test]
fn ladder_sliding() -> Result<(), Error> {
    let (m, g) = (3.0, 9.81);
    let sin0 = 60_f64.to_radians().sin();
    let wall = |sin: f64, cos: f64| 0.75 * m * g * cos * (3.0 * sin - 2.0 * sin0);
    let floor = |sin: f64| m * g / 4.0 * (1.0 + 9.0 * sin * sin - 6.0 * sin * sin0);

    let mut case = Case::new("ladder_sliding, release");
    let forces = Simulation::new(Ladder::declared(), 1e-4)?.outputs()?;
    case.near("wall force at release", forces.wall_force, wall(sin0, 0.5), 1e-12);
    case.near("floor force at release", forces.floor_force, floor(sin0), 1e-12);
    case.finish();

    let (h, single) = (1e-4, Single::Longer(50.0));
    let start = |h| Simulation::new(Ladder::declared(), h);
    through_every_path("ladder_sliding", h, single, start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let at = run.now()?;
            case.all_near(["theta", "omega"], t, [-at.q.phi, -at.v.phi], reference, [2e-8, 1e-7]);
        }
        Ok(())
    })?;
    through_every_path("ladder_sliding, at 30 degrees", h, single, start, |case, run| {
        let theta = 30_f64.to_radians();
        let (sin, cos) = theta.sin_cos();
        let at = run.advance_to_zero(|at| at.q.phi + theta)?;
        case.near("wall force", at.outputs.wall_force, wall(sin, cos), 1e-6);
        case.near("floor force", at.outputs.floor_force, floor(sin), 1e-6);
        case.near("rate", -at.v.phi, -2.3207894813377656, 1e-7);
        Ok(())
    })?;
    through_every_path("ladder_sliding, off the wall", h, single, start, |case, run| {
        let at = run.advance_to_zero(|at| at.outputs.wall_force)?;
        case.near("angle", -at.q.phi, (2.0 / 3.0 * sin0).asin(), 1e-8);
        case.near("time", at.t, 0.45966282637738104, 1e-8);
        Ok(())
    })
}
