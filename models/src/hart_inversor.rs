//! Hart's inversor: an exact straight line with a crossed parallelogram.
//!
//! ```text
//!                                                    o A
//!                                                 ···│
//!            A–B, C–D: long, crossing          ···   │
//!            A–D, C–B: short                ···       │
//!                                        ···          │
//!   C o──                             ···          ·· o P
//!      ╲ ─────────                 ···         ····   │
//!      ┆╲╲        ──────────  O ·o·        o···       │
//!      ┆  ╲                 ──·────────   hub          │
//!      ┆   ╲              ···          ──────────      │
//!      ┆  Q o          ···                       ───── o D
//!      ┆     ╲      ···
//!      ┆      ╲╲ ···           O, P, Q divide A–B, A–D, C–B
//!    line   B   o              in the same ratio
//! ```
//!
//! O, P and Q stay on a line parallel to A–C with OP·OQ = −share·(1 − share)
//! (long² − short²), an inversion at O, which is on the ground. P goes round a
//! circle through O, so Q goes along a straight line (H. Hart 1874; A. B. Kempe,
//! How to Draw a Straight Line, 1877).
//!
//! Reference: Q stays on x = −share·(1 − share)·(long² − short²)/(2 r) with the
//! crank's length r, its hub at (r, 0).

use mbs_runtime::mechanism;

mechanism! {
    /// Hart's straight-line linkage, its crank swinging.
    pub HartInversor {
        dof = 0;
        /// Length of the bars that cross.
        param long = 0.4 [m] where long > short;
        /// Length of the other two bars.
        param short = 0.2 [m] where short > 0;
        /// Where the joints O, P, Q divide their bars.
        param share = 0.5 where share > 0;
        /// Length of the crank and distance of its hub from O.
        param radius = 0.08 [m] where radius > 0;
        /// Amplitude of the crank, less than what lays all bars on one line.
        param amplitude = 50 [deg] where 2*radius*cos(amplitude/2) > share*(long - short);
        /// Angular frequency of the crank.
        param omega = 3 [rad/s];
        /// Mass of the bars per length.
        param density = 1 [kg/m] where density > 0;
        gravity = (0, -9.81) [m/s^2];

        body ab (x1, y1, phi1) { mass = density*long; inertia = density*long^3/12; }
        body cd (x2, y2, phi2) { mass = density*long; inertia = density*long^3/12; }
        body ad (x3, y3, phi3) { mass = density*short; inertia = density*short^3/12; }
        body cb (x4, y4, phi4) { mass = density*short; inertia = density*short^3/12; }
        body crank (x5, y5, alpha) { mass = density*radius; inertia = density*radius^3/12; }

        point a on ab = (-long/2, 0);
        point b on ab = (long/2, 0);
        point o on ab = ((share - 0.5)*long, 0);
        point c on cd = (-long/2, 0);
        point d on cd = (long/2, 0);
        point a on ad = (-short/2, 0);
        point d on ad = (short/2, 0);
        point p on ad = ((share - 0.5)*short, 0);
        point c on cb = (-short/2, 0);
        point b on cb = (short/2, 0);
        point q on cb = ((share - 0.5)*short, 0);
        point hub on crank = (-radius/2, 0);
        point p on crank = (radius/2, 0);
        point hub on ground = (radius, 0);

        revolute bearing_o (ground, ab.o);
        revolute pin_a (ab.a, ad.a);
        revolute pin_b (ab.b, cb.b);
        revolute pin_c (cd.c, cb.c);
        revolute pin_d (cd.d, ad.d);
        revolute pin_p (ad.p, crank.p);
        revolute hub (ground.hub, crank.hub);
        drive motor: crank.angle = amplitude*sin(omega*t);

        start {
            // the crank at 0: P on the x axis, B–D = 2 r/share along it
            guess phi1 = -150 [deg]; guess phi2 = -30 [deg]; guess x2 = -0.03 [m];
            guess phi3 = -98 [deg]; guess x3 = 2*radius;
            guess phi4 = -82 [deg]; guess x4 = -0.19 [m]; guess x5 = 1.5*radius;
        }

        /// Path of Q.
        output q_x [m] = cb.q.x;
        /// Path of Q.
        output q_y [m] = cb.q.y;
        /// Deviation of Q from the line.
        output deviation [m] = cb.q.x + share*(1 - share)*(long^2 - short^2)/(2*radius);
        /// Torque that moves the crank.
        output drive_torque [N*m] = effort(motor);
    }
}
