//! A mobile robot on two driven wheels that neither slip nor slide.
//!
//! ```text
//!        ┌──▭──┐  left wheel, angle α
//!        │     │
//!        │  ●──┼──→ u,  ↺ φ        robot m, J, centre of mass on the axle
//!        │     │
//!        └──▭──┘  right wheel, angle β
//! ```
//!
//! The robot does not move along the axle, and the wheels of radius r at ±b roll:
//!
//! ẏ cos φ − ẋ sin φ = 0,  u − b φ̇ = r α̇,  u + b φ̇ = r β̇,  u = ẋ cos φ + ẏ sin φ.
//!
//! Torques M_l and M_r on the wheels of inertia J_w drive it:
//!
//! (m + 2 J_w/r²) u̇ = (M_l + M_r)/r,  (J + 2 J_w b²/r²) φ̈ = (M_r − M_l) b/r
//!
//! (G. Campion, G. Bastin, B. d'Andréa-Novel, Structural properties and classification of kinematic and dynamic
//! models of wheeled mobile robots, IEEE Transactions on Robotics and Automation 12 (1996) 47-62). Reference: under
//! constant torques u and φ̇ grow as t, and the place is the integral of u (cos φ, sin φ), a spiral of Fresnel's kind.

use mbs_runtime::mechanism;

mechanism! {
    /// Mobile robot on two driven wheels.
    pub DifferentialDrive {
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
        /// Speed at the start.
        param speed = 0.5 [m/s];
        /// Rate at which it turns at the start.
        param turning = 0.8 [rad/s];
        /// Torque on the left wheel.
        input left_torque [N*m];
        /// Torque on the right wheel.
        input right_torque [N*m];

        body robot (x, y, phi) { mass = mass; inertia = inertia; }
        body left (angle = alpha) { inertia = wheel_inertia; }
        body right (angle = beta) { inertia = wheel_inertia; }
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
        torque turn_left on left = left_torque;
        torque turn_right on right = right_torque;

        start { x = 0; y = 0; phi = 0; alpha = 0; beta = 0; der(x) = speed; der(phi) = turning; }
        closes = 0 [s] .. 4 [s];

        /// Speed of the middle of the axle.
        output u [m/s] = along;
        /// Force of the ground along the axle, towards the left wheel.
        output side [N] = -lambda(no_slide);
        /// Power of the motors.
        output power [W] = left_torque*der(alpha) + right_torque*der(beta);
    }
}
