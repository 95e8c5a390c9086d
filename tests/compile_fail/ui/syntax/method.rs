//! The schemes that there are.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        method = euler;
        method = 4;
        method rk4;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
    }
}

fn main() {}
