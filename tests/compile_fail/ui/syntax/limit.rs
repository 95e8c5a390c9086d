//! What can be limited.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        limit memory = 4096;
        limit operations = many;
        limit operations = -1;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
    }
}

fn main() {}
