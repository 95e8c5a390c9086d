//! Every coordinate of a body has a direction of its own.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        body crank () { mass = 1 [kg]; }
        body rod (x1, y1, theta1, z1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body slider (x2, x3) { mass = 1 [kg]; }
        body piston (s) { mass = 1 [kg]; }
        body wheel (theta2, x4, y4) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body cart (z = q1) { mass = 1 [kg]; }
    }
}

fn main() {}
