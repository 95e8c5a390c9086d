//! A point mass on a massless rod, in Cartesian coordinates.
//!
//! ```text
//!    ────o──────── x
//!        │╲
//!        │ ╲ length
//!        │φ ╲
//!        y   ● mass
//! ```
//!
//! The index-3 pendulum that solvers of constrained systems are tried on:
//! released at rest from the horizontal. Its period is 4 √(l/g) K(sin 45°) with
//! the complete elliptic integral K(sin 45°) = 1.854074677301372, so
//! 2.367841947… s for a length of 1 m and g = 9.81 m/s²; the tension in the
//! lowest position is 3 m g, which energy and centripetal force give directly.

use mbs_runtime::mechanism;

mechanism! {
    /// A point mass on a massless rod.
    pub Pendulum {
        dof = 1;
        /// Length of the rod.
        param length = 1 [m] where length > 0;
        /// Mass of the bob.
        param mass = 1 [kg] where mass > 0;
        gravity = (0, -9.81) [m/s^2];

        body bob (x, y) { mass = mass; }

        /// The rod keeps its length.
        constraint rod: (x^2 + y^2)/(2*length) = length/2;

        start { x = length; y = 0; }

        /// Force in the rod, positive when it pulls.
        output tension [N] = lambda(rod)*sqrt(x^2 + y^2)/length;
        /// Angle from the lowest position.
        output angle [deg] = atan2(x, -y);
    }
}
