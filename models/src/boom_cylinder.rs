//! The boom of an excavator, lifted by a hydraulic cylinder with oil that gives way and a proportional valve.
//!
//! ```text
//!                                  ___---o load m_l
//!                     lug  ___---‾‾
//!                     __o-‾      boom l, m
//!          foot  __--‾ ╱╱
//!            o--‾     ╱╱  p_b, A_b  ◀──┐
//!            φ      ╔╱╱╗               valve u ◀── supply p_s
//!                   ║▒▒║  p_a, A_a  ◀──┘       ──▶ tank p_t
//!                   ╚══╝
//!                    o base
//! ```
//!
//! The pressures in the two chambers are states. The piston pushes by F = A_a p_a − A_b p_b at the length s, the
//! oil flows in by Q_a and out by Q_b, and its bulk modulus E makes pressure of what is too much:
//!
//! ṗ_a = (E/V_a)(Q_a − A_a ṡ),  ṗ_b = (E/V_b)(A_b ṡ − Q_b),
//!
//! V_a = V_d + A_a (s − s_0), V_b = V_d + A_b (s_1 − s), V_d a dead volume. The valve opens by u from −1 to 1. For u > 0
//! it joins chamber a with the supply and b with the tank, else the other way round, by flows K u √Δp. Near Δp = 0, below
//! δ = 2 bar, the flow is laminar: √Δp is written Δp/(Δp² + δ²)^¼
//! (M. Jelali, A. Kroll, Hydraulic Servo-systems, Springer 2003, chapter 4).
//!
//! Reference: at rest F s′ is the moment of the weights, s′ = ds/dφ, and it is at rest with its pressures at the
//! start. With the valve shut p_a + E ln V_a and p_b + E ln V_b stay what they are. So for small motions
//! about the rest, with the inertia I about the foot and the moment G(φ) of the weights,
//!
//! I ω² = E (A_a²/V_a + A_b²/V_b) s′² − F s″ + G′.

use mbs_runtime::mechanism;

mechanism! {
    /// Boom on a hydraulic cylinder with a proportional valve.
    pub BoomCylinder {
        dof = 1;
        /// Length of the boom.
        param boom_length = 4 [m] where boom_length > 0;
        /// Mass of the boom.
        param boom_mass = 1200 [kg] where boom_mass > 0;
        /// Mass of the load at its end.
        param load_mass = 800 [kg] where load_mass > 0;
        /// Angle of the boom at the start.
        param phi0 = 15 [deg];
        /// Diameter of the piston.
        param bore = 125 [mm] where bore > rod;
        /// Diameter of its rod.
        param rod = 80 [mm] where rod > 0;
        /// Length of the cylinder with the piston at its bottom.
        param shortest = 1.5 [m] where shortest > 0;
        /// Length of the cylinder with the piston at its top.
        param longest = 2.5 [m] where longest > shortest;
        /// Volume of hoses and ports of each chamber.
        param dead = 2 [L] where dead > 0;
        /// Bulk modulus of the oil.
        param modulus = 1.2 [GPa] where modulus > 0;
        /// Flow of the open valve at a pressure difference of 35 bar.
        param nominal_flow = 120 [L/min] where nominal_flow >= 0;
        /// Pressure of the supply.
        param supply = 180 [bar];
        /// Pressure of the tank.
        param tank = 2 [bar];
        /// Pressure above the piston at the start.
        param above = 20 [bar];
        /// Friction of the seals over the speed of the piston.
        param viscous = 30 [kN*s/m] where viscous >= 0;
        /// Share of the force of the cylinder that acts.
        param cylinder = 1 where cylinder >= 0;
        /// Share of the declared plan of the valve.
        param plan = 1;
        /// Opening of the valve that adds to the plan.
        input opening [1];
        const g = 9.81 [m/s^2];
        gravity = (0, -g);

        body boom (x_b, y_b, phi) { mass = boom_mass; inertia = boom_mass*boom_length^2/12; }
        body load (x_l, y_l) { mass = load_mass; }
        point foot on boom = (-boom_length/2, 0);
        point lug on boom = (0.4*boom_length - boom_length/2, 0);
        point tip on boom = (boom_length/2, 0);
        point base on ground = (0.15*boom_length, -0.225*boom_length);
        revolute foot (ground, boom.foot);
        revolute shackle (boom.tip, load);

        let area_a = pi/4*bore^2;
        let area_b = pi/4*(bore^2 - rod^2);
        let s = distance(boom.lug, ground.base);
        let volume_a = dead + area_a*ramp(s - shortest);
        let volume_b = dead + area_b*ramp(longest - s);

        // where it rests at the start, by the law of cosines: lug and base stand at these distances from the foot, and
        // between them is the angle phi0 + below
        let to_lug = 0.4*boom_length;
        let to_base = sqrt(0.15^2 + 0.225^2)*boom_length;
        let below = atan2(0.225, 0.15);
        let s_start = sqrt(to_lug^2 + to_base^2 - 2*to_lug*to_base*cos(phi0 + below));
        let lever = to_lug*to_base*sin(phi0 + below)/s_start;
        let weight = (boom_mass/2 + load_mass)*boom_length*g*cos(phi0)/lever;

        /// Pressure below the piston.
        state p_a [bar] = (weight + area_b*above)/area_a;
        der(p_a) = modulus/volume_a*(flow_a - area_a*der(s));
        /// Pressure above it, around the rod.
        state p_b [bar] = above;
        der(p_b) = modulus/volume_b*(area_b*der(s) - flow_b);

        table lever_plan(time) = [
            (0.2 [s], 0), (0.5 [s], 0.6), (2.5 [s], 0.6), (2.7 [s], 0), (3.5 [s], 0), (3.8 [s], -0.4), (6 [s], -0.4),
            (6.3 [s], 0)
        ] linear outside hold;
        let u = clamp(plan*lever_plan(t) + opening, -1, 1);
        // pressure differences over the nominal one, and their roots with a laminar part
        const nominal = 35 [bar];
        const laminar = 2/35;
        let over_a = if u > 0 { (supply - p_a)/nominal } else { (p_a - tank)/nominal };
        let over_b = if u > 0 { (p_b - tank)/nominal } else { (supply - p_b)/nominal };
        let flow_a = nominal_flow*u*over_a/sqrt(sqrt(over_a^2 + laminar^2));
        let flow_b = nominal_flow*u*over_b/sqrt(sqrt(over_b^2 + laminar^2));

        let push = area_a*p_a - area_b*p_b;
        force piston (boom.lug, ground.base) = cylinder*(viscous*rate - push);

        start { phi = phi0; guess x_b = boom_length/2; guess x_l = boom_length; }

        /// Angle of the boom.
        output angle [deg] = phi;
        /// Length of the cylinder.
        output cylinder_length [mm] = s;
        /// Speed of the piston.
        output piston_speed [mm/s] = der(s);
        /// Force with which the cylinder pushes the boom up.
        output piston_force [kN] = -force(piston);
        /// Opening of the valve.
        output valve = u;
        /// Flow into the chamber below the piston.
        output inflow [L/min] = flow_a;
        /// Power that the pump delivers.
        output pump_power [kW] = supply*if u > 0 { flow_a } else { -flow_b };
        /// Force on the foot of the boom.
        output foot_force [kN] = reaction(foot);
    }
}
