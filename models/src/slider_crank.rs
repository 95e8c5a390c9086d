//! Slider-crank driven at constant speed: the mechanism of the paper.
//!
//! ```text
//!           crank  o___
//!         l1, m1  /    ‾‾‾‾‾--__  rod l2, m2
//!                / θ1            ‾‾‾--__  θ2
//!    ───────────o─────────────────────[=o=]──────── x
//!               ground                slider m3
//! ```
//!
//! The constraints are Eq. (3) of Jiang, "Dynamic Modeling of Multi-body
//! Systems: A Numerical Study on Crank-slider Mechanism" (2025,
//! doi:10.26855/oajrcap.2025.12.001), row by row; Table 1 has the parameters,
//! Table 2 the start. Angles count counter-clockwise from the x axis, so
//! θ2 ≤ 0 while the crank is above it.
//!
//! Reference values, by an independent dense float64 solution of the paper's
//! equations: θ2 stays within ±0.339836912 rad and x3 within 0.12 … 0.24 m;
//! at 200 rpm the steady peak of the drive torque is 3.3935 N·m (closed form).

use mbs_runtime::mechanism;

mechanism! {
    /// Slider-crank driven at constant speed.
    pub SliderCrank {
        dof = 0;
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
        /// Moment of inertia of crank and rod about their middles over m l²:
        /// 1/12 for slender rods, 0 for point masses. The paper's torques come
        /// out with 1/3.
        param inertia_factor = 1/12;
        /// Speed of the crank.
        param omega = 200 [rpm];
        gravity = (0, -9.81) [m/s^2];

        body crank  (x1, y1, theta1) { mass = m1; inertia = inertia_factor*m1*l1^2; }
        body rod    (x2, y2, theta2) { mass = m2; inertia = inertia_factor*m2*l2^2; }
        body slider (x3)             { mass = m3; }
        // for pictures
        point base on crank = (-l1/2, 0);
        point tip on crank = (l1/2, 0);
        point base on rod = (-l2/2, 0);
        point tip on rod = (l2/2, 0);

        /// The crank turns about the origin.
        constraint crank_x: x1 = l1/2*cos(theta1);
        /// The crank turns about the origin.
        constraint crank_y: y1 = l1/2*sin(theta1);
        /// The crank turns at constant speed.
        drive crank_speed: theta1 = omega*t;
        /// The rod begins at the crank's tip.
        constraint rod_x: x2 = l1*cos(theta1) + l2/2*cos(theta2);
        /// The rod begins at the crank's tip.
        constraint rod_y: y2 = l1*sin(theta1) + l2/2*sin(theta2);
        /// The rod ends on the x axis.
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = 0;
        /// The slider sits at the rod's end.
        constraint slider: x3 = l1*cos(theta1) + l2*cos(theta2);

        start {
            x1 = l1/2;
            x2 = l1 + l2/2;
            x3 = l1 + l2;
            der(theta1) = omega;
        }

        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(crank_speed);
    }
}
