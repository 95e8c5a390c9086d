//! The rod is too short to reach the guide.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        param l1 = 60 [mm];
        param l2 = 20 [mm];
        param offset = 90 [mm];
        body crank (theta1) { inertia = 1 [kg*m^2]; }
        body rod (theta2) { inertia = 1 [kg*m^2]; }
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = offset;
    }
}

fn main() {}
