//! A unit belongs to the number before it, not to the whole formula; and a
//! letter is lost in a short name.

use mbs_runtime::mechanism;

mechanism! {
    pub Wheel {
        dof = 1;
        param length = 1.5*0.1 [m];
        body wheel (phi) { inertia = 0.052/3 [kg*m^2]; }
        torque brake on wheel = -0.1 [N*m]*sin(ph);
    }
}

fn main() {}
