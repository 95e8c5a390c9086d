//! A DC motor with inductance, held at a speed by a PI controller.
//!
//! ```text
//!        R      L
//!   ┌──/\/\──ᗰᗰᗰ──┐        ╭───╮
//!   │  ──▶ current │        │   │ theta    load
//!   │              ├────────┤ M ├══════════◀──
//!   u              │        │   │ inertia
//!   │              │        ╰───╯
//!   └──────────────┘
//! ```
//!
//! Current and integral are states of the declaration's own:
//! L di/dt = u − R i − k ω, J dω/dt = k i + load and dε/dt = ω* − ω with
//! u = P (ω* − ω) + I ε. Reference: at rest the current is −load/k and the
//! speed is ω*, and deviations go with the roots of
//!
//! L J λ³ + R J λ² + k (k + P) λ + k I = 0.

use mbs_runtime::mechanism;

mechanism! {
    /// DC motor with inductance and PI speed control.
    pub DcMotor {
        dof = 1;
        /// Resistance of the winding.
        param resistance = 1 [ohm] where resistance >= 0;
        /// Inductance of the winding.
        param inductance = 5 [mH] where inductance > 0;
        /// Torque per current, and voltage per speed.
        param constant = 0.05 [N*m/A] where constant >= 0;
        /// Inertia of the rotor.
        param inertia = 1e-4 [kg*m^2] where inertia > 0;
        /// Speed that the controller holds.
        param wanted = 100 [rad/s];
        /// Gain of the deviation.
        param proportional = 0.2 [V*s/rad];
        /// Gain of its integral.
        param integrating = 5 [V/rad];
        /// Torque on the shaft from outside.
        input load [N*m];

        body rotor (angle = theta) { inertia = inertia; }

        /// Current in the winding.
        state current [A] = 0;
        der(current) = (voltage - resistance*current - constant*der(theta))/inductance;
        torque drive on rotor = constant*current;
        torque brake on rotor = load;

        /// Integral of the deviation of the speed.
        state missing [rad] = 0;
        der(missing) = wanted - der(theta);
        let voltage = proportional*(wanted - der(theta)) + integrating*missing;

        start { der(theta) = 10 [rad/s]; }

        /// Voltage that the controller asks for.
        output control [V] = voltage;
        /// Speed of the rotor.
        output speed [rpm] = der(theta);
        /// Heat in the winding.
        output heat [W] = resistance*current^2;
    }
}
