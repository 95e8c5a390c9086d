//! Klann's leg: six bars and a crank make a foot walk.
//!
//! ```text
//!                               K o──────
//!                            ····        ─────── o A
//!                         ····
//!                      ···  ··
//!                   ···   ··
//!             E  ···    ··
//!             o ──────────────
//!            ╱     ··  ───── o ───────────── o ────── o
//!           ╱    ··         C    ─── o B      M        O
//!          ╱   ··
//!         ╱  ··            crank O–M, rockers B–C and A–K,
//!        ╱ ··              coupler M–C–E, leg E–K–foot
//!       ╱··
//!      ╱·
//!     o foot
//! ```
//!
//! The proportions are those of U.S. patent 6,260,862 (J. Klann, Walking
//! device, 2001), here in units of `size`; the position shown there, with the
//! crank at 180°, is O (1.599, 0.750), M (1.331, 0.750), C (0.741, 0.750),
//! B (1.009, 0.574), E (0.232, 0.866), K (0.866, 1.500), A (1.366, 1.366), foot
//! (0, 0). The bars count as massless, the joints as point masses.
//!
//! Reference: every joint is the intersection of two circles, in the order C,
//! E, K, foot.

use mbs_runtime::mechanism;

mechanism! {
    /// One leg of a walking device, its crank driven at constant speed.
    pub Klann {
        dof = 0;
        /// The patent's unit of length.
        param size = 0.3 [m] where size > 0;
        /// Mass of a joint.
        param joint_mass = 0.1 [kg] where joint_mass > 0;
        /// Inertia of the crank, balanced.
        param crank_inertia = 0.01 [kg*m^2] where crank_inertia > 0;
        /// Speed of the crank.
        param omega = 30 [rpm];
        /// Upward force of the ground on the foot.
        input support [N];
        gravity = (0, -9.81) [m/s^2];

        body crank (theta) { inertia = crank_inertia; }
        body c (xc, yc) { mass = joint_mass; }
        body e (xe, ye) { mass = joint_mass; }
        body k (xk, yk) { mass = joint_mass; }
        body foot (xf, yf) { mass = joint_mass; }
        // the origin is at O
        point m on crank = (0.268*size, 0);
        point a on ground = (-0.233*size, 0.616*size);
        point b on ground = (-0.590*size, -0.176*size);

        distance rocker_b (c, ground.b) = size*sqrt(0.268^2 + 0.176^2);
        distance coupler_mc (c, crank.m) = 0.59*size;
        distance coupler_ce (e, c) = size*sqrt(0.509^2 + 0.116^2);
        distance coupler_me (e, crank.m) = size*sqrt(1.099^2 + 0.116^2);
        distance rocker_a (k, ground.a) = size*sqrt(0.5^2 + 0.134^2);
        distance knee (k, e) = size*sqrt(0.634^2 + 0.634^2);
        distance shin (foot, e) = size*sqrt(0.232^2 + 0.866^2);
        distance leg (foot, k) = size*sqrt(0.866^2 + 1.5^2);
        drive motor: crank.angle = pi + omega*t;
        force support on foot = (0, support);

        start {
            guess theta = pi;
            guess xc = -0.858*size; guess yc = 0;
            guess xe = -1.367*size; guess ye = 0.116*size;
            guess xk = -0.733*size; guess yk = 0.75*size;
            guess xf = -1.599*size; guess yf = -0.75*size;
            der(theta) = omega;
        }

        /// Tension between crank and the coupler's far end.
        output tension_me [N] = lambda(coupler_me);
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
    }
}
