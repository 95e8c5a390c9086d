//! An equation whose coordinates cancel only after simplification.

use mbs_runtime::mechanism;

mechanism! {
    pub Crank {
        dof = 1;
        body crank (theta1, x) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        constraint one: sin(theta1)^2 + cos(theta1)^2 = 1;
    }
}

fn main() {}
