//! A mass is a mass, gravity an acceleration, a start what its coordinate is.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 3;
        param l1 = 60 [mm] where l1 > 1 [kg];
        param l2 = 60 [mm] where l2 > 1;
        param m1 = 500 [g];
        gravity = (0, -9.81);
        body crank (x1, y1, theta1) { mass = l1; inertia = m1*l1; }
        body slider (x3) { mass = 2; }
        start { x1 = 60; y1 = m1; theta1 = l1; der(x1) = 3 [m]; der(theta1) = 200; }
    }
}

fn main() {}
