//! `states` knows two ways.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        states = minimal;
        states reduced;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
    }
}

fn main() {}
