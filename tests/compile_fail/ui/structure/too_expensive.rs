//! A limit that the solver does not keep.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        limit operations = 10;
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        start { x = 1 [m]; }
    }
}

fn main() {}
