//! Peaucellier's cell: the first linkage that draws an exact straight line.
//!
//! ```text
//!                                    o A
//!                                ···╱ ···
//!                             ···   ╱    ···  side
//!             long         ···     ╱        ···
//!                       ···       ╱            ···
//!                    ···         ╱               ·· o P
//!                 ···           ╱                  ╱┆
//!              ···          D ·o··                ╱ ┆ line
//!           ···          ····     ···            ╱  ┆
//!        ···         ····            ···        ╱   ┆
//!     o··          o·                   ···    ╱    ┆
//!    O  ─────────  hub                     ···╱     ┆
//!                ───────────────────────────── o B  ┆
//!                       long
//! ```
//!
//! O, D and P stay on a ray with OD·OP = long² − side², an inversion; D goes
//! round a circle through O, so P goes along a straight line (A. B. Kempe, How
//! to Draw a Straight Line, 1877).
//!
//! Reference: P stays on x = (long² − side²)/(2 r), and y = x tan(α/2) for a
//! crank at the angle α.

use mbs_runtime::mechanism;

mechanism! {
    /// Peaucellier's straight-line linkage, its crank swinging.
    pub Peaucellier {
        dof = 0;
        /// Length of the two long bars.
        param long = 0.3 [m] where long > side;
        /// Length of the four sides of the rhombus.
        param side = 0.15 [m] where side > 0;
        /// Length of the crank and distance of its hub from O.
        param radius = 0.1 [m] where radius > 0;
        /// Amplitude of the crank, less than what stretches the cell flat.
        param amplitude = 60 [deg] where 2*radius*cos(amplitude/2) > long - side;
        /// Angular frequency of the crank.
        param omega = 3 [rad/s];
        /// Mass of a joint; the bars count as massless.
        param joint_mass = 0.2 [kg] where joint_mass > 0;
        gravity = (0, -9.81) [m/s^2];

        body crank (xd, yd, alpha) { mass = joint_mass; inertia = joint_mass*radius^2/3; }   // centred at D
        body a (xa, ya) { mass = joint_mass; }
        body b (xb, yb) { mass = joint_mass; }
        body p (xp, yp) { mass = joint_mass; }
        point hub on crank = (-radius, 0);
        point hub on ground = (radius, 0);

        revolute hub (ground.hub, crank.hub);
        distance long_a (a, ground) = long;
        distance long_b (b, ground) = long;
        distance near_a (a, crank) = side;
        distance near_b (b, crank) = side;
        distance far_a (p, a) = side;
        distance far_b (p, b) = side;
        drive motor: crank.angle = amplitude*sin(omega*t);

        start {
            guess xd = 2*radius; guess xp = 0.34 [m];
            guess xa = 0.27 [m]; guess ya = 0.13 [m]; guess xb = 0.27 [m]; guess yb = -0.13 [m];
        }

        /// Deviation of P from the line.
        output deviation [m] = xp - (long^2 - side^2)/(2*radius);
        /// Torque that moves the crank.
        output drive_torque [N*m] = effort(motor);
        /// Tension of the upper long bar.
        output tension_a [N] = lambda(long_a);
    }
}
