//! Shaper: a crank's pin slides in a lever that moves a ram, slowly forth and
//! quickly back.
//!
//! ```text
//!   tip o─────────   link
//!       ╲         ────────────── o ram ──── tool
//!        ╲                     ═════════
//!        ╲
//!         ╲  lever
//!          ╲
//!      pin  o···  crank
//!           ╲   ···
//!            ╲     o O
//!             ╲    │
//!             ╲    │
//!              ╲   │ offset
//!               ╲  │
//!               ╲ φ│
//!                ╲ │
//!                  o pivot
//! ```
//!
//! Reference: the lever's angle is φ = atan2(r sin θ + offset, r cos θ) for a
//! crank of length r. It stands where the crank is across it, so with
//! sin α = r/offset it swings by 2α, and the strokes' times are as
//! (π + 2α) : (π − 2α). (A crank longer than the offset would turn the lever
//! round: Whitworth's quick return.)

use mbs_runtime::mechanism;

mechanism! {
    /// Crank and slotted lever with a ram.
    pub QuickReturn {
        dof = 0;
        /// Length of the crank; the lever swings only if it is shorter than `offset`.
        param crank_length = 50 [mm] where crank_length > 0;
        /// Distance of the lever's pivot below the crank's centre.
        param offset = 120 [mm] where offset > crank_length;
        /// Length of the lever.
        param lever_length = 280 [mm] where lever_length > offset + crank_length;
        /// Length of the link to the ram.
        param link_length = 150 [mm] where link_length > abs(lever_length - offset - ram_height);
        /// Height of the ram above the crank's centre, near the lever's tip.
        param ram_height = 140 [mm];
        /// Inertia of the crank with its wheel, balanced.
        param crank_inertia = 0.05 [kg*m^2] where crank_inertia > 0;
        /// Mass of the lever.
        param lever_mass = 3 [kg] where lever_mass > 0;
        /// Mass of the ram.
        param ram_mass = 8 [kg] where ram_mass > 0;
        /// Speed of the crank.
        param omega = 60 [rpm];
        /// Force of the work on the tool.
        input cutting_force [N];
        gravity = (0, -9.81) [m/s^2];

        body crank (theta) { inertia = crank_inertia; }
        body lever (x2, y2, phi) { mass = lever_mass; inertia = lever_mass*lever_length^2/12; }
        body ram (x3) { mass = ram_mass; }

        point pin on crank = (crank_length, 0);
        point foot on lever = (-lever_length/2, 0);
        point tip on lever = (lever_length/2, 0);
        point joint on ram = (0, ram_height);
        point pivot on ground = (0, -offset);

        revolute pivot (ground.pivot, lever.foot);
        pin_slot slot (crank.pin, lever) along (1, 0);
        distance link (lever.tip, ram.joint) = link_length;
        drive motor: crank.angle = omega*t;
        force work on ram = (cutting_force, 0);

        start { guess phi = 67 [deg]; guess y2 = 10 [mm]; guess x3 = 250 [mm]; }

        /// Position of the ram.
        output ram_position [mm] = ram.joint.x;
        /// Speed of the ram.
        output ram_speed [m/s] = der(x3);
        /// Angle of the lever from the horizontal.
        output lever_angle [deg] = lever.angle;
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
        /// Force between the crank's pin and the slot, on the lever.
        output pin_force [N] = lambda(slot);
    }
}
