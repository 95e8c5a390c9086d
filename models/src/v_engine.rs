//! V engine: two slider-cranks on one crank pin.
//!
//! ```text
//!    [2]                                        [1]  pistons
//!       o                                      o
//!        ···              V angle           ···
//!           ···                          ···
//!              ···                    ···
//!           rod   ···              ···  rod
//!                    ···        ···
//!                       ···  ···
//!                           o pin
//!                            ╲  r
//!                             ╲
//!                              o O, θ from x
//! ```
//!
//! Reference: along a bore at the angle β (90° ∓ half the V angle) a piston
//! stands at s = r cos(θ − β) + √(l² − r² sin²(θ − β)) from the crank's centre,
//! for a crank of length r and a rod of length l.

use mbs_runtime::mechanism;

mechanism! {
    /// Two cylinders of a V engine at constant speed.
    pub VEngine {
        dof = 0;
        /// Length of the crank.
        param crank_length = 40 [mm] where crank_length > 0;
        /// Length of the rods.
        param rod_length = 130 [mm] where rod_length > crank_length;
        /// Angle between the bores.
        param v_angle = 90 [deg];
        /// Inertia of the crankshaft, balanced.
        param crank_inertia = 0.02 [kg*m^2] where crank_inertia > 0;
        /// Mass of a rod.
        param rod_mass = 0.5 [kg] where rod_mass > 0;
        /// Mass of a piston.
        param piston_mass = 0.4 [kg] where piston_mass > 0;
        /// Speed of the crank.
        param omega = 600 [rpm];
        /// Gas force on piston 1, towards the crank.
        input gas1 [N];
        /// Gas force on piston 2, towards the crank.
        input gas2 [N];
        gravity = (0, -9.81) [m/s^2];
        let c1 = cos(pi/2 - v_angle/2);
        let s1 = sin(pi/2 - v_angle/2);
        let c2 = cos(pi/2 + v_angle/2);
        let s2 = sin(pi/2 + v_angle/2);

        body crank (theta) { inertia = crank_inertia; }
        body rod1 (x1, y1, phi1) { mass = rod_mass; inertia = rod_mass*rod_length^2/12; }
        body rod2 (x2, y2, phi2) { mass = rod_mass; inertia = rod_mass*rod_length^2/12; }
        body piston1 (x3, y3) { mass = piston_mass; }
        body piston2 (x4, y4) { mass = piston_mass; }

        point pin on crank = (crank_length, 0);
        point big on rod1 = (-rod_length/2, 0);
        point small on rod1 = (rod_length/2, 0);
        point big on rod2 = (-rod_length/2, 0);
        point small on rod2 = (rod_length/2, 0);
        revolute pin1 (crank.pin, rod1.big);
        revolute pin2 (crank.pin, rod2.big);
        revolute wrist1 (rod1.small, piston1);
        revolute wrist2 (rod2.small, piston2);
        point_on_line bore1 (piston1, ground) along (c1, s1);
        point_on_line bore2 (piston2, ground) along (c2, s2);
        drive speed: crank.angle = omega*t;
        force gas1 on piston1 = (-gas1*c1, -gas1*s1);
        force gas2 on piston2 = (-gas2*c2, -gas2*s2);

        start {
            der(theta) = omega;
            guess phi1 = pi/2 - v_angle/2; guess phi2 = pi/2 + v_angle/2;
            guess x3 = rod_length*c1; guess y3 = rod_length*s1;
            guess x4 = rod_length*c2; guess y4 = rod_length*s2;
        }

        /// Piston 1 from the crank's centre, along its bore.
        output piston1_position [mm] = x3*c1 + y3*s1;
        /// Piston 2 from the crank's centre, along its bore.
        output piston2_position [mm] = x4*c2 + y4*s2;
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(speed);
        /// Side force of piston 1 on its bore.
        output side_force1 [N] = lambda(bore1);
        /// Side force of piston 2 on its bore.
        output side_force2 [N] = lambda(bore2);
    }
}
