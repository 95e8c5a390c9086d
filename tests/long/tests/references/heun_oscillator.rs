//! Heun's method: exact discrete results.
//!
//! From the definition y⁺ = y + h/2 (f(t, y) + f(t + h, y + h f(t, y))), on
//! positions and velocities alike. (a) 1 kg on 100 N/m from x = 0.1, h = 0.01,
//! 100 steps: yₙ = R(iωh)ⁿ y₀ with R(z) = 1 + z + z²/2, in exact rational
//! arithmetic. (b) 1 kg in the plane on 50 N/m with free length 1 m, g = 9.81,
//! from (1.2, 0), h = 0.01, in 80-bit arithmetic; other schemes of second order
//! give other numbers. Limit: rounding.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Case, Instant, Single, through_every_path};

mechanism! {
    Line {
        dof = 1;
        body mass (x) { mass = 1 [kg]; }
        force pull on x = -100 [N/m]*x;
        start { x = 0.1 [m]; }
    }
}

mechanism! {
    Plane {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body mass (x, y) { mass = 1 [kg]; }
        spring coil (mass, ground) { stiffness = 50 [N/m]; length = 1 [m]; }
        start { x = 1.2 [m]; }
    }
}

/// Steps, then place and velocity.
const PLANE: [(f64, [f64; 4]); 3] = [
    (1.0, [1.1995, -0.0004905, -0.1, -0.0981]),
    (10.0, [1.1519635638073444, -0.04874939934518887, -0.9202536298097436, -0.969228201734994]),
    (100.0, [-0.6776784506819754, -0.9535738092109481, -1.4703441437309293, 4.135870040641873]),
];
/// Place at t = 1 without truncation.
const EXACT: [f64; 2] = [-0.6773694539488168, -0.9554932763949516];

const STEP: f64 = 0.01;

#[test]
fn line() -> Result<(), Error> {
    let start = |h| Simulation::new(Line::declared(), h);
    through_every_path("heun_oscillator, line", STEP, Single::Rounding, start, |case, run| {
        run.advance_to(1.0)?;
        let Instant { q, v, .. } = run.now()?;
        case.near("x after 100 steps", q.x, -0.08309544211249274, 1e-14);
        case.near("v after 100 steps", v.x, 0.558585576515391, 1e-13);
        case.near("growth of the amplitude", q.x.hypot(v.x / 10.0) / 0.1, 1.001250765931337, 1e-13);
        Ok(())
    })
}

#[test]
fn plane() -> Result<(), Error> {
    let start = |h| Simulation::new(Plane::declared(), h);
    through_every_path("heun_oscillator, plane", STEP, Single::Rounding, start, |case, run| {
        for (steps, reference) in PLANE {
            run.advance_to(steps * STEP)?;
            let Instant { q, v, .. } = run.now()?;
            case.all_near(["x", "y", "vx", "vy"], steps, [q.x, q.y, v.x, v.y], reference, [1e-13; 4]);
        }
        Ok(())
    })
}

/// Halving the step quarters the error.
#[test]
fn heun_is_of_second_order() -> Result<(), Error> {
    let mut case = Case::new("heun_oscillator, order");
    let error = |h: f64| {
        let mut plane = Simulation::new(Plane::declared(), h)?;
        plane.advance_to(1.0)?;
        let q = plane.state().q;
        Ok::<_, Error>((q.x - EXACT[0]).hypot(q.y - EXACT[1]))
    };
    // the next term of the error, relative to the first: O(h)
    case.near("error ratio", error(1e-4)? / error(0.5e-4)?, 4.0, 0.01);
    case.finish();
    Ok(())
}
