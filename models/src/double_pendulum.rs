//! Two uniform rods, one hanging from the other.
//!
//! ```text
//!    ────o──────── x
//!        │╲ length1, mass1
//!        │φ1╲
//!        y   o
//!            │╲ length2, mass2
//!            │φ2╲
//! ```
//!
//! For normal modes at small angles and for chaos at large ones.
//!
//! Reference: two equal rods of length l swing about the vertical with
//! ω² = (3 ∓ 6/√7) g/l and amplitudes φ2/φ1 = 3g/(lω²) − 8/3, that is ≈ 1.43 in
//! phase and ≈ −2.10 against it (from det(K − ω²M) = 0 with
//! M = ml²[4/3 1/2; 1/2 1/3], K = mgl diag(3/2, 1/2)).

use mbs_runtime::mechanism;

mechanism! {
    /// Double pendulum of uniform rods.
    pub DoublePendulum {
        dof = 2;
        /// Length of the upper rod.
        param length1 = 0.5 [m] where length1 > 0;
        /// Length of the lower rod.
        param length2 = 0.5 [m] where length2 > 0;
        /// Mass of the upper rod.
        param mass1 = 1 [kg] where mass1 > 0;
        /// Mass of the lower rod.
        param mass2 = 1 [kg] where mass2 > 0;
        /// Angle of the upper rod at the start, from the vertical.
        param phi1 = 40 [deg];
        /// Angle of the lower rod at the start, from the vertical.
        param phi2 = 20 [deg];
        gravity = (0, -9.81) [m/s^2];

        body upper (x1, y1, angle1) { mass = mass1; inertia = mass1*length1^2/12; }
        body lower (x2, y2, angle2) { mass = mass2; inertia = mass2*length2^2/12; }

        // at angle 0 a rod hangs
        point top on upper = (0, length1/2);
        point end on upper = (0, -length1/2);
        point top on lower = (0, length2/2);
        point end on lower = (0, -length2/2);
        revolute hook (ground, upper.top);
        revolute pin (upper.end, lower.top);

        start {
            angle1 = phi1; angle2 = phi2;
            der(angle1) = 0; der(angle2) = 0;
        }

        /// Path of the free end.
        output end_x [m] = lower.end.x;
        /// Path of the free end.
        output end_y [m] = lower.end.y;
        /// Force of the hook on the upper rod.
        output hook_force [N] = sqrt(lambda(hook_x)^2 + lambda(hook_y)^2);
    }
}
