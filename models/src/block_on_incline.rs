//! Block on an incline: dry friction from its own normal reaction.
//!
//! ```text
//!                    ╱
//!            ┌──┐  ╱
//!    push  ↗ │  │╱
//!            └─╱   coefficient of friction
//!            ╱
//!          ╱  slope
//!        o────────── x
//! ```
//!
//! Reference: pushed off with v₀ the block climbs v₀²/(2g(sin α + μ cos α)). It
//! slides down with g(sin α − μ cos α) if tan α > μ. Otherwise it stays, but for
//! the creep of smooth friction, μ tanh(v/v_t) = tan α, at
//! v = v_t artanh(tan α/μ).

use mbs_runtime::mechanism;

mechanism! {
    /// Block that is thrown up a slope.
    pub BlockOnIncline {
        dof = 1;
        /// Mass of the block.
        param mass = 2 [kg] where mass > 0;
        /// Slope of the incline.
        param slope = 30 [deg] where abs(slope) < 90 [deg];
        /// Coefficient of friction.
        param coefficient = 0.3;
        /// Speed below which friction is a damper.
        param transition = 1 [mm/s];
        /// Speed up the slope at the start.
        param speed = 2 [m/s];
        /// Force up the slope.
        input push [N];
        gravity = (0, -9.81) [m/s^2];

        body block (x, y) { mass = mass; }
        point_on_line guide (block, ground) along (cos(slope), sin(slope));
        friction rub (block, ground) along (cos(slope), sin(slope)) {
            coefficient = coefficient;
            normal = reaction(guide);
            transition = transition;
        }
        force push on block = (push*cos(slope), push*sin(slope));
        let way = x*cos(slope) + y*sin(slope);

        start { x = 0; der(x) = speed*cos(slope); }

        /// Distance up the slope.
        output distance [m] = way;
        /// Speed up the slope.
        output rate [m/s] = der(way);
        /// Friction on the block, up the slope.
        output friction [N] = force(rub);
        /// Force of the incline on the block, across the slope.
        output normal [N] = -lambda(guide);
    }
}
