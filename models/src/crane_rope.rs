//! A crane lifts a load from the ground with a rope that is slack at first and goes slack again.
//!
//! ```text
//!   ─────┬───────────────────────────── rail, y = 0
//!      ┌─┴─┐ trolley x_t ──▶ travel
//!      └┬─┬┘
//!       │ │  mast
//!       └┬┘ hook y_h ↑ hoist
//!        )
//!       (   rope: pulls beyond its length, pushes never
//!     ┌──┴──┐
//!     │  m  │ load x, y
//!   ▒▒└─────┘▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒ floor
//! ```
//!
//! The speed of the hook is a trapezoid over the time T, v = hoist/(0.8 T) in its middle. The load stands on the floor
//! until the rope bears it, and then the trolley carries it away. With the stretch s the rope has the tension
//! F = k s + c ṡ where both s and F are positive, else none. The floor gives way by z and pushes by N = k_f z. Below the
//! hook
//!
//! m ÿ = F + N − m g.
//!
//! Reference: all parts of the motion below a hook of constant speed are closed forms. Slack, the load stands still or
//! flies along a parabola. Taut on the floor it is held by both springs and the rope winds up by v t; taut in the air
//!
//! s̈ = g − 2δ ṡ − ω² s,  ω² = k/m,  δ = c/2m.
//!
//! Without damping and on a hard floor the load is lifted where s = g/ω², and the tension rises to m g (1 + v ω/g).
//! Standards know 1 + v ω/g as a dynamic factor of hoisting a grounded load (ISO 8686-1). For v ω > g the rope goes
//! slack afterwards.

use mbs_runtime::mechanism;

mechanism! {
    /// Crane that lifts a load by a rope that goes slack.
    pub CraneRope {
        dof = 2;
        /// Mass of the load.
        param load_mass = 1000 [kg] where load_mass > 0;
        /// Mass of the trolley with its drive.
        param trolley_mass = 400 [kg] where trolley_mass > 0;
        /// Mass of the hook.
        param hook_mass = 50 [kg] where hook_mass > 0;
        /// Length of the rope without force.
        param rope_length = 1.5 [m] where rope_length > 0;
        /// Stiffness of the rope.
        param stiffness = 250 [kN/m] where stiffness >= 0;
        /// Damping of the rope.
        param damping = 1 [kN*s/m] where damping >= 0;
        /// Stiffness of the floor.
        param floor_stiffness = 2500 [kN/m] where floor_stiffness >= 0;
        /// Slack of the rope at the start.
        param slack = 0.3 [m] where slack < rope_length;
        /// Height by which the hook is lifted.
        param hoist = 1.5 [m];
        /// Time in which it is lifted.
        param hoist_time = 2 [s] where hoist_time > 0;
        /// Way of the trolley after that.
        param travel = 3 [m];
        /// Time in which the trolley makes its way; two periods of the swing leave none of it.
        param travel_time = 4.95 [s] where travel_time > 0;
        /// Height of the rail above the middle of the load where that touches the floor.
        param height = 5 [m] where height > rope_length + hoist;
        const g = 9.81 [m/s^2];
        gravity = (0, -g);

        body trolley (x = x_t) { mass = trolley_mass; }
        body hook (x = x_h, y = y_h) { mass = hook_mass; }
        body load (x, y) { mass = load_mass; }

        point_on_line mast (hook, trolley) along (0, 1);
        drive travel: x_t = travel*cycloidal((t - hoist_time - 0.2 [s])/travel_time);
        drive hoist: y_h = rope_length - slack - height + hoist*trapezoidal(t/hoist_time, 0.2);

        rope rope (load, hook) { stiffness = stiffness; length = rope_length; damping = damping; }
        let stretch = distance(load, hook) - rope_length;
        /// The floor pushes only.
        force floor on load = (0, floor_stiffness*max(0, -height - y));

        start { x = 0; y = -height - load_mass*g/(2500 [kN/m]); }
        closes = 0 [s] .. 8 [s];

        /// The rope begins to pull.
        event taut: stretch = 0 rising;
        /// The rope has no tension any more.
        event slack: stiffness*stretch + damping*der(stretch) = 0 falling;
        /// The load leaves the floor.
        event lifted: y = -height rising;

        /// Tension of the rope.
        output tension [kN] = force(rope);
        /// Tension over the weight of the load.
        output dynamic_factor = force(rope)/(load_mass*g);
        /// Stretch of the rope, negative where it is slack.
        output stretch [mm] = stretch;
        /// Force of the floor.
        output floor_force [kN] = floor_stiffness*max(0, -height - y);
        /// Height of the load above the floor.
        output lifted_by [m] = y + height;
        /// Angle of the rope against the vertical.
        output swing [deg] = atan2(x - x_h, y_h - y);
        /// Force of the trolley's drive.
        output drive_force [kN] = effort(travel);
    }
}
