//! N equal rods, one hanging from the other.
//!
//! ```text
//!    ────o──────── x
//!        │╲ rod 1
//!        │θ1╲
//!        y   o
//!            │╲ rod 2
//!            │θ2╲
//!                o
//!                 ···
//!                    ╲ rod N
//!                     ╲
//!                      o end
//! ```
//!
//! The chain is released as a straight line that leans by `release`; its end
//! cracks like a whip. One declaration serves for N = 1, 2, 10 and 40.
//!
//! Reference: in the angles θ from the vertical, Mθ̈ = −Kθ for small ones, with
//! K_ii = m g l (N − i + 1/2), M_ii = m l² (N − i + 1/3) and, for i < j,
//! M_ij = m l² (N − j + 1/2). The slowest mode has ω² = 3g/(2l) for N = 1 and
//! (3 − 6/√7) g/l for N = 2. For many short rods it comes near to that of a
//! rope, ω = 1.2024 √(g/(N l)) (half the first zero of the Bessel function J₀;
//! D. Bernoulli, 1733).

use mbs_runtime::mechanism;

macro_rules! n_pendulum {
    ($(#[$($attribute:tt)*])* $Name:ident, $n:tt) => {
        mechanism! {
            $(#[$($attribute)*])*
            pub $Name {
                dof = $n;
                const N = $n;
                /// Length of a rod.
                param length = 1 [m] where length > 0;
                /// Mass of a rod.
                param mass = 1 [kg] where mass > 0;
                /// Angle of all rods at the start, from the vertical.
                param release = 30 [deg];
                gravity = (0, -9.81) [m/s^2];

                for i in 1..=N {
                    // at angle 0 a rod hangs
                    body rod[i] (x[i], y[i], theta[i]) { mass = mass; inertia = mass*length^2/12; }
                    point top on rod[i] = (0, length/2);
                    point end on rod[i] = (0, -length/2);
                    if i == 1 {
                        revolute pin[i] (ground, rod[i].top);
                    } else {
                        revolute pin[i] (rod[i-1].end, rod[i].top);
                    }
                    start { theta[i] = release; der(theta[i]) = 0; }
                }

                /// Path of the free end.
                output end_x [m] = rod[N].end.x;
                /// Path of the free end.
                output end_y [m] = rod[N].end.y;
                /// Speed of the free end.
                output end_speed [m/s] = speed(rod[N].end);
                /// Force of the hook on the first rod.
                output hook_force [N] = reaction(pin[1]);
            }
        }
    };
}

n_pendulum! {
    /// One rod.
    NPendulum1, 1
}
n_pendulum! {
    /// Two rods.
    NPendulum2, 2
}
n_pendulum! {
    /// Ten rods.
    NPendulum10, 10
}
n_pendulum! {
    /// Forty rods: 120 coordinates, 80 constraints.
    NPendulum40, 40
}
