//! A start is given by parameters, for each coordinate once.

use mbs_runtime::mechanism;

mechanism! {
    pub Crank {
        dof = 1;
        param omega = 200 [rpm];
        body crank (theta) { inertia = 1 [kg*m^2]; }
        start { theta = omega*t; theta = 0; guess der(theta) = omega; der(phi) = 0; }
    }
}

fn main() {}
