//! Jansen's leg: a crank makes a foot walk.
//!
//! ```text
//!                                      B
//!                                 ────o
//!                e        ────────  ╱  ····
//!                  ───────        ╱╱       ·····  j
//!          ────────          b  ╱               ·····
//!   D  o───                   ╱╱                     ····     m
//!       ··   ───────────     ╱                    o─────────o M
//!      f  ··        d   ─────o Q                O        ···
//!           ··                ╲                      ····
//!             ··           c   ╲                ····
//!           E   o───            ╲           ····  k
//!                ╲  ──────       ╲      ····
//!                 ╲     g ──────  ╲  ···
//!                  ╲            ─── o C
//!                   ╲             ╱
//!                  h ╲          ╱╱
//!                     ╲       ╱╱  i
//!                      ╲     ╱
//!                       ╲  ╱╱         Q lies a to the left of O, l below it
//!                        ╲╱
//!                         o F foot
//! ```
//!
//! The lengths are Theo Jansen's eleven "holy numbers" with a and l for the
//! place of Q (T. Jansen, The Great Pretender, 2007), here in cm. The bars count
//! as massless, the joints as point masses.
//!
//! Reference: every joint is the intersection of two circles, in the order B, C,
//! D, E, F.

use mbs_runtime::mechanism;

mechanism! {
    /// One leg of a beach animal, its crank driven at constant speed.
    pub Jansen {
        dof = 0;
        const a = 38 [cm];
        const b = 41.5 [cm];
        const c = 39.3 [cm];
        const d = 40.1 [cm];
        const e = 55.8 [cm];
        const f = 39.4 [cm];
        const g = 36.7 [cm];
        const h = 65.7 [cm];
        const i = 49 [cm];
        const j = 50 [cm];
        const k = 61.9 [cm];
        const l = 7.8 [cm];
        const m = 15 [cm];
        /// Mass of a joint.
        param joint_mass = 0.1 [kg] where joint_mass > 0;
        /// Inertia of the crank, balanced.
        param crank_inertia = 0.01 [kg*m^2] where crank_inertia > 0;
        /// Speed of the crank.
        param omega = 30 [rpm];
        /// Upward force of the beach on the foot.
        input beach [N];
        gravity = (0, -9.81) [m/s^2];

        body crank (theta) { inertia = crank_inertia; }
        body upper (xb, yb) { mass = joint_mass; }      // B
        body lower (xc, yc) { mass = joint_mass; }      // C
        body outer (xd, yd) { mass = joint_mass; }      // D
        body ankle (xe, ye) { mass = joint_mass; }      // E
        body foot  (xf, yf) { mass = joint_mass; }      // F
        point pin on crank = (m, 0);
        point q on ground = (-a, -l);

        distance bar_j (upper, crank.pin) = j;
        distance bar_b (upper, ground.q) = b;
        distance bar_k (lower, crank.pin) = k;
        distance bar_c (lower, ground.q) = c;
        distance bar_e (outer, upper) = e;
        distance bar_d (outer, ground.q) = d;
        distance bar_f (ankle, outer) = f;
        distance bar_g (ankle, lower) = g;
        distance bar_h (foot, ankle) = h;
        distance bar_i (foot, lower) = i;
        drive motor: crank.angle = omega*t;
        force beach on foot = (0, beach);

        start {
            guess xb = -24 [cm]; guess yb = 31 [cm]; guess xc = -27 [cm]; guess yc = -46 [cm];
            guess xd = -75 [cm]; guess yd = 8 [cm]; guess xe = -59 [cm]; guess ye = -28 [cm];
            guess xf = -43 [cm]; guess yf = -92 [cm]; der(theta) = omega;
        }

        /// Tension of the bar from crank to lower joint.
        output tension_k [N] = lambda(bar_k);
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
    }
}
