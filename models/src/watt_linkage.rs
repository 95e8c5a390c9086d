//! Watt's linkage: two equal arms and a coupler whose middle goes nearly
//! straight.
//!
//! ```text
//!                  arm    ────o B1
//!         ────────────────     ╲ half
//!     o───                      o M
//!     C1                         ╲ half
//!                                 o────
//!                                 B2   ────────────────
//!                                           arm        ────o C2
//! ```
//!
//! It guides beam engines' piston rods and cars' axles. The middle stays on
//! Watt's curve, in polar coordinates about the middle of C1–C2
//!
//! r² = arm² − (c sin θ ± √(half² − c² cos² θ))²,  c half the distance C1–C2
//!
//! with θ from C1–C2, which follows from the closure of the loop (J. Watt
//! patented the linkage in 1784). Reference: that equation, and the middle at
//! r = 0 where the arms are at right angles to the coupler.

use mbs_runtime::mechanism;

mechanism! {
    /// Watt's linkage, one arm swinging.
    pub WattLinkage {
        dof = 0;
        /// Length of the arms.
        param arm = 0.4 [m] where arm > 0;
        /// Half the length of the coupler.
        param half = 0.1 [m] where half > 0;
        /// Amplitude of the first arm, less than what stretches coupler and other arm.
        param amplitude = 25 [deg] where reach < arm + 2*half;
        /// Angular frequency.
        param omega = 5 [rad/s];
        /// Mass of the bars per length.
        param density = 1 [kg/m] where density > 0;
        gravity = (0, -9.81) [m/s^2];
        // B1–C2 with the first arm at its highest
        let reach = sqrt((2*arm - arm*cos(amplitude))^2 + (2*half + arm*sin(amplitude))^2);

        body arm1    (x1, y1, phi1) { mass = density*arm; inertia = density*arm^3/12; }
        body coupler (x2, y2, phi2) { mass = density*2*half; inertia = density*(2*half)^3/12; }
        body arm2    (x3, y3, phi3) { mass = density*arm; inertia = density*arm^3/12; }

        point c on arm1 = (-arm/2, 0);
        point b on arm1 = (arm/2, 0);
        point b1 on coupler = (0, half);
        point b2 on coupler = (0, -half);
        point b on arm2 = (-arm/2, 0);
        point c on arm2 = (arm/2, 0);
        point c1 on ground = (-arm, half);
        point c2 on ground = (arm, -half);

        revolute bearing1 (ground.c1, arm1.c);
        revolute pin1 (arm1.b, coupler.b1);
        revolute pin2 (coupler.b2, arm2.b);
        revolute bearing2 (arm2.c, ground.c2);
        drive motor: arm1.angle = amplitude*sin(omega*t);

        start { guess x1 = -arm/2; guess y1 = half; guess x3 = arm/2; guess y3 = -half; }

        /// How far the middle is off the vertical line.
        output deviation [mm] = x2;
        /// Height of the middle.
        output height [mm] = y2;
        /// Torque that swings the arm.
        output drive_torque [N*m] = effort(motor);
    }
}
