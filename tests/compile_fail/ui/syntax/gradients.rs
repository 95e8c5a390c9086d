//! `gradients` knows one way that has to be asked for.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        gradients = forward;
        gradients reverse;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
    }
}

fn main() {}
