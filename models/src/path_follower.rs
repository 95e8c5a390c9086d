//! A mobile robot that follows a circle by two sampled controllers, one within the other.
//!
//! ```text
//!                  every 20 ms                        every 2 ms
//!  circle ──▶ place and heading ──▶ wheel speeds ──▶ speed of each wheel ──▶ torques ──▶ robot
//!               ▲                                       ▲                                  │
//!               └───────────── x, y, φ ─────────────────┴─────────────── α̇, β̇ ────────────┘
//! ```
//!
//! The robot is that of `differential_drive.rs`. The outer controller measures place and heading. The error in the frame
//! of the robot is (a, b, c): behind the wanted place, right of it, and turned from it. It wants the speed and the
//! turning
//!
//! u = u_r cos c + k_a a,  ω = ω_r + u_r (k_b b + k_c sin c)
//!
//! (Y. Kanayama, Y. Kimura, F. Miyazaki, T. Noguchi, A stable tracking control method for an autonomous mobile robot,
//! IEEE International Conference on Robotics and Automation 1990, 384-389). The inner controllers are proportional and
//! integral. Both are as in firmware: at 20 ms and its multiples the outer one acts first.
//!
//! Reference: the two equations of motion of u and φ̇ with their place by the method of Runge and Kutta, from sample to
//! sample.

use mbs_runtime::mechanism;

mechanism! {
    /// Mobile robot that follows a circle by two sampled controllers.
    pub PathFollower {
        dof = 2;
        /// Mass of the robot with its wheels.
        param mass = 8 [kg] where mass > 0;
        /// Its moment of inertia about the middle of the axle.
        param inertia = 0.12 [kg*m^2] where inertia > 0;
        /// Moment of inertia of a wheel about its axle.
        param wheel_inertia = 0.004 [kg*m^2] where wheel_inertia >= 0;
        /// Radius of a wheel.
        param radius = 75 [mm] where radius > 0;
        /// Half the distance of the wheels.
        param half_track = 0.18 [m] where half_track > 0;
        /// Radius of the circle.
        param circle = 1 [m] where circle > 0;
        /// Speed along the circle.
        param speed = 0.6 [m/s];
        /// Where the robot starts, beside the circle.
        param beside = 0.2 [m];
        /// Speed at the start.
        param rolling = 0.2 [m/s];
        /// Share of the motors' torques that acts: 1, or 0 without them.
        param motors = 1 where motors >= 0;
        /// Time between two samples of the speeds.
        param fast = 2 [ms] where fast > 0;
        /// Time between two samples of the place.
        param slow = 20 [ms] where slow > 0;
        /// Stiffness of a wheel's speed controller.
        param stiffness = 0.15 [N*m*s] where stiffness >= 0;
        /// Its share of the integral.
        param integral = 1.5 [N*m] where integral >= 0;

        /// Speed that the left wheel is to have.
        memory left_wanted [rad/s] = 0;
        /// Speed that the right wheel is to have.
        memory right_wanted [rad/s] = 0;
        /// Angle by which the left wheel lags.
        memory left_lag [rad] = 0;
        /// Angle by which the right wheel lags.
        memory right_lag [rad] = 0;
        /// Torque of the left motor.
        memory left_torque [N*m] = 0;
        /// Torque of the right motor.
        memory right_torque [N*m] = 0;

        // where the robot is to be, and the error in its own frame
        let turned = speed/circle*t;
        let away_x = circle*sin(turned) - x;
        let away_y = circle*(1 - cos(turned)) - y;
        let behind = away_x*cos(phi) + away_y*sin(phi);
        let right = away_y*cos(phi) - away_x*sin(phi);
        let off = turned - phi;
        let u = speed*cos(off) + 2 [1/s]*behind;
        let omega = speed/circle + speed*(6 [1/m^2]*right + 3 [1/m]*sin(off));

        every slow {
            set left_wanted = (u - half_track*omega)/radius;
            set right_wanted = (u + half_track*omega)/radius;
        }
        every fast {
            // while a motor is at its limit, nothing is summed up
            set left_lag = if abs(left_torque) < 1 [N*m] { left_lag + fast*(left_wanted - der(alpha)) } else { left_lag };
            set right_lag = if abs(right_torque) < 1 [N*m] { right_lag + fast*(right_wanted - der(beta)) } else { right_lag };
            set left_torque = clamp(stiffness*(left_wanted - der(alpha)) + integral*left_lag, -1 [N*m], 1 [N*m]);
            set right_torque = clamp(stiffness*(right_wanted - der(beta)) + integral*right_lag, -1 [N*m], 1 [N*m]);
        }

        body robot (x, y, phi) { mass = mass; inertia = inertia; }
        body left (angle = alpha) { inertia = wheel_inertia; }
        body right_wheel (angle = beta) { inertia = wheel_inertia; }
        // for pictures
        point left_hub on robot = (0, half_track);
        point right_hub on robot = (0, -half_track);
        point nose on robot = (half_track, 0);

        let along = der(x)*cos(phi) + der(y)*sin(phi);
        /// The wheels do not slide along the axle.
        rate no_slide: der(y)*cos(phi) = der(x)*sin(phi);
        /// The left wheel rolls.
        rate roll_left: along - half_track*der(phi) = radius*der(alpha);
        /// The right wheel rolls.
        rate roll_right: along + half_track*der(phi) = radius*der(beta);
        torque turn_left on left = motors*left_torque;
        torque turn_right on right_wheel = motors*right_torque;

        start { x = 0; y = beside; phi = 0; alpha = 0; beta = 0; der(x) = rolling; der(phi) = 0; }

        /// Distance of the robot from the circle, outside of it positive.
        output deviation [mm] = sqrt(x^2 + (y - circle)^2) - circle;
        /// Torque of the left motor.
        output left_effort [N*m] = motors*left_torque;
        /// Torque of the right motor.
        output right_effort [N*m] = motors*right_torque;
    }
}
