//! A four-stroke engine with one cylinder, its gas pressure by an indicator diagram, from the first turn of its
//! starter.
//!
//! ```text
//!      ║ p, A ║  gas
//!      ║▓▓▓▓▓▓║  piston m_p, y
//!      ║  o   ║
//!      ║   ╲  ║
//!           ╲  rod l, m_r
//!            ╲
//!             o
//!            ╱  crank r, θ from the top, J with the flywheel
//!           o ↺
//! ```
//!
//! The pressure is a table of the crank's angle over the two turns of a cycle: inlet, compression, combustion and
//! outlet. Its points are made up, as a small petrol engine with a compression ratio of 8 might have them at full
//! load: compression from 0.9 bar with the exponent 1.32, a peak of 36 bar 15° behind the top, expansion with 1.3
//! (J. B. Heywood, Internal Combustion Engine Fundamentals, McGraw-Hill 1988, has measured ones). Below the piston the
//! air has 1 bar. The engine fires from its first cycle on.
//!
//! The starter turns the crank by a torque that falls with the speed, through a freewheel. Bearings brake by c ω, and
//! the load by k ω², as a fan does.
//!
//! Reference: with s(θ) = r cos θ + √(l² − r² sin² θ), the height of the piston, the gas turns the crank by the torque
//! M = −(p − p_0) A ds/dθ, and the motion is that of Lagrange's equation in θ,
//!
//! I θ̈ + ½ I′ θ̇² + V′ = M + M_s − c θ̇ − k θ̇ |θ̇|,
//!
//! I the inertia that the masses have at θ. The work of a cycle is the area of the diagram over the volume,
//! ∮ p dV = A ∮ p ds.

use mbs_runtime::mechanism;

mechanism! {
    /// Four-stroke engine with one cylinder, started from rest.
    pub Engine {
        dof = 1;
        /// Length of the crank, half of the stroke.
        param crank_length = 30 [mm] where crank_length > 0;
        /// Length of the rod.
        param rod_length = 110 [mm] where rod_length > crank_length;
        /// Diameter of the piston.
        param bore = 70 [mm] where bore > 0;
        /// Mass of the piston.
        param piston_mass = 0.35 [kg] where piston_mass > 0;
        /// Mass of the rod.
        param rod_mass = 0.4 [kg] where rod_mass > 0;
        /// Inertia of crankshaft and flywheel, balanced.
        param inertia = 0.15 [kg*m^2] where inertia > 0;
        /// Share of the gas pressure that acts.
        param gas = 1 where gas >= 0;
        /// Torque of the starter at rest.
        param starter = 40 [N*m] where starter >= 0;
        /// Speed at which the starter has no torque.
        param starter_speed = 400 [rpm] where starter_speed > 0;
        /// Viscous friction of the bearings.
        param viscous = 0.01 [N*m*s] where viscous >= 0;
        /// Torque of the load over the square of the speed.
        param load = 3e-4 [N*m*s^2] where load >= 0;
        gravity = (0, -9.81) [m/s^2];

        body crank (angle = theta) { inertia = inertia; }
        body rod (x, y, phi) { mass = rod_mass; inertia = rod_mass*rod_length^2/12; }
        body piston (y = y_p) { mass = piston_mass; }
        point pin on crank = (0, crank_length);
        point big on rod = (0, -rod_length/2);
        point small on rod = (0, rod_length/2);
        // for pictures
        point left_web on crank = (-0.7*crank_length, -0.7*crank_length);
        point right_web on crank = (0.7*crank_length, -0.7*crank_length);
        revolute crank_pin (crank.pin, rod.big);
        revolute piston_pin (rod.small, piston);

        table pressure(angle) = [
            (0 [deg], 1.1 [bar]), (30 [deg], 0.9 [bar]), (180 [deg], 0.9 [bar]),
            // compression
            (210 [deg], 0.95 [bar]), (240 [deg], 1.16 [bar]), (270 [deg], 1.7 [bar]), (290 [deg], 2.45 [bar]),
            (310 [deg], 4.1 [bar]), (325 [deg], 6.5 [bar]), (340 [deg], 10.3 [bar]), (350 [deg], 13.5 [bar]),
            // combustion
            (360 [deg], 22 [bar]), (367 [deg], 32 [bar]), (375 [deg], 36 [bar]), (385 [deg], 31 [bar]),
            // expansion
            (400 [deg], 19.5 [bar]), (420 [deg], 11.1 [bar]), (440 [deg], 7.2 [bar]), (460 [deg], 5.2 [bar]),
            (480 [deg], 4.2 [bar]), (500 [deg], 3.6 [bar]), (520 [deg], 2.6 [bar]), (540 [deg], 1.7 [bar]),
            // outlet
            (570 [deg], 1.2 [bar]), (600 [deg], 1.1 [bar]), (720 [deg], 1.1 [bar])
        ] linear outside periodic;
        let area = pi/4*bore^2;
        let push = gas*(pressure(theta) - 1 [bar])*area;
        force gas_force on piston = (0, -push);

        // dy_p/dθ
        let across = sqrt(rod_length^2 - crank_length^2*sin(theta)^2);
        let slope = -crank_length*sin(theta)*(1 + crank_length*cos(theta)/across);

        let cranking = starter*ramp(1 - der(theta)/starter_speed);
        torque start_torque on crank = cranking;
        torque bearings on crank = -viscous*der(theta);
        torque fan on crank = -load*der(theta)*abs(der(theta));

        /// Work of the gas on the piston since the start.
        state gas_work [J] = 0;
        der(gas_work) = -push*der(y_p);

        start { theta = 45 [deg]; guess y_p = rod_length; guess y = rod_length/2; }
        closes theta = 0 .. 4*pi;

        /// The engine outruns its starter.
        event runs: der(theta) = starter_speed rising;

        /// Speed of the crank.
        output speed [rpm] = der(theta);
        /// Pressure in the cylinder.
        output cylinder [bar] = pressure(theta);
        /// Volume that the piston leaves above its highest position.
        output volume [mL] = area*(crank_length + rod_length - y_p);
        /// Torque of the starter.
        output starter_torque [N*m] = cranking;
        /// Torque that the gas has on the crank.
        output gas_torque [N*m] = -push*slope;
        /// Power that the load takes.
        output power [W] = load*abs(der(theta))^3;
        /// Force on the crank pin.
        output pin_force [kN] = reaction(crank_pin);
    }
}
