//! Pin reactions of a uniform rod swinging from the horizontal.
//!
//! Textbook result (Beer & Johnston, Meriam & Kraige): with θ the angle below
//! the horizontal, ω² = 3 g sin θ / L, and the ground pulls along the rod with
//! 5/2 m g sin θ and across it with 1/4 m g cos θ, so
//! Rx = −9/4 m g sin θ cos θ, Ry = m g/4 (1 + 9 sin² θ).
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's error in the energy,
//! O(h²); the reactions inherit it through the centripetal force.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Single, through_every_path};

mechanism! {
    Rod {
        dof = 1;
        param length = 1.5 [m];
        param mass = 2 [kg];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, phi) { mass = mass; inertia = mass*length^2/12; }
        point end on rod = (-length/2, 0);
        revolute pin (ground, rod.end);     // λ: the force on the rod
        start { phi = 0; der(phi) = 0; }
        output force_x [N] = lambda(pin_x);
        output force_y [N] = lambda(pin_y);
    }
}

#[test]
fn rod_pendulum_reactions() -> Result<(), Error> {
    let (m, g, length) = (2.0, 9.81, 1.5);
    let start = |h| Simulation::new(Rod::declared(), h);
    through_every_path("rod_pendulum_reactions", 1e-4, Single::Longer(20.0), start, |case, run| {
        for degrees in [0.0_f64, 30.0, 45.0, 60.0, 90.0] {
            let theta = degrees.to_radians();
            let at = match degrees {
                0.0 => run.now()?,
                _ => run.advance_to_zero(|at| at.q.phi + theta)?,
            };
            let (sin, cos) = theta.sin_cos();
            case.all_near(
                ["omega", "Rx", "Ry"],
                degrees,
                [-at.v.phi, at.outputs.force_x, at.outputs.force_y],
                [
                    (3.0 * g * sin / length).sqrt(),
                    -9.0 / 4.0 * m * g * sin * cos,
                    m * g / 4.0 * (1.0 + 9.0 * sin * sin),
                ],
                [5e-7, 5e-6, 5e-6],
            );
        }
        Ok(())
    })
}
