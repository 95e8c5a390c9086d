//! Four-bar linkage, a crank-rocker driven at constant speed.
//!
//! ```text
//!                  P o────────────
//!                   ╱             ─────────── o B
//!                  ╱   coupler         ····   ╲
//!                 ╱               ·····       ╲
//!                ╱            ····             ╲
//!               ╱         ····                 ╲  rocker
//!              ╱     ·····                      ╲
//!             ╱  ····                            ╲
//!          A o···                                ╲
//!           ╱                                     ╲
//!   crank  ╱                                      ╲
//!         ╱  θ2                                 θ4 ╲
//!        ╱                                         ╲
//!     ──o───────────────────────────────────────────o──── x
//!       O                   base                    C
//! ```
//!
//! For coupler curves, transmission angles and the torque of the motor. The
//! conditions on the lengths let the crank turn fully.
//!
//! Reference: the rocker's angle satisfies
//!
//! ```text
//! K1 cos θ4 − K2 cos θ2 + K3 = cos(θ2 − θ4),   K1 = base/crank,   K2 = base/rocker,
//! K3 = (base² + crank² − coupler² + rocker²)/(2 crank rocker)
//! ```
//!
//! (F. Freudenstein, "An analytical approach to the design of four-link
//! mechanisms", Trans. ASME 76, 1954), a quadratic in tan(θ4/2).

use mbs_runtime::mechanism;

mechanism! {
    /// Crank-rocker driven at constant speed.
    pub FourBar {
        dof = 0;
        /// Distance of the ground pivots.
        param base = 100 [mm] where base > 0;
        /// Length of the crank O–A.
        param crank_length = 30 [mm] where crank_length > 0;
        /// Length of the coupler A–B; the bars have to reach when the crank points away.
        param coupler_length = 80 [mm] where coupler_length + rocker_length > base + crank_length;
        /// Length of the rocker C–B; the bars have to fit when the crank points inwards.
        param rocker_length = 70 [mm] where abs(coupler_length - rocker_length) < abs(base - crank_length);
        /// Coupler point P, along A–B from A.
        param along = 40 [mm];
        /// Coupler point P, across A–B.
        param across = 30 [mm];
        /// Mass of the bars per length.
        param density = 2 [kg/m] where density > 0;
        /// Speed of the crank.
        param omega = 120 [rpm];
        gravity = (0, -9.81) [m/s^2];

        body crank (x1, y1, theta2) { mass = density*crank_length; inertia = density*crank_length^3/12; }
        body coupler (x2, y2, theta3) {
            mass = density*coupler_length;
            inertia = density*coupler_length^3/12;
        }
        body rocker (x3, y3, theta4) { mass = density*rocker_length; inertia = density*rocker_length^3/12; }

        point o on crank = (-crank_length/2, 0);
        point a on crank = (crank_length/2, 0);
        point a on coupler = (-coupler_length/2, 0);
        point b on coupler = (coupler_length/2, 0);
        point p on coupler = (along - coupler_length/2, across);
        point c on rocker = (-rocker_length/2, 0);
        point b on rocker = (rocker_length/2, 0);
        point c on ground = (base, 0);

        revolute bearing_o (ground, crank.o);
        revolute pin_a (crank.a, coupler.a);
        revolute pin_b (coupler.b, rocker.b);
        revolute bearing_c (ground.c, rocker.c);
        drive motor: crank.angle = omega*t;

        start { guess theta3 = 50 [deg]; guess theta4 = 110 [deg]; der(theta2) = omega; }

        /// Path of the coupler point.
        output p_x [mm] = coupler.p.x;
        /// Path of the coupler point.
        output p_y [mm] = coupler.p.y;
        /// Angle of the rocker.
        output rocker_angle [deg] = theta4;
        /// Between coupler and rocker at B; a right angle transmits best.
        output transmission_angle [deg] = theta4 - theta3;
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
        /// Force of the ground on the crank.
        output bearing_o_force [N] = sqrt(lambda(bearing_o_x)^2 + lambda(bearing_o_y)^2);
        /// Force of the ground on the rocker.
        output bearing_c_force [N] = sqrt(lambda(bearing_c_x)^2 + lambda(bearing_c_y)^2);
    }
}
