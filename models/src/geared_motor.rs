//! Geared motor: a motor with its torque–speed line runs up a flywheel.
//!
//! ```text
//!      motor        flywheel
//!               ╭───────────────╮
//!     ╭─────╮   │               │
//!     │  o  │╪╪╪│       o       │  bearing, viscous
//!     ╰─────╯   │               │
//!        r₁     ╰───────────────╯
//!                      r₂
//! ```
//!
//! Reference: with n = r₁/r₂ the motor feels the inertia J = J₁ + n² J₂ and the
//! damping d = M₀/ω₀ + n² c, M₀ being its torque at rest and ω₀ its speed without
//! load. So ω − ω∞ falls as exp(−t/τ), ω∞ = M₀/d, τ = J/d; from rest, ω is
//! ω∞(1 − exp(−t/τ)).

use mbs_runtime::mechanism;

mechanism! {
    /// Motor, pair of gears and flywheel.
    pub GearedMotor {
        dof = 1;
        /// Pitch radius of the gear on the motor.
        param pinion_radius = 15 [mm] where pinion_radius > 0;
        /// Pitch radius of the gear on the flywheel.
        param wheel_radius = 60 [mm] where wheel_radius > 0;
        /// Inertia of the motor with its gear.
        param rotor_inertia = 2e-4 [kg*m^2] where rotor_inertia > 0;
        /// Inertia of the flywheel with its gear.
        param wheel_inertia = 0.02 [kg*m^2] where wheel_inertia > 0;
        /// Torque of the motor at rest.
        param stall = 0.5 [N*m];
        /// Speed of the motor without load.
        param no_load = 3000 [rpm];
        /// Damping of the flywheel's bearing.
        param viscous = 5e-3 [N*m*s];
        /// Speed of the motor at the start.
        param speed = 100 [rpm];
        /// Torque of a load on the flywheel.
        input load [N*m];

        body rotor (phi1) { inertia = rotor_inertia; }
        body wheel (phi2) { inertia = wheel_inertia; }
        gear mesh (rotor, wheel) radii (pinion_radius, wheel_radius);
        motor drive (rotor, ground) { stall = stall; no_load = no_load; }
        torque bearing on wheel = -viscous*der(phi2);
        torque load on wheel = load;

        start { phi1 = 0; der(phi1) = speed; }

        /// Speed of the motor.
        output motor_speed [rpm] = der(phi1);
        /// Speed of the flywheel; it turns the other way.
        output wheel_speed [rpm] = der(phi2);
        /// Tooth force.
        output tooth_force [N] = lambda(mesh);
        /// Power of the motor.
        output motor_power [W] = power(drive);
    }
}
