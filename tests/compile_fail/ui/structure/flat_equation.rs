//! An equation with a coordinate in it that restricts no motion.

use mbs_runtime::mechanism;

mechanism! {
    pub Crank {
        dof = 1;
        body crank (theta) { inertia = 1 [kg*m^2]; }
        constraint upwards: sign(theta) = 1;
    }
}

fn main() {}
