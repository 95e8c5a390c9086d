//! Metronome: a weight fixed to an upright rod that a torsion spring holds.
//!
//! ```text
//!             ▄█▄ weight, `height` above the pivot
//!              │╱
//!              │ rod
//!              │  φ
//!              │╱
//!    ────────( o )───────
//!         torsion spring
//! ```
//!
//! Moving the weight up slows the beat, until the spring no longer holds it.
//!
//! Reference: with the moment of inertia J about the pivot (rod m l²/3, weight
//! j + M height²) and the moment of mass S = m l/2 + M height,
//! J φ̈ = g S sin φ − stiffness·φ, so it beats with ω² = (stiffness − g S)/J;
//! the torque in the weld is j φ̈.

use mbs_runtime::mechanism;

mechanism! {
    /// Inverted pendulum on a torsion spring, its weight fixed to the rod.
    pub Metronome {
        dof = 1;
        /// Length of the rod.
        param length = 0.2 [m] where length > 0;
        /// Mass of the rod.
        param rod_mass = 0.03 [kg] where rod_mass > 0;
        /// Height of the weight above the pivot.
        param height = 0.15 [m] where height > 0;
        /// Mass of the weight.
        param weight_mass = 0.05 [kg] where weight_mass > 0;
        /// Moment of inertia of the weight.
        param weight_inertia = 5e-6 [kg*m^2] where weight_inertia > 0;
        /// Stiffness of the torsion spring.
        param stiffness = 0.2 [N*m] where stiffness > 0;
        /// Gravity.
        param g = 9.81 [m/s^2];
        /// Angle at the start, from the upright position.
        param release = 20 [deg];
        gravity = (0, -g);

        body rod (x1, y1, phi) { mass = rod_mass; inertia = rod_mass*length^2/12; }
        body weight (x2, y2, psi) { mass = weight_mass; inertia = weight_inertia; }

        point foot on rod = (0, -length/2);
        point clamp on rod = (0, height - length/2);
        revolute pivot (ground, rod.foot);
        fixed weld (rod.clamp, weight);
        torsion_spring spring (rod, ground) { stiffness = stiffness; angle = 0; }

        start { phi = release; der(phi) = 0; guess psi = release; guess y1 = length/2; guess y2 = height; }

        /// Torque of the rod on the weight.
        output weld_torque [N*m] = lambda(weld_angle);
        /// Angular frequency of small beats.
        output beat [rad/s] = sqrt(
            (stiffness - g*(rod_mass*length/2 + weight_mass*height))
            /(rod_mass*length^2/3 + weight_inertia + weight_mass*height^2)
        );
    }
}
