//! Tipper: a bed tilted by a hydraulic cylinder of barrel and rod.
//!
//! ```text
//!                            ╱
//!                      bed ╱
//!                        ╱
//!                  lug o
//!                    ╱╱
//!                  ╱ ║ rod
//!                ╱  ┃┃
//!              ╱ φ  ┃┃ barrel
//!    hinge   o ─────┃┃──── x
//!                   ┃┃
//!                    o foot
//! ```
//!
//! The rod slides in the barrel without turning in it: a prismatic joint between
//! two moving bodies. The drive sets the distance of foot and lug; its effort is
//! the force of the oil.
//!
//! Reference: with the foot in the distance a from the hinge, γ below the x
//! axis, and the lug in the distance b, a cylinder of length s tilts the bed by
//! φ = arccos((a² + b² − s²)/(2ab)) − γ.

use mbs_runtime::mechanism;

mechanism! {
    /// Bed of a tipper, its cylinder driven out and in.
    pub Tipper {
        dof = 0;
        /// Foot of the cylinder, from the hinge.
        param foot_x = 1.2 [m];
        /// Foot of the cylinder, below the hinge.
        param foot_depth = 0.6 [m];
        /// Lug of the cylinder on the bed, from the hinge.
        param lug = 2 [m] where lug > 0;
        /// Length of the bed.
        param bed_length = 4 [m] where bed_length > 0;
        /// Mass of the bed with its load, at its middle.
        param bed_mass = 5000 [kg] where bed_mass > 0;
        /// Length of barrel and rod each.
        param part = 0.9 [m] where part > 0;
        /// Mass of barrel and rod each.
        param part_mass = 60 [kg] where part_mass > 0;
        /// Distance of foot and lug at its least.
        param shortest = 1 [m] where shortest < longest;
        /// And at its most.
        param longest = 1.7 [m] where longest < lug + sqrt(foot_x^2 + foot_depth^2);
        /// Angular frequency of the motion out and in.
        param omega = 0.5 [rad/s];
        gravity = (0, -9.81) [m/s^2];

        body bed (x1, y1, phi) { mass = bed_mass; inertia = bed_mass*bed_length^2/12; }
        body barrel (x2, y2, psi1) { mass = part_mass; inertia = part_mass*part^2/12; }
        body rod (x3, y3, psi2) { mass = part_mass; inertia = part_mass*part^2/12; }

        point hinge on bed = (-bed_length/2, 0);
        point lug on bed = (lug - bed_length/2, 0);
        point foot on barrel = (-part/2, 0);
        point eye on rod = (part/2, 0);
        point foot on ground = (foot_x, -foot_depth);

        revolute hinge (ground, bed.hinge);
        revolute foot (ground.foot, barrel.foot);
        revolute eye (rod.eye, bed.lug);
        prismatic cylinder (rod, barrel) along (1, 0) at 0;

        let length = sqrt((rod.eye.x - foot_x)^2 + (rod.eye.y + foot_depth)^2);
        drive oil: length = (shortest + longest)/2 - (longest - shortest)/2*cos(omega*t);

        start {
            guess x1 = bed_length/2;
            guess x2 = 1.5 [m]; guess y2 = -0.3 [m]; guess psi1 = 37 [deg];
            guess x3 = 1.6 [m]; guess y3 = -0.2 [m]; guess psi2 = 37 [deg];
        }

        /// Tilt of the bed.
        output tilt [deg] = phi;
        /// Force of the oil on the rod.
        output oil_force [kN] = effort(oil);
        /// Torque that barrel and rod exert on each other, which bends them.
        output bending [N*m] = lambda(cylinder_angle);
    }
}
