//! Five balls that hang side by side and hit each other.
//!
//! ```text
//!   ─o────o────o────o────o─   nails, 2 radius + play apart
//!    │    │    │    │    │
//!    │    │    │    │    │    length
//!    │    │    │    │    │
//!    ◯    ◯    ◯    ◯    ◯    radius, mass
//!    1    2    3    4    5
//! ```
//!
//! The first ball is lifted and let go. Between the balls is some play, so that one impact follows the other: without loss
//! each ball gives the next one all of its speed and stops, and the last one leaves with the speed of the first one. Each
//! contact is a stop, the distance of two centres. Without play all four contacts are closed at once, and what follows is the
//! law of simultaneous impacts, by which no ball stops.
//!
//! Reference: the last ball swings as a pendulum of the amplitude α, with J = m (l² + 2/5 r²) about its nail. With the
//! arithmetic–geometric mean of Gauss, half a swing takes π √(J/(m g l))/AGM(1, cos(α/2)); the play moves each impact
//! by no more than the time in which it is passed. The energy stays.

use mbs_runtime::mechanism;

mechanism! {
    /// Five balls that hang side by side and hit each other.
    pub NewtonsCradle {
        dof = 5;
        const N = 5;
        /// Length of a string, from its nail to the centre of its ball.
        param length = 0.2 [m] where length > 0;
        /// Radius of a ball.
        param radius = 15 [mm] where radius > 0;
        /// Mass of a ball.
        param mass = 0.1 [kg] where mass > 0;
        /// Play between two balls at rest.
        param play = 0.1 [mm] where play >= 0;
        /// Restitution of an impact.
        param restitution = 1 where restitution >= 0;
        /// Angle to which the first ball is lifted.
        param lifted = 30 [deg];
        gravity = (0, -9.81) [m/s^2];

        for i in 1..=N {
            body ball[i] (x[i], y[i], phi[i]) { mass = mass; inertia = 2/5*mass*radius^2; }
            point hook on ball[i] = (0, length);
            point nail[i] on ground = ((i - 1)*(2*radius + play), 0);
            revolute string[i] (ball[i].hook, ground.nail[i]);
            start { guess x[i] = (i - 1)*(2*radius + play); guess y[i] = -length; }
            if i == 1 {
                start { phi[i] = -lifted; }
            }
        }
        for i in 2..=N {
            stop contact[i]: sqrt((x[i] - x[i-1])^2 + (y[i] - y[i-1])^2) >= 2*radius { restitution = restitution; }
        }
        /// Angle of the first string.
        output first [deg] = phi[1];
        /// Angle of the last string.
        output last [deg] = phi[N];
        /// Force in the first string.
        output tension [N] = reaction(string[1]);
    }
}
