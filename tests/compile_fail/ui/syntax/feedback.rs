//! The ways to feed back, and what they take.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        feedback = 2000;
        feedback = often(1 [1/s], 2 [1/s]);
        feedback = held(1 [1/s]);
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
    }
}

fn main() {}
