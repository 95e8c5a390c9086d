//! A start from which no correction leads anywhere: the rod has no direction.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
    }
}

fn main() {}
