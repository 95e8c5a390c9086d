//! ADAMS reference curves of Chrono's joint tests: revolute pendulum and
//! spring-damper (the planar ones).
//!
//! Project Chrono data/testing/joints/revolute_joint/Revolute_Case01_ADAMS_*
//! and transpring_force/TranSpring_Case02_ADAMS_Pos (solved with MSC ADAMS;
//! Chrono asks for 1e-3 in position, 2e-2 RMS in force). g = 9.80665 in −z, here
//! −y. (1) 1 kg, 0.1 kg m², centre of mass 2 m from the pin; force on the
//! ground. (2) 1 kg on 100 N/m with free length 2 m and 5 N s/m. Both released
//! at rest from the horizontal. Reference: 80-bit integration, which has all the
//! digits that ADAMS printed (5 to 7).
//!
//! h = 1e-4 s, deadbeat feedback, held. Limit: Heun's truncation.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Single, through_every_path};

mechanism! {
    Pendulum {
        dof = 1;
        gravity = (0, -9.80665) [m/s^2];
        body bob (x, y, phi) { mass = 1 [kg]; inertia = 0.1 [kg*m^2]; }
        point end on bob = (-2, 0) [m];
        revolute pin (bob.end, ground);     // λ: the force on the ground
        start { phi = 0; der(phi) = 0; }
    }
}

mechanism! {
    Hanging {
        dof = 2;
        gravity = (0, -9.80665) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        spring coil (bob, ground) { stiffness = 100 [N/m]; length = 2 [m]; damping = 5 [N*s/m]; }
        start { x = 2 [m]; }
    }
}

/// t, then x, z and the force on the ground.
const REVOLUTE: [(f64, [f64; 4]); 4] = [
    (0.5, [1.6608077537381978, -1.1143238331486416, 13.279718119526134, -9.149252404107514]),
    (1.0, [-0.8923814855285859, -1.78987577342278, -11.46123756693466, -23.227327629493622]),
    (2.5, [-0.2655063363406517, -1.9822982584270623, -3.7766084717878634, -28.435743020014428]),
    (5.0, [-1.999683868883533, -0.03555874754523177, -0.5102298617959269, -0.24825958691772873]),
];
/// t, then the place.
const SPRING: [(f64, [f64; 2]); 4] = [
    (0.5, [1.773547003576514, -1.1621328770542894]),
    (1.0, [-0.5973274305584331, -2.1890686101953443]),
    (2.5, [-0.9805594820487818, -1.9928872295489182]),
    (5.0, [-1.9451978504541874, -0.7674009950436884]),
];

#[test]
fn revolute_pendulum() -> Result<(), Error> {
    let start = |h| Simulation::new(Pendulum::declared(), h);
    through_every_path("adams_joint_tests, revolute", 1e-4, Single::Longer(20.0), start, |case, run| {
        for (t, reference) in REVOLUTE {
            run.advance_to(t)?;
            let at = run.now()?;
            case.all_near(
                ["revolute x", "revolute z", "Fx", "Fz"],
                t,
                [at.q.x, at.q.y, at.multipliers.pin_x, at.multipliers.pin_y],
                reference,
                [1e-6, 1e-6, 1e-5, 1e-5],
            );
        }
        Ok(())
    })
}

#[test]
fn spring_and_damper() -> Result<(), Error> {
    let start = |h| Simulation::new(Hanging::declared(), h);
    through_every_path("adams_joint_tests, spring", 1e-4, Single::Longer(10.0), start, |case, run| {
        for (t, reference) in SPRING {
            run.advance_to(t)?;
            let q = run.now()?.q;
            case.all_near(["spring y", "spring z"], t, [q.x, q.y], reference, [1e-6; 2]);
        }
        Ok(())
    })
}
