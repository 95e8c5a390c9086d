//! A force on a body is in newtons, a torque in newton metres, a force along a
//! coordinate whatever does work along it.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 3;
        param k = 200 [N/m];
        param c = 2 [N*s/m];
        body crank (x1, y1, theta1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        force spring on crank = (-k*x1, -k);
        force damper on crank = (-c*x1, 0);
        torque motor on crank = 3 [N];
        force push on x1 = 3 [N*m];
        force twist on theta1 = 3 [N];
        force bare on x1 = 3;
    }
}

fn main() {}
