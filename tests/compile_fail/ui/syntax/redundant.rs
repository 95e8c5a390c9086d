//! `redundant` knows one way, once.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        redundant = least_norm;
        redundant minimum_norm;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
    }
}

fn main() {}
