//! Three of Jansen's legs on one crank, a third of a turn apart.
//!
//! ```text
//!              o pin 1
//!              │
//!              O crank, each leg as in `jansen`
//!            ╱   ╲
//!     pin 2 o     o pin 3
//! ```
//!
//! With three legs one foot at least is always on the ground. The leg is declared
//! once, as an assembly; lengths and figure as of [`Jansen`](crate::Jansen).
//!
//! Reference: each foot takes the path of the single leg, when the crank has
//! turned on by the phase of its pin.

use mbs_runtime::mechanism;

mechanism! {
    /// Three legs of a beach animal, their crank driven at constant speed.
    pub JansenWalker {
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
        gravity = (0, -9.81) [m/s^2];

        body crank (theta) { inertia = crank_inertia; }
        point pin1 on crank = (m, 0);
        point pin2 on crank = (m*cos(2/3*pi), m*sin(2/3*pi));
        point pin3 on crank = (m*cos(4/3*pi), m*sin(4/3*pi));
        point q on ground = (-a, -l);
        drive motor: crank.angle = omega*t;

        assembly Leg {
            body upper (xb, yb) { mass = joint_mass; }      // B
            body lower (xc, yc) { mass = joint_mass; }      // C
            body outer (xd, yd) { mass = joint_mass; }      // D
            body ankle (xe, ye) { mass = joint_mass; }      // E
            body foot  (xf, yf) { mass = joint_mass; }      // F
            distance bar_b (upper, ground.q) = b;
            distance bar_c (lower, ground.q) = c;
            distance bar_e (outer, upper) = e;
            distance bar_d (outer, ground.q) = d;
            distance bar_f (ankle, outer) = f;
            distance bar_g (ankle, lower) = g;
            distance bar_h (foot, ankle) = h;
            distance bar_i (foot, lower) = i;
            start {
                guess xb = -24 [cm]; guess yb = 31 [cm]; guess xc = -27 [cm]; guess yc = -46 [cm];
                guess xd = -75 [cm]; guess yd = 8 [cm]; guess xe = -59 [cm]; guess ye = -28 [cm];
                guess xf = -43 [cm]; guess yf = -92 [cm];
            }
        }
        instance first: Leg;
        instance second: Leg;
        instance third: Leg;
        distance bar_j1 (first.upper, crank.pin1) = j;
        distance bar_k1 (first.lower, crank.pin1) = k;
        distance bar_j2 (second.upper, crank.pin2) = j;
        distance bar_k2 (second.lower, crank.pin2) = k;
        distance bar_j3 (third.upper, crank.pin3) = j;
        distance bar_k3 (third.lower, crank.pin3) = k;
        start { der(theta) = omega; }

        /// Height of the first foot below the crank.
        output foot1 [m] = first.foot.y;
        /// Height of the second foot.
        output foot2 [m] = second.foot.y;
        /// Height of the third foot.
        output foot3 [m] = third.foot.y;
        /// Torque that keeps the crank at its speed.
        output drive_torque [N*m] = effort(motor);
    }
}
