//! Chaplygin's sleigh: a body on ice with a knife edge that does not slip sideways.
//!
//! ```text
//!            u ↗
//!          edge       centre of mass
//!     ──────═╪═──────────●────────── sleigh m, J
//!            a behind it        ↺ φ
//! ```
//!
//! The edge allows the velocity u along itself and none across:
//!
//! ẏ_e cos φ − ẋ_e sin φ = 0
//!
//! No equation between x, y and φ follows, so the sleigh reaches every place, with two degrees of freedom.
//! With ω = φ̇ and J_e = J + m a² the motion is
//!
//! u̇ = a ω²,  ω̇ = −(m a/J_e) u ω.
//!
//! Whatever its start, it ends on a straight line with the edge behind the centre of mass, though nothing
//! takes energy (Y. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, American Mathematical Society
//! 1972; A. M. Bloch, Nonholonomic Mechanics and Control, Springer 2003, section 1.7).
//!
//! Reference: from u = 0 and ω = Ω, with U = Ω √(J_e/m) and λ = a Ω²/U,
//!
//! u = U tanh λt,  ω = Ω/cosh λt,  φ = 2 (Ω/λ) arctan tanh(λt/2).

use mbs_runtime::mechanism;

mechanism! {
    /// Sleigh with a knife edge behind its centre of mass.
    pub ChaplyginSleigh {
        dof = 2;
        /// Mass of the sleigh.
        param mass = 2 [kg] where mass > 0;
        /// Its moment of inertia about the centre of mass.
        param inertia = 0.5 [kg*m^2] where inertia > 0;
        /// Distance of the edge behind the centre of mass.
        param behind = 0.3 [m];
        /// Rate at which it turns at the start.
        param turning = 2 [rad/s];

        body sleigh (x, y, phi) { mass = mass; inertia = inertia; }
        point edge on sleigh = (-behind, 0);
        // for pictures
        point bow on sleigh = (behind, 0);

        /// The edge does not slip sideways.
        rate knife: der(sleigh.edge.y)*cos(phi) = der(sleigh.edge.x)*sin(phi);

        start { x = behind; y = 0; phi = 0; der(phi) = turning; der(x) = 0; }
        closes = 0 [s] .. 4 [s];

        /// Speed along the edge.
        output speed [m/s] = der(sleigh.edge.x)*cos(phi) + der(sleigh.edge.y)*sin(phi);
        /// Force of the ice across the edge.
        output across [N] = -lambda(knife);
    }
}
