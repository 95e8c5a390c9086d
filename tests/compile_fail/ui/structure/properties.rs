//! A body that moves has a mass, one that turns an inertia.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 4;
        body crank (x1, y1, theta1) { mass = 1 [kg]; }
        body slider (x3) { }
        body rod (x2) { mas = 1 [kg]; mass = 1 [kg]; }
        body wheel (theta3) { inertia = 1 [kg*m^2]; colour = 3; }
    }
}

fn main() {}
