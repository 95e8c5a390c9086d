//! Equations that constrain nothing.

use mbs_runtime::mechanism;

mechanism! {
    pub Crank {
        dof = 1;
        param l1 = 60 [mm];
        param l2 = 60 [mm];
        body crank (theta1) { inertia = 1 [kg*m^2]; }
        constraint lengths: l1 = l2;
        constraint same: theta1 = theta1;
        constraint zero: 0 = 0;
        drive clock: t = 1 [s];
    }
}

fn main() {}
