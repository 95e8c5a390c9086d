//! Chebyshev's lambda linkage: a turning crank, a nearly straight path.
//!
//! ```text
//!     - - - - - - - - - - - - - - - - - o P  - - -  y = 4 a
//!                                    ···
//!                                 ···
//!                              ···  2.5 a
//!                           ···
//!                        ···
//!                     o··
//!                  ··· B╲
//!               ···      ╲╲
//!            ···           ╲  2.5 a
//!         ···  2.5 a        ╲
//!       ··                   ╲╲
//!    A o────  a                ╲
//!           ─────o──────────────o C
//!                O      2 a
//! ```
//!
//! A, C and P lie on a circle about B, the middle of the coupler A–P, so C sees
//! A–P at a right angle; that gives the path of P in closed form:
//!
//! ```text
//! x = a (2 + w sin θ),  y = a w (2 − cos θ),  w² = (20 + 4 cos θ)/(5 − 4 cos θ)
//! ```
//!
//! Reference: over the half turn about θ = 180° the stroke is 4 a, y is exactly
//! 4 a at both ends and in the middle, and largest where cos θ = −5/8, by
//! (21/8 √(7/3) − 4) a = 0.0097 a. P. L. Chebyshev, "Théorie des mécanismes
//! connus sous le nom de parallélogrammes" (1854), began the theory of such
//! approximations.

use mbs_runtime::mechanism;

mechanism! {
    /// Lambda linkage driven at constant speed.
    pub Chebyshev {
        dof = 0;
        /// Length a of the crank; the other bars follow.
        param crank_length = 40 [mm] where crank_length > 0;
        /// Mass of the bars per length.
        param density = 1 [kg/m] where density > 0;
        /// Speed of the crank.
        param omega = 60 [rpm];
        gravity = (0, -9.81) [m/s^2];
        let arm = 2.5*crank_length;

        body crank (x1, y1, theta) { mass = density*crank_length; inertia = density*crank_length^3/12; }
        body coupler (x2, y2, phi) { mass = density*2*arm; inertia = density*(2*arm)^3/12; }   // centred at B
        body rocker (x3, y3, psi) { mass = density*arm; inertia = density*arm^3/12; }

        point o on crank = (-crank_length/2, 0);
        point a on crank = (crank_length/2, 0);
        point a on coupler = (-arm, 0);
        point p on coupler = (arm, 0);
        point c on rocker = (-arm/2, 0);
        point b on rocker = (arm/2, 0);
        point c on ground = (2*crank_length, 0);

        revolute bearing_o (ground, crank.o);
        revolute pin_a (crank.a, coupler.a);
        revolute pin_b (coupler, rocker.b);
        revolute bearing_c (ground.c, rocker.c);
        drive motor: crank.angle = omega*t;

        start {
            guess phi = 78 [deg]; guess x2 = 60 [mm]; guess y2 = 98 [mm]; guess psi = 102 [deg];
            der(theta) = omega;
        }

        /// Path of P.
        output p_x [mm] = coupler.p.x;
        /// Path of P.
        output p_y [mm] = coupler.p.y;
        /// Deviation from the line y = 4 a; small over the half turn about 180°.
        output deviation [mm] = coupler.p.y - 4*crank_length;
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
    }
}
