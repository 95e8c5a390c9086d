//! A driven slider-crank whose rod bends.
//!
//! ```text
//!                 _.-•--•-._  w
//!         pin  .-'·········'-.o  wrist
//!            o              ┌─┴─┐
//!      a    ╱   rod          │   │ ──▶ x
//!          ╱                 └───┘
//!         O  omega
//! ```
//!
//! The rod is a line from pin to wrist, and its deflection from that line is w sin(πσ), σ from 0 to 1. Its length does
//! not change, so that a deflection brings its ends together, by (π w)²/4l. Its mass is that of five particles at the
//! nodes of Gauss's rule; its bending energy is ½ EI ∫(w sin(πσ))″² ds = π⁴ EI w²/4l³.
//!
//! The data are those of the elastic slider-crank of the test set for solvers of initial value problems (W. M. Lioen,
//! J. J. B. de Swart, CWI MAS-R9832, 1998, after B. Simeon), with a rod that bends in its first shape alone and is not
//! stretched. Its first frequency is there 1276.69 rad/s.
//!
//! Reference: Lagrange's equation of w, with the motion of all masses differentiated along (t, w) by dual numbers of
//! second order.

use mbs_runtime::mechanism;

mechanism! {
    /// Slider-crank with a rod that bends, driven at a constant speed.
    pub ElasticCrank {
        dof = 1;
        /// Length of the crank.
        param crank_length = 150 [mm] where crank_length > 0;
        /// Length of the rod.
        param rod_length = 300 [mm] where rod_length > crank_length;
        /// Side of the rod's square section.
        param side = 8 [mm] where side > 0;
        /// Density of the rod.
        param density = 7870 [kg/m^3] where density > 0;
        /// Young's modulus of the rod.
        param modulus = 200 [GPa] where modulus > 0;
        /// Damping ratio of the rod's first shape.
        param damping_ratio = 0.005 where damping_ratio >= 0;
        /// Mass of the slider.
        param slider_mass = 75.552 [g] where slider_mass > 0;
        /// Inertia of the crank about its bearing.
        param crank_inertia = 2.727e-3 [kg*m^2] where crank_inertia > 0;
        /// Speed of the crank.
        param speed = 150 [rad/s];
        /// Deflection at the start, from which the rod is let go.
        param plucked = 0.5 [mm];

        let rod_mass = density*side^2*rod_length;
        let stiffness = pi^4*modulus*side^4/12/(2*rod_length^3);

        body crank (phi) { inertia = crank_inertia; }
        body rod (x, y, theta) { mass = 0; inertia = 0; }
        body slider (x_s) { mass = slider_mass; }
        /// Deflection in the middle of the rod.
        coordinate w [mm];

        // nodes and weights of Gauss's rule on 0 … 1
        const at[1] = 0.046910077030668;    const share[1] = 0.118463442528094544;
        const at[2] = 0.230765344947158454; const share[2] = 0.239314335249683234;
        const at[3] = 0.5;                  const share[3] = 0.284444444444444444;
        const at[4] = 0.769234655052841546; const share[4] = 0.239314335249683234;
        const at[5] = 0.953089922969332;    const share[5] = 0.118463442528094544;
        // how far a point comes towards the pin by the deflection, over (π w)²/4l
        for i in 1..=5 {
            const short[i] = at[i] + sin(2*pi*at[i])/(2*pi);
            point p[i] on rod = (at[i]*rod_length - pi^2/4*short[i]*w^2/rod_length, sin(pi*at[i])*w);
            particle piece[i] at rod.p[i] { mass = share[i]*rod_mass; }
        }
        point pin on crank = (crank_length, 0);
        point end on rod = (rod_length - pi^2/4*w^2/rod_length, 0);
        revolute knee (rod, crank.pin);
        revolute wrist (rod.end, slider);
        drive motor: phi = speed*t;

        potential bending = stiffness/2*w^2;
        dissipation loss = damping_ratio*sqrt(stiffness*rod_mass/2)*der(w)^2;

        start { w = plucked; guess x = crank_length; guess x_s = crank_length + rod_length; der(w) = 0; }

        /// Torque of the drive.
        output torque [N*m] = effort(motor);
        /// Bending stress at the surface in the middle of the rod.
        output stress [MPa] = pi^2*modulus*side/2*w/rod_length^2;
        /// Force on the bearing of the crank pin.
        output pin_force [N] = reaction(knee);
    }
}
