//! Planetary gear: the sun drives, the ring is fixed, the arm carries the load.
//!
//! ```text
//!         ring, fixed
//!      ╭───────────────╮
//!      │    ╭─────╮    │   the planet is in mesh with sun and ring,
//!      │    │  o  │    │   its pin is on the arm
//!      │    ╰──│──╯    │
//!      │    ╭──│──╮    │
//!      │    │  o  │    │   sun and arm turn about the centre
//!      │    ╰─────╯    │
//!      ╰───────────────╯
//! ```
//!
//! Reference: R. Willis (1841): (ω_sun − ω_arm)/(ω_ring − ω_arm) = −r_ring/r_sun
//! with r_ring = r_sun + 2 r_planet. So the arm turns i = r_sun/(2a) times the
//! sun, a = r_sun + r_planet, the planet −a/r_planet times the arm, and the sun
//! feels J = J_sun + i² (J_arm + m a² + J_planet (a/r_planet)²).

use mbs_runtime::mechanism;

mechanism! {
    /// Planetary reducer with a planet, in the horizontal plane.
    pub PlanetaryGear {
        dof = 1;
        /// Pitch radius of the sun.
        param sun_radius = 20 [mm] where sun_radius > 0;
        /// Pitch radius of the planet.
        param planet_radius = 30 [mm] where planet_radius > 0;
        /// Inertia of the sun and the motor on it.
        param sun_inertia = 1e-4 [kg*m^2] where sun_inertia > 0;
        /// Inertia of the planet about its pin.
        param planet_inertia = 1e-4 [kg*m^2] where planet_inertia > 0;
        /// Mass of the planet.
        param planet_mass = 0.2 [kg] where planet_mass > 0;
        /// Inertia of the arm and the load on it.
        param arm_inertia = 5e-3 [kg*m^2] where arm_inertia > 0;
        /// Speed of the sun at the start.
        param speed = 300 [rpm];
        /// Torque on the sun.
        input sun_torque [N*m];
        /// Torque of the load on the arm.
        input load [N*m];
        let ring_radius = sun_radius + 2*planet_radius;

        body sun (alpha) { inertia = sun_inertia; }
        body arm (beta) { inertia = arm_inertia; }
        body planet (x, y, psi) { mass = planet_mass; inertia = planet_inertia; }
        point pin on arm = (sun_radius + planet_radius, 0);

        revolute bearing (arm.pin, planet);
        gear inner (sun, planet) radii (sun_radius, planet_radius) carrier arm;
        internal_gear outer (ground, planet) radii (ring_radius, planet_radius) carrier arm;
        torque drive on sun = sun_torque;
        torque load on arm = load;

        start { alpha = 0; der(alpha) = speed; guess x = sun_radius + planet_radius; }

        /// Speed of the sun over that of the arm.
        output ratio [1] = der(alpha)/der(beta);
        /// Tooth force between sun and planet.
        output inner_force [N] = lambda(inner);
        /// Tooth force between ring and planet.
        output outer_force [N] = lambda(outer);
        /// Force on the pin.
        output pin_force [N] = reaction(bearing);
    }
}
