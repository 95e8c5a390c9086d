//! Four-bar linkage under gravity with a torque on its crank.
//!
//! ```text
//!                     coupler   B
//!          A o──────────────────o
//!     crank ╱  ↺ crank_torque    ╲ rocker
//!     ─────o──────────────────────o──── x
//!          O         base         C
//! ```
//!
//! The linkage of [`four_bar`](crate::four_bar) without its drive: one degree of
//! freedom, a torque that the embedding program sets.
//!
//! Reference: without a torque the energy stays, and with one degree of freedom
//! that alone gives the crank's speed in any position: ½ J(θ2) θ̇2² + V(θ2) = E,
//! J being twice the kinetic energy at unit speed.

use mbs_runtime::mechanism;

mechanism! {
    /// Crank-rocker with a torque on the crank.
    pub FourBarFree {
        dof = 1;
        /// Distance of the ground pivots.
        param base = 100 [mm] where base > 0;
        /// Length of the crank O–A.
        param crank_length = 30 [mm] where crank_length > 0;
        /// Length of the coupler A–B; the bars have to reach when the crank points away.
        param coupler_length = 80 [mm] where coupler_length + rocker_length > base + crank_length;
        /// Length of the rocker C–B; the bars have to fit when the crank points inwards.
        param rocker_length = 70 [mm] where abs(coupler_length - rocker_length) < abs(base - crank_length);
        /// Mass of the bars per length.
        param density = 2 [kg/m] where density > 0;
        /// Speed of the crank at the start.
        param omega = 120 [rpm];
        /// Torque on the crank.
        input crank_torque [N*m];
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
        point c on rocker = (-rocker_length/2, 0);
        point b on rocker = (rocker_length/2, 0);
        point c on ground = (base, 0);

        revolute bearing_o (ground, crank.o);
        revolute pin_a (crank.a, coupler.a);
        revolute pin_b (coupler.b, rocker.b);
        revolute bearing_c (ground.c, rocker.c);
        torque motor on crank = crank_torque;

        start { theta2 = 0; der(theta2) = omega; guess theta3 = 50 [deg]; guess theta4 = 110 [deg]; }

        /// Speed of the crank.
        output crank_speed [rpm] = der(theta2);
        /// Angle of the rocker.
        output rocker_angle [deg] = theta4;
        /// Power of the motor.
        output motor_power [W] = crank_torque*der(theta2);
    }
}
