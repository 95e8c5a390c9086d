//! The time of a start is a value that parameters give, once.

use mbs_runtime::mechanism;

mechanism! {
    pub Crank {
        dof = 1;
        body crank (theta) { inertia = 1 [kg*m^2]; }
        start { t = 1 [s]; t = 2 [s]; guess t = 3 [s]; }
    }
}

mechanism! {
    pub Lever {
        dof = 1;
        body lever (theta) { inertia = 1 [kg*m^2]; }
        start { t = 1 [m]; }
    }
}

fn main() {}
