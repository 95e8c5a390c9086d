//! Two drives on one degree of freedom.

use mbs_runtime::mechanism;

mechanism! {
    pub Crank {
        dof = 1;
        param l1 = 60 [mm];
        param omega = 200 [rpm];
        body crank (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 1 [kg*m^2]; }
        constraint crank_x: x1 = l1*cos(theta1);
        drive speed: theta1 = omega*t;
        drive again: 2*theta1 = omega*t;
    }
}

fn main() {}
