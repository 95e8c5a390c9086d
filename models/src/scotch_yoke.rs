//! Scotch yoke: a crank's pin in the slot of a yoke, exact harmonic motion.
//!
//! ```text
//!              ┌─┐
//!         pin  │o│
//!           r ╱│ │  yoke
//!            ╱ │ ├──────────▶ x
//!     O     o  │ │
//!              └─┘
//! ```
//!
//! Reference: x = r cos θ, exactly; the torque of the drive is that of the
//! yoke's inertia, m r² ω² sin θ cos θ, less r sin θ times the load, which helps
//! while x falls.

use mbs_runtime::mechanism;

mechanism! {
    /// Crank and yoke.
    pub ScotchYoke {
        dof = 0;
        /// Length of the crank.
        param radius = 40 [mm] where radius > 0;
        /// Mass of the yoke.
        param yoke_mass = 1.5 [kg] where yoke_mass > 0;
        /// Inertia of the crank, balanced.
        param crank_inertia = 2e-3 [kg*m^2] where crank_inertia > 0;
        /// Speed of the crank.
        param omega = 150 [rpm];
        /// Force on the yoke, against x.
        input load [N];

        body crank (theta) { inertia = crank_inertia; }
        body yoke (x) { mass = yoke_mass; }
        point pin on crank = (radius, 0);
        pin_slot slot (crank.pin, yoke) along (0, 1);
        drive motor: crank.angle = omega*t;
        force load on yoke = (-load, 0);

        start { guess x = radius; der(theta) = omega; }

        /// Force of the pin on the yoke.
        output pin_force [N] = -lambda(slot);
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
    }
}
