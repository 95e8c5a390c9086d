//! Every statement with a wrong shape is reported, not the first alone.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 0;
        parm l1 = 60 [mm];
        param l2 180 [mm];
        param m1 = 0.5kg;
        body crank { mass = m1; }
        constraint crank_x x1 = l1/2*cos(theta1);
        drive crank_speed: theta1;
        gravity = 9.81 [m/s^2];
        output = theta1;
    }
}

fn main() {}
