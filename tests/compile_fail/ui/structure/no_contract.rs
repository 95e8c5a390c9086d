//! Without a contract, a forgotten constraint would go unnoticed.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
    }
}

fn main() {}
