//! Two drives of one crank, which agree at first but not later.

use mbs_runtime::mechanism;

mechanism! {
    pub Crank {
        dof = 0;
        redundant = minimum_norm;
        param omega = 20 [rad/s];
        body crank (theta) { inertia = 1 [kg*m^2]; }
        drive slow: theta = omega*t;
        drive fast: theta = 2*omega*t;
    }
}

fn main() {}
