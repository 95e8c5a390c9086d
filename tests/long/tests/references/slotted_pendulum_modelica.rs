//! Mass on a swinging slotted arm with spring and damper.
//!
//! Modelica Standard Library, Elementary.PendulumWithSpringDamper: a massless
//! arm turns about (0.3, 0); on it slides a body of 1 kg and 1 kg m², at the
//! distance s from the joint, with a spring of 20 N/m (free length 0.2 m) and a
//! damper of 1 N s/m. g = 9.80665, from rest at s = 0.5, φ = 0. Reference:
//! Lagrange's equations in 80-bit arithmetic; the published Dymola run agrees
//! to 2e-5.
//!
//! Declared twice: with the massless arm as a body, and as a slot in the
//! sliding body that keeps over the pivot. h = 1e-4 s, deadbeat feedback, held.
//! Limit: Heun's truncation.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::{Single, through_every_path};

mechanism! {
    Arm {
        dof = 2;
        gravity = (0, -9.80665) [m/s^2];
        body arm (x_arm, y_arm, phi_arm) { mass = 0; inertia = 0; }
        body slider (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point pivot on ground = (0.3, 0) [m];
        revolute joint (arm, ground.pivot);
        prismatic slot (slider, arm) along (1, 0);
        spring coil (slider, arm) { stiffness = 20 [N/m]; length = 0.2 [m]; damping = 1 [N*s/m]; }
        start { x = 0.8 [m]; phi = 0; der(x) = 0; der(phi) = 0; }
        let s = (slider.x - ground.pivot.x)*cos(phi) + (slider.y - ground.pivot.y)*sin(phi);
        output distance [m] = s;
        output speed [m/s] = der(s);
    }
}

mechanism! {
    Slot {
        dof = 2;
        gravity = (0, -9.80665) [m/s^2];
        body slider (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point pivot on ground = (0.3, 0) [m];
        pin_slot slot (ground.pivot, slider) along (1, 0);
        spring coil (slider, ground.pivot) { stiffness = 20 [N/m]; length = 0.2 [m]; damping = 1 [N*s/m]; }
        start { x = 0.8 [m]; phi = 0; der(x) = 0; der(phi) = 0; }
        let s = (slider.x - ground.pivot.x)*cos(phi) + (slider.y - ground.pivot.y)*sin(phi);
        output distance [m] = s;
        output speed [m/s] = der(s);
    }
}

/// t, then s, φ and their rates.
const SAMPLES: [(f64, [f64; 4]); 5] = [
    (0.25, [0.35189542783805017, -0.12264428656349233, -0.9506263282741532, -0.9723443970411386]),
    (1.0, [0.7418376449689499, -1.3569474444878868, 1.9197502833808258, -1.6413415599527121]),
    (2.0, [0.3160718604061676, -2.261819001326526, -0.709166434276994, -0.20827178690007322]),
    (5.0, [0.856743175159375, -1.830582817777253, -0.08103783374793734, -1.0122295600449698]),
    (10.0, [0.7468532921359401, -1.3329158062225879, -0.3037146539324484, 0.5279408458034053]),
];
const NAMES: [&str; 4] = ["s", "phi", "v", "omega"];
const TOLERANCES: [f64; 4] = [3e-7, 3e-7, 1e-6, 1e-6];

#[test]
fn arm() -> Result<(), Error> {
    let start = |h| Simulation::new(Arm::declared(), h);
    through_every_path("slotted_pendulum_modelica, arm", 1e-4, Single::Longer(10.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let at = run.now()?;
            let ours = [at.outputs.distance, at.q.phi, at.outputs.speed, at.v.phi];
            case.all_near(NAMES, t, ours, reference, TOLERANCES);
        }
        Ok(())
    })
}

#[test]
fn slot() -> Result<(), Error> {
    let start = |h| Simulation::new(Slot::declared(), h);
    through_every_path("slotted_pendulum_modelica, slot", 1e-4, Single::Longer(10.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let at = run.now()?;
            let ours = [at.outputs.distance, at.q.phi, at.outputs.speed, at.v.phi];
            case.all_near(NAMES, t, ours, reference, TOLERANCES);
        }
        Ok(())
    })
}
