//! Trammel of Archimedes: a rod on two rails at right angles draws an ellipse.
//!
//! ```text
//!            │ rail y
//!            o
//!            │╲_
//!            │  ╲_  a − b
//!     ───────┼────o─────── rail x
//!            │     ╲_ b
//!            │       o P
//! ```
//!
//! Reference: with the rod turned by φ, P = (a cos φ, b sin φ) exactly, on the
//! ellipse x²/a² + y²/b² = 1.

use mbs_runtime::mechanism;

mechanism! {
    /// Trammel, its rod turning at constant speed.
    pub TrammelOfArchimedes {
        dof = 0;
        /// Half-axis along x: from P to the shoe on rail y.
        param a = 0.3 [m] where a > b;
        /// Half-axis along y: from P to the shoe on rail x.
        param b = 0.12 [m] where b > 0;
        /// Mass of the rod.
        param rod_mass = 0.8 [kg] where rod_mass > 0;
        /// Speed of the rod.
        param omega = 60 [rpm];
        gravity = (0, -9.81) [m/s^2];

        body rod (x, y, phi) { mass = rod_mass; inertia = rod_mass*a^2/12; }
        point p on rod = (a/2, 0);
        point shoe_x on rod = (a/2 - b, 0);
        point shoe_y on rod = (-a/2, 0);
        point_on_line rail_x (rod.shoe_x, ground) along (1, 0);
        point_on_line rail_y (rod.shoe_y, ground) along (0, 1);
        drive motor: rod.angle = omega*t;

        start { guess x = a/2; der(phi) = omega; }

        /// Path of P.
        output p_x [m] = rod.p.x;
        /// Path of P.
        output p_y [m] = rod.p.y;
        /// Torque that turns the rod.
        output drive_torque [N*m] = effort(motor);
        /// Force of the rod across rail x.
        output shoe_x_force [N] = lambda(rail_x);
        /// Force of the rod across rail y.
        output shoe_y_force [N] = lambda(rail_y);
    }
}
