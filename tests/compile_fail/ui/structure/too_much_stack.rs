//! A limit of the stack that a step cannot promise to keep.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        limit stack = 512;
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        start { x = 1 [m]; }
    }
}

fn main() {}
