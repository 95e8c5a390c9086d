//! Geneva wheel while its pin is in the slot.
//!
//! ```text
//!                o pin
//!            a  ╱  ‾‾══__  slot
//!              ╱        ‾‾══__
//!             ╱ α        φ    ‾‾══__
//!     ───────o──────────────────────o──── x
//!            O                      C  wheel
//!            │← distance_of_shafts →│
//! ```
//!
//! A wheel with n slots steps by one while the crank turns by π − 2π/n; for a
//! tangential entry the crank has the length a = distance_of_shafts·sin(π/n). The motion
//! begins at the entry. After the exit a real wheel rests on its lock, here the
//! pin stays in the slot, as in an inverted slider-crank.
//!
//! Reference: φ = −atan2(a sin α, distance_of_shafts − a cos α), so the wheel's
//! rate is 0 at entry and exit and −ω sin(π/n)/(1 − sin(π/n)) in the middle.

use mbs_runtime::mechanism;

mechanism! {
    /// Pin of a crank in a slot of a wheel.
    pub GenevaPinSlot {
        dof = 0;
        /// Distance of the shafts.
        param distance_of_shafts = 80 [mm] where distance_of_shafts > 0;
        /// Number of slots.
        param slots = 6 where slots > 2;
        /// Inertia of the crank, balanced.
        param crank_inertia = 1e-3 [kg*m^2] where crank_inertia > 0;
        /// Inertia of the wheel.
        param wheel_inertia = 5e-4 [kg*m^2] where wheel_inertia > 0;
        /// Mass of the wheel.
        param wheel_mass = 0.4 [kg] where wheel_mass > 0;
        /// Friction torque of the wheel per rate.
        param friction = 2e-3 [N*m*s] where friction >= 0;
        /// Speed of the crank.
        param omega = 60 [rpm];
        let arm = distance_of_shafts*sin(pi/slots);
        let entry = pi/2 - pi/slots;

        body crank (alpha) { inertia = crank_inertia; }
        body wheel (x, y, phi) { mass = wheel_mass; inertia = wheel_inertia; }
        point pin on crank = (arm, 0);
        point shaft on ground = (distance_of_shafts, 0);

        revolute shaft (ground.shaft, wheel);
        pin_slot slot (crank.pin, wheel) along (1, 0);
        drive motor: crank.angle = omega*t - entry;
        torque friction on wheel = -friction*der(phi);

        start { guess alpha = -entry; guess x = distance_of_shafts; guess phi = pi/slots; }

        /// Angle of the wheel.
        output wheel_angle [deg] = wheel.angle;
        /// Speed of the wheel.
        output wheel_speed [rpm] = der(phi);
        /// Distance of the pin from the wheel's shaft.
        output pin_radius [mm] = sqrt((crank.pin.x - x)^2 + crank.pin.y^2);
        /// Force of the pin on the wheel, across the slot.
        output pin_force [N] = lambda(slot);
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
    }
}
