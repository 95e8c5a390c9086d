//! Andrews' squeezer: seven bodies, three loops, one degree of freedom.
//!
//! ```text
//!                                                          o C
//!                                                        ╱╱
//!                                                       ╱
//!                                                     ╱╱ spring
//!                                                    ╱
//!                                                  ╱╱
//!                            o B─────────        ╱╱
//!                             ╲╲    K3   ──────o D
//!                               ╲             ╱
//!                          o G   ╲ K3       ╱╱
//!                K5    ···· ···   ╲       ╱╱ K3
//!                  ····      K4 ···╲     ╱
//!              ····                ·╲  ╱╱
//!     A o······                      o E──────────o F─o O  ↺ motor
//!        ────────                  ╱╱     K2       K1
//!                ──────  K7     ╱╱ K6
//!                      ──────o H
//! ```
//!
//! The test problem of programs for constrained systems: with a motor torque of
//! 0.033 N·m it reaches 1000 rad/s after 0.03 s, past nearly singular positions,
//! and needs steps of 1e-6 s or less. Parameters: W. Schiehlen (ed.),
//! Multibody Systems Handbook, 1990; E. Hairer, G. Wanner, Solving Ordinary
//! Differential Equations II, §VI.9; lengths in m.
//!
//! Reference: at the start the multipliers of `e3` are 98.56687039624109 N and
//! −6.122688344255662 N; at 0.03 s β = 15.8107712, Θ = −15.7563711, γ = 0.0408222,
//! Φ = −0.5347301, δ = 0.5244100, Ω = 0.5347301, ε = 1.0480807 rad (Hairer–Wanner,
//! and the Test Set for IVP Solvers).

use mbs_runtime::mechanism;

mechanism! {
    /// Andrews' squeezer mechanism, a motor on its crank.
    pub AndrewsSqueezer {
        dof = 1;
        /// Stiffness of the spring.
        param stiffness = 4530 [N/m] where stiffness >= 0;
        /// Length of the spring without force.
        param free_length = 0.07785 [m] where free_length > 0;
        /// Torque of the motor on K1; 0.033 N·m in the test problem.
        input motor_torque [N*m];
        const xa = -0.06934 [m];
        const ya = -0.00227 [m];
        const xb = -0.03635 [m];
        const yb = 0.03273 [m];
        const xc = 0.014 [m];
        const yc = 0.072 [m];
        const d = 0.028 [m];
        const da = 0.0115 [m];
        const e = 0.02 [m];
        const ea = 0.01421 [m];
        const rr = 0.007 [m];
        const ra = 0.00092 [m];
        const ss = 0.035 [m];
        const sa = 0.01874 [m];
        const sb = 0.01043 [m];
        const sc = 0.018 [m];
        const sd = 0.02 [m];
        const ta = 0.02308 [m];
        const tb = 0.00916 [m];
        const u = 0.04 [m];
        const ua = 0.01228 [m];
        const ub = 0.00449 [m];
        const zf = 0.02 [m];
        const zt = 0.04 [m];
        const fa = 0.01421 [m];

        // the angles are β, β + Θ, γ − π/2, Φ + δ − π/2, δ, Ω + ε, ε − π/2 of the source
        body k1 (x1, y1, angle1) { mass = 0.04325 [kg]; inertia = 2.194e-6 [kg*m^2]; }
        body k2 (x2, y2, angle2) { mass = 0.00365 [kg]; inertia = 4.410e-7 [kg*m^2]; }
        body k3 (x3, y3, angle3) { mass = 0.02373 [kg]; inertia = 5.255e-6 [kg*m^2]; }
        body k4 (x4, y4, angle4) { mass = 0.00706 [kg]; inertia = 5.667e-7 [kg*m^2]; }
        body k5 (x5, y5, angle5) { mass = 0.07050 [kg]; inertia = 1.169e-5 [kg*m^2]; }
        body k6 (x6, y6, angle6) { mass = 0.00706 [kg]; inertia = 5.667e-7 [kg*m^2]; }
        body k7 (x7, y7, angle7) { mass = 0.05498 [kg]; inertia = 1.912e-5 [kg*m^2]; }

        point a on ground = (xa, ya);
        point b on ground = (xb, yb);
        point c on ground = (xc, yc);
        point o on k1 = (-ra, 0);
        point f on k1 = (rr - ra, 0);
        point f on k2 = (da, 0);
        point e on k2 = (da - d, 0);
        point b on k3 = (-sa, -sb);
        point e on k3 = (ss - sa, -sb);
        point d on k3 = (sc - sa, sd - sb);
        point g on k4 = (ea - e, 0);
        point e on k4 = (ea, 0);
        point a on k5 = (-ta, -tb);
        point g on k5 = (zt - ta, -tb);
        point h on k6 = (fa - zf, 0);
        point e on k6 = (fa, 0);
        point a on k7 = (-ua, ub);
        point h on k7 = (u - ua, ub);

        revolute o (k1.o, ground);
        revolute f (k2.f, k1.f);
        revolute e3 (k2.e, k3.e);
        revolute e4 (k2.e, k4.e);
        revolute e6 (k2.e, k6.e);
        revolute b (k3.b, ground.b);
        revolute g (k4.g, k5.g);
        revolute a5 (k5.a, ground.a);
        revolute h (k6.h, k7.h);
        revolute a7 (k7.a, ground.a);
        spring coil (k3.d, ground.c) { stiffness = stiffness; length = free_length; }
        torque motor on k1 = motor_torque;

        start {
            angle1 = -0.06171389001427645; der(angle1) = 0;
            guess x1 = 0.00092 [m]; guess y1 = -0.00006 [m];
            guess x2 = -0.00449 [m]; guess y2 = 0.00028 [m]; guess angle2 = -0.0617;
            guess x3 = -0.01874 [m]; guess y3 = 0.02049 [m]; guess angle3 = -1.1155;
            guess x4 = -0.03022 [m]; guess y4 = 0.01207 [m]; guess angle4 = -0.8608;
            guess x5 = -0.05324 [m]; guess y5 = 0.01663 [m]; guess angle5 = 0.4874;
            guess x6 = -0.02854 [m]; guess y6 = -0.01072 [m]; guess angle6 = 1.0079;
            guess x7 = -0.05926 [m]; guess y7 = -0.01060 [m]; guess angle7 = -0.3402;
        }

        /// Pin F.
        output f_x [m] = k1.f.x;
        /// Pin F.
        output f_y [m] = k1.f.y;
        /// Pin E.
        output e_x [m] = k2.e.x;
        /// Pin E.
        output e_y [m] = k2.e.y;
    }
}
