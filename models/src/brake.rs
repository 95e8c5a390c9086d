//! A disc brake that fades: the disc gets hot, and the friction of the pads falls with its temperature.
//!
//! ```text
//!        ╭───────────╮ flywheel and disc, J, ω ↺
//!        │     o     │
//!        │    ┌──┐   │
//!        ╰────│▒▒│───╯ pads, pressed by 2F at the radius r
//!             └──┘
//!     friction ──▶ heat C (T − T_0) ──▶ air H (T − T_a)
//! ```
//!
//! The temperature T of the disc is a state of the declaration's own. With the torque M of the pads
//!
//! J dω/dt = M_d − M,  C dT/dt = M ω − H (T − T_a),  M = 2 F r μ(T) tanh(ω/ω_t),
//!
//! M_d a torque from outside and ω_t small, so that the disc stops. The coefficient is μ(T) = μ_0 (1 − φ s(T)) with
//! the share s of its friction that a hot lining loses, and φ = 1, or φ = 0 without fade. The points of s are made up.
//! R. Limpert, Brake Design and Safety, SAE International 2011, has temperatures of brakes and fade.
//!
//! Reference: heat that is stored and heat that the air takes are the energy that the flywheel loses. Without fade the
//! disc is slower by b t, b = 2 F r μ_0/J, and with τ = C/H
//!
//! T = T_a + (T_0 − T_a) e^(−t/τ) + (J b/H) ((ω_0 + b τ)(1 − e^(−t/τ)) − b t).

use mbs_runtime::mechanism;

mechanism! {
    /// Flywheel on a disc brake that fades with its temperature.
    pub Brake {
        dof = 1;
        /// Inertia of the flywheel with its disc.
        param inertia = 60 [kg*m^2] where inertia > 0;
        /// Force on each of the two pads.
        param press = 10 [kN] where press >= 0;
        /// Radius at which the pads rub.
        param radius = 120 [mm] where radius > 0;
        /// Coefficient of friction of the cold pads.
        param cold = 0.4 where cold >= 0;
        /// Share of the fade that is built in.
        param fade = 1 where fade >= 0;
        /// Speed below which the pads grip softly.
        param transition = 0.5 [rad/s] where transition > 0;
        /// Heat capacity of the disc.
        param capacity = 2 [kJ/K] where capacity > 0;
        /// Heat that the air takes for every kelvin and second.
        param cooling = 20 [W/K] where cooling > 0;
        /// Temperature of the air.
        param air = 293.15 [K];
        /// Temperature of the disc at the start.
        param warm = 293.15 [K];
        /// Speed at the start.
        param speed = 1500 [rpm];
        /// Torque on the flywheel from outside.
        input drive [N*m];

        body disc (angle = theta) { inertia = inertia; }
        // for pictures
        point rim on disc = (2*radius, 0);
        point other on disc = (-radius, sqrt(3)*radius);
        point third on disc = (-radius, -sqrt(3)*radius);

        /// Temperature of the disc.
        state temperature [K] = warm;
        table lost(temperature) = [(420 [K], 0), (520 [K], 0.08), (620 [K], 0.3), (720 [K], 0.5)]
            linear outside hold;
        let coefficient = cold*(1 - fade*lost(temperature));
        let grip = 2*press*radius*coefficient*tanh(der(theta)/transition);
        let given = cooling*(temperature - air);
        der(temperature) = (grip*der(theta) - given)/capacity;
        /// Heat that the air has taken since the start.
        state taken [kJ] = 0;
        der(taken) = given;
        torque pads on disc = -grip;
        torque outside on disc = drive;

        start { theta = 0; der(theta) = speed; }

        /// Speed of the flywheel.
        output rotation [rpm] = der(theta);
        /// Torque of the pads against the motion.
        output braking [N*m] = grip;
        /// Coefficient of friction at the temperature of the disc.
        output friction = coefficient;
        /// Heat that the pads make.
        output made [kW] = grip*der(theta);
        /// Heat that the air takes.
        output lost_to_air [kW] = given;
        /// Heat stored in the disc since the start.
        output stored [kJ] = capacity*(temperature - warm);
        /// Energy of the flywheel.
        output turning [kJ] = kinetic_energy();
    }
}
