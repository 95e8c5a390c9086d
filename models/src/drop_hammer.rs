//! A board drop hammer: rolls that turn all the time grip the board of a ram, lift it and let it fall on an anvil.
//!
//! ```text
//!          │ │
//!     (rolls) (rolls)   turn with the motor
//!          │ │ board
//!        ┌─┴─┴─┐
//!        │ ram │
//!        └─────┘
//!     ───────────────   anvil
//! ```
//!
//! Where the rolls grip, a mode holds: the board goes as fast as they turn. That takes an impulse, which slows the rolls
//! down. At its height the ram is let go. It rises by what speed it has, falls, and bounces until it rests.
//!
//! Reference: the angular momentum of the rolls stays where they grip, ω⁺ = J ω/(J + m r²). While they lift, the torque of
//! the motor falls with the speed, so that ω goes exponentially to where it carries m g r. The blow is that of a fall from the
//! height and v²/(2g) more, and has the impulse (1 + e) m √(2 g h).

use mbs_runtime::mechanism;

mechanism! {
    /// A board drop hammer, whose ram rolls lift and let fall.
    pub DropHammer {
        dof = 2;
        step = 0.5 [ms];
        /// Mass of the ram.
        param mass = 500 [kg] where mass > 0;
        /// Radius of the rolls.
        param radius = 0.15 [m] where radius > 0;
        /// Inertia of rolls and motor.
        param inertia = 20 [kg*m^2] where inertia > 0;
        /// Torque of the motor at rest.
        param stall = 2500 [N*m] where stall >= 0;
        /// Speed of the motor without a load.
        param no_load = 100 [rpm] where no_load > 0;
        /// Height at which the rolls open.
        param height = 1.2 [m] where height > 0;
        /// Depth of the anvil below the rolls.
        param depth = 1.8 [m] where depth > 0;
        /// Restitution of the blow.
        param restitution = 0.3 where restitution >= 0;
        /// Time from blow to blow.
        param period = 3 [s] where period > 0;
        gravity = (0, -9.81) [m/s^2];

        body ram (y) { mass = mass; }
        body rolls (angle = phi) { inertia = inertia; }
        motor drive (rolls, ground) { stall = stall; no_load = no_load; }
        let lift = y + depth;
        stop anvil: lift >= 0 [m] { restitution = restitution; }

        /// 1 while the rolls grip the board.
        mode gripped { rate board: der(y) = radius*der(phi); }
        every period offset 0.5 [s] { enter gripped; }
        when lift > height { leave gripped; }

        point board_end on ram = (0, depth);
        start { y = -depth; der(phi) = no_load; }

        /// Height of the ram.
        output lifted [mm] = lift;
        /// Speed of the rolls.
        output speed [rpm] = der(phi);
        /// Force of the rolls on the board.
        output grip [kN] = -lambda(board);
        /// Sum of the impulses of all blows.
        output blows [N*s] = impulse(anvil);
        /// 1 while the rolls grip the board.
        output gripped = gripped;
    }
}
