//! A mass between a spring with a damper and a force.
//!
//! ```text
//!    ╱│ stiffness ┌──────┐
//!    ╱├──/\/\/\───┤      │  push
//!    ╱├────[===───┤ mass │ ─────▶
//!    ╱│  damping  └──────┘ ─── x
//!    ╱└─────────────o──o──────────
//! ```
//!
//! The measure of every integrator. Reference: with ω² = stiffness/mass,
//! δ = damping/(2 mass) < ω and ν² = ω² − δ², released at x₀ from rest,
//!
//! x(t) = x₀ exp(−δt) (cos νt + δ/ν sin νt),
//!
//! and a constant push holds it at push/stiffness in the end.

use mbs_runtime::mechanism;

mechanism! {
    /// Mass on a spring with a damper.
    pub SpringMassDamper {
        dof = 1;
        /// Mass.
        param mass = 2 [kg] where mass > 0;
        /// Stiffness of the spring.
        param stiffness = 200 [N/m] where stiffness > 0;
        /// Damping.
        param damping = 4 [N*s/m] where damping >= 0;
        /// Length of the spring without force.
        param free_length = 0.5 [m] where free_length > 0;
        /// Displacement at the start.
        param release = 0.1 [m] where release > -free_length;
        /// Force on the mass.
        input push [N];

        body block (x) { mass = mass; }
        point wall on ground = (-free_length, 0);
        spring coil (block, ground.wall) {
            stiffness = stiffness;
            length = free_length;
            damping = damping;
        }
        force motor on block = (push, 0);

        start { x = release; der(x) = 0; }

        /// Force of the wall on the spring.
        output wall_force [N] = -stiffness*x - damping*der(x);
        /// Power that the damper takes.
        output loss [W] = damping*der(x)^2;
    }
}
