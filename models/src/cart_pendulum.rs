//! A rod on a cart that a force pushes.
//!
//! ```text
//!             ╲ rod: length, rod_mass
//!           θ │╲
//!             │ ╲
//!    push   ┌─┴──o┐
//!    ─────▶ │cart │ ─── x
//!    ───────o─────o─────────
//! ```
//!
//! The plant that controllers are tried on: the embedding program sets `push`
//! at every step. θ counts from the upright position, counter-clockwise.
//!
//! Reference: with s = length/2, J = rod_mass s²/3, M the cart's and m the rod's
//! mass (Lagrange's equations of the two coordinates)
//!
//! ```text
//! (M + m) ẍ − m s cos θ θ̈ + m s sin θ θ̇² = push
//! (J + m s²) θ̈ − m s cos θ ẍ = m g s sin θ
//! ```

use mbs_runtime::mechanism;

mechanism! {
    /// Rod on a cart, its centre above the pivot.
    pub CartPendulum {
        dof = 2;
        /// Mass of the cart.
        param cart_mass = 1 [kg] where cart_mass > 0;
        /// Mass of the rod.
        param rod_mass = 0.3 [kg] where rod_mass > 0;
        /// Length of the rod.
        param length = 0.6 [m] where length > 0;
        /// Angle of the rod at the start, from the upright position.
        param tilt = 5 [deg];
        /// Force on the cart.
        input push [N];
        gravity = (0, -9.81) [m/s^2];

        body cart (x) { mass = cart_mass; }
        body rod (xr, yr, theta) { mass = rod_mass; inertia = rod_mass*length^2/12; }

        point base on rod = (0, -length/2);
        point tip on rod = (0, length/2);
        revolute pivot (cart, rod.base);
        force motor on cart = (push, 0);

        start { x = 0; theta = tilt; der(x) = 0; der(theta) = 0; }

        /// Path of the rod's tip.
        output tip_x [m] = rod.tip.x;
        /// Path of the rod's tip.
        output tip_y [m] = rod.tip.y;
        /// Vertical force of the cart on the rod.
        output pivot_load [N] = lambda(pivot_y);
    }
}
