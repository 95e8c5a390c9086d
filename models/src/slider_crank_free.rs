//! Slider-crank with a torque on the crank: the paper's mechanism with its
//! drive removed, one degree of freedom.
//!
//! ```text
//!    crank_torque  o___
//!         l1, m1  /    ‾‾‾‾‾--__  rod l2, m2
//!            ↺   / θ1            ‾‾‾--__  θ2
//!    ───────────o─────────────────────[=o=]──────── x
//!               ground                slider m3
//! ```
//!
//! Constraints and parameters as in [`slider_crank`](crate::slider_crank).
//!
//! Reference value: from 200 rpm at θ1 = 0 with a constant crank torque of
//! 0.5 N·m, θ1(0.3 s) = 5.644159549774 rad (an adaptive 8th-order integration
//! of the one-coordinate equation of motion at tolerance 1e-12).

use mbs_runtime::mechanism;

mechanism! {
    /// Slider-crank with a torque on the crank.
    pub SliderCrankFree {
        dof = 1;
        /// Length of the crank.
        param l1 = 60 [mm] where l1 > 0;
        /// Length of the rod.
        param l2 = 180 [mm] where l2 > 0;
        /// Mass of the crank, at its middle.
        param m1 = 0.5 [kg];
        /// Mass of the rod, at its middle.
        param m2 = 1.2 [kg];
        /// Mass of the slider.
        param m3 = 2.0 [kg];
        /// Moment of inertia of crank and rod about their middles over m l².
        param inertia_factor = 1/12;
        /// Speed of the crank at the start.
        param omega = 200 [rpm];
        /// Torque on the crank.
        input crank_torque [N*m];
        gravity = (0, -9.81) [m/s^2];

        body crank  (x1, y1, theta1) { mass = m1; inertia = inertia_factor*m1*l1^2; }
        body rod    (x2, y2, theta2) { mass = m2; inertia = inertia_factor*m2*l2^2; }
        body slider (x3)             { mass = m3; }
        // for pictures
        point base on crank = (-l1/2, 0);
        point tip on crank = (l1/2, 0);
        point base on rod = (-l2/2, 0);
        point tip on rod = (l2/2, 0);

        torque motor on crank = crank_torque;

        /// The crank turns about the origin.
        constraint crank_x: x1 = l1/2*cos(theta1);
        /// The crank turns about the origin.
        constraint crank_y: y1 = l1/2*sin(theta1);
        /// The rod begins at the crank's tip.
        constraint rod_x: x2 = l1*cos(theta1) + l2/2*cos(theta2);
        /// The rod begins at the crank's tip.
        constraint rod_y: y2 = l1*sin(theta1) + l2/2*sin(theta2);
        /// The rod ends on the x axis.
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = 0;
        /// The slider sits at the rod's end.
        constraint slider: x3 = l1*cos(theta1) + l2*cos(theta2);

        start {
            theta1 = 0;
            guess x1 = l1/2;
            guess x2 = l1 + l2/2;
            guess x3 = l1 + l2;
            der(theta1) = omega;
        }

        /// Speed of the crank.
        output crank_speed [rpm] = der(theta1);
        /// Power of the motor.
        output motor_power [W] = crank_torque*der(theta1);
    }
}
