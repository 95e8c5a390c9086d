//! Toggle press: a small force on the knee, a large one under the ram.
//!
//! ```text
//!     ─────o O
//!          │╲
//!          │α╲ link
//!          │  ╲
//!          │   o◀──── actuator
//!          │  ╱ knee
//!          │ ╱ link
//!          │╱
//!        ┌─o─┐
//!        │ram│  ▲ work
//! ```
//!
//! The actuator moves the knee sideways, out and in again.
//!
//! Reference: with links of length l at the angle α from the line, the ram
//! stands at −2 l cos α, so it travels 2 l (1 − cos α), and in slow motion the
//! forces are as work/actuator = 1/(2 tan α), without bound near the toggle.

use mbs_runtime::mechanism;

mechanism! {
    /// Toggle press, its knee driven.
    pub TogglePress {
        dof = 0;
        /// Length of either link.
        param link = 0.3 [m] where link > 0;
        /// The knee's distance from the line, at its least.
        param nearest = 10 [mm] where nearest > 0;
        /// And at its most.
        param farthest = 150 [mm] where farthest < link;
        /// Angular frequency of the actuator.
        param omega = 3 [rad/s];
        /// Mass of either link.
        param link_mass = 4 [kg] where link_mass > 0;
        /// Mass of the ram.
        param ram_mass = 20 [kg] where ram_mass > 0;
        /// Force of the work on the ram, upwards.
        input work [N];

        body upper (x1, y1, phi1) { mass = link_mass; inertia = link_mass*link^2/12; }
        body lower (x2, y2, phi2) { mass = link_mass; inertia = link_mass*link^2/12; }
        body ram (y3) { mass = ram_mass; }

        // at angle 0 a link hangs
        point top on upper = (0, link/2);
        point knee on upper = (0, -link/2);
        point knee on lower = (0, link/2);
        point foot on lower = (0, -link/2);
        revolute bearing (ground, upper.top);
        revolute knee (upper.knee, lower.knee);
        revolute foot (lower.foot, ram);
        drive actuator:
            upper.knee.x = (farthest + nearest)/2 + (farthest - nearest)/2*cos(omega*t);
        force work on ram = (0, work);

        start {
            guess x1 = farthest/2; guess y1 = -link/2; guess phi1 = 30 [deg];
            guess x2 = farthest/2; guess y2 = -1.5*link; guess phi2 = -30 [deg];
            guess y3 = -1.7*link;
        }

        /// Angle of the links from the line.
        output toggle_angle [deg] = phi1;
        /// How far the ram is from where the links are straight.
        output ram_travel [mm] = 2*link + y3;
        /// Force of the actuator on the knee.
        output actuator_force [N] = effort(actuator);
        /// Ram force over actuator force, in slow motion.
        output amplification = 1/(2*tan(phi1));
    }
}
