//! Cam and follower: a disk lifts a rod that a spring presses on it.
//!
//! ```text
//!         ▓▓▓▓▓▓▓  seat
//!           ⌇
//!           ⌇     spring
//!          ┌┴┐
//!          │ │    follower, guided along y
//!          └┬┘
//!          ╭▽─╮   tip, a knife edge
//!        ╭╯    ╰╮
//!        │  o↺  │  cam, driven
//!        ╰──────╯
//! ```
//!
//! In a turn of the cam the follower rises in 120°, dwells up to 180°, returns in
//! 120° and dwells. Rise and return follow the cycloid, through 48 points of which
//! the profile is a spline.
//!
//! Reference: the law itself, s = S f(θ) with f = u − sin(2πu)/(2π), u = θ/120°,
//! along the rise. The contact presses with m(s̈ + g) + F₀ + k s, the drive's
//! torque is that times ds/dθ, and the follower lifts off at the speed for which
//! the force reaches 0. Here nothing leaves the cam: a negative force says that
//! the spring is too weak.

use mbs_runtime::mechanism;

mechanism! {
    /// Disk cam with a translating follower, in line with the cam's centre.
    pub CamFollower {
        dof = 0;
        /// Radius of the cam where the follower is down.
        param base_radius = 25 [mm] where base_radius > 0;
        /// Stroke of the follower.
        param stroke = 10 [mm] where stroke > 0;
        /// Length of the follower.
        param follower_length = 60 [mm] where follower_length > 0;
        /// Mass of the follower.
        param follower_mass = 0.3 [kg] where follower_mass > 0;
        /// Inertia of the cam, balanced.
        param cam_inertia = 1e-4 [kg*m^2] where cam_inertia > 0;
        /// Height of the spring's seat above the cam's centre.
        param seat = 130 [mm] where seat > base_radius + follower_length + stroke;
        /// Stiffness of the spring.
        param stiffness = 4 [N/mm] where stiffness > 0;
        /// Force of the spring where the follower is down.
        param preload = 60 [N] where preload >= 0;
        /// Speed of the cam.
        param omega = 250 [rpm];
        gravity = (0, -9.81) [m/s^2];

        body cam (theta) { inertia = cam_inertia; }
        body follower (y) { mass = follower_mass; }
        point tip on follower = (0, -follower_length/2);
        point head on follower = (0, follower_length/2);
        point seat on ground = (0, seat);

        profile law = spline(
            (0 [deg], 0), (7.5 [deg], cycloidal(1/16)), (15 [deg], cycloidal(2/16)), (22.5 [deg], cycloidal(3/16)),
            (30 [deg], cycloidal(4/16)), (37.5 [deg], cycloidal(5/16)), (45 [deg], cycloidal(6/16)), (52.5 [deg], cycloidal(7/16)),
            (60 [deg], cycloidal(8/16)), (67.5 [deg], cycloidal(9/16)), (75 [deg], cycloidal(10/16)), (82.5 [deg], cycloidal(11/16)),
            (90 [deg], cycloidal(12/16)), (97.5 [deg], cycloidal(13/16)), (105 [deg], cycloidal(14/16)), (112.5 [deg], cycloidal(15/16)),
            (120 [deg], 1), (127.5 [deg], 1), (135 [deg], 1), (142.5 [deg], 1),
            (150 [deg], 1), (157.5 [deg], 1), (165 [deg], 1), (172.5 [deg], 1),
            (180 [deg], 1), (187.5 [deg], 1 - cycloidal(1/16)), (195 [deg], 1 - cycloidal(2/16)), (202.5 [deg], 1 - cycloidal(3/16)),
            (210 [deg], 1 - cycloidal(4/16)), (217.5 [deg], 1 - cycloidal(5/16)), (225 [deg], 1 - cycloidal(6/16)), (232.5 [deg], 1 - cycloidal(7/16)),
            (240 [deg], 1 - cycloidal(8/16)), (247.5 [deg], 1 - cycloidal(9/16)), (255 [deg], 1 - cycloidal(10/16)), (262.5 [deg], 1 - cycloidal(11/16)),
            (270 [deg], 1 - cycloidal(12/16)), (277.5 [deg], 1 - cycloidal(13/16)), (285 [deg], 1 - cycloidal(14/16)), (292.5 [deg], 1 - cycloidal(15/16)),
            (300 [deg], 0), (307.5 [deg], 0), (315 [deg], 0), (322.5 [deg], 0),
            (330 [deg], 0), (337.5 [deg], 0), (345 [deg], 0), (352.5 [deg], 0),
        ) period 360 [deg];
        // the cam turns counter-clockwise, so the tip goes clockwise on it
        cam contact (cam, follower.tip) = base_radius + stroke*law(90 [deg] - angle);
        drive motor: cam.angle = omega*t;
        let room = seat - base_radius - follower_length;
        spring press (follower.head, ground.seat) {
            stiffness = stiffness;
            length = room + preload/stiffness;
        }

        start { guess y = base_radius + follower_length/2; der(theta) = omega; }

        /// Lift of the follower.
        output lift [mm] = follower.tip.y - base_radius;
        /// Force of the cam on the follower; what is negative only glue could do.
        output contact_force [N] = lambda(contact);
        /// Torque that keeps the cam at its speed.
        output drive_torque [N*m] = effort(motor);
    }
}
