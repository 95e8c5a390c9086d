//! A quarter of a car on a progressive strut, over a bump.
//!
//! ```text
//!        ┌───────────┐ y_c
//!        │  chassis  │
//!        └────┬─┬────┘
//!   spring_force│ damper_force    both by tables
//!          ┌──┴─┴──┐ y_w
//!          │ wheel │
//!          └───┬───┘
//!              ▒ tyre
//!     ─────────┴──────╱╲───────  road
//! ```
//!
//! The strut is a force between chassis and wheel by a law of its own: a spring by a table of its
//! length ℓ, with a bump stop below 250 mm and a rebound stop above 500 mm, and a damper by a table of
//! ℓ̇ that resists a fast rebound three times as much as a bump. The tyre pushes only. With gravity g and masses
//! m_c and m_w
//!
//! m_c ÿ_c = F_s(ℓ) − F_d(ℓ̇) − m_c g,  m_w ÿ_w = F_d(ℓ̇) − F_s(ℓ) + k max(0, y_r − y_w) − m_w g,
//!
//! ℓ = y_c − y_w. Reference: it starts at rest, where the strut bears m_c g, so that ℓ is on the soft
//! part of the table, ℓ = 250 mm + (5.2 kN − m_c g)/(20 kN/m).

use mbs_runtime::mechanism;

mechanism! {
    /// Quarter of a car on a strut by tables, over a bump.
    pub Suspension {
        dof = 2;
        /// Mass of the quarter of the car.
        param chassis_mass = 300 [kg] where chassis_mass > 0;
        /// Mass of the wheel.
        param wheel_mass = 40 [kg] where wheel_mass > 0;
        /// Stiffness of the tyre.
        param tyre_stiffness = 200 [N/mm] where tyre_stiffness >= 0;
        /// Share of the spring that is built in.
        param spring = 1 where spring >= 0;
        /// Share of the damper that is built in.
        param damper = 1 where damper >= 0;
        /// Speed of the car.
        param speed = 10 [m/s];
        /// Height of the bump.
        param bump = 60 [mm];
        const g = 9.81 [m/s^2];
        gravity = (0, -g);

        body chassis (y = y_c) { mass = chassis_mass; }
        body wheel (y = y_w) { mass = wheel_mass; }

        table spring_force(length) = [
            (200 [mm], 12 [kN]), (250 [mm], 5.2 [kN]), (500 [mm], 0.2 [kN]), (520 [mm], -2 [kN])
        ] linear outside extend;
        table damper_force(rate) = [
            (-2 [m/s], -0.9 [kN]), (-0.1 [m/s], -0.12 [kN]), (0.1 [m/s], 0.12 [kN]), (2 [m/s], 2.7 [kN])
        ] linear outside extend;
        table road(way) = [(1 [m], 0), (1.5 [m], 1), (2 [m], 0)] monotone outside hold;

        force strut (chassis, wheel) = damper*damper_force(rate) - spring*spring_force(length);
        let pressed = max(0, bump*road(speed*t) - y_w);
        force tyre on wheel = (0, tyre_stiffness*pressed);

        start {
            y_w = -(chassis_mass + wheel_mass)*g/(200 [N/mm]);
            y_c = 250 [mm] + (5.2 [kN] - chassis_mass*g)/(20 [kN/m]) - (chassis_mass + wheel_mass)*g/(200 [N/mm]);
        }

        /// Length of the strut.
        output strut_length [mm] = length(strut);
        /// Force with which the strut pulls chassis and wheel together.
        output strut_force [kN] = force(strut);
        /// Force of the road on the tyre.
        output wheel_load [kN] = tyre_stiffness*pressed;
        /// Acceleration that the passengers feel.
        output comfort [m/s^2] = der(der(y_c));
    }
}
