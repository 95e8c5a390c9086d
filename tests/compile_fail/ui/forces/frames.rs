//! Only a force on a body has components that depend on a frame.

use mbs_runtime::mechanism;

mechanism! {
    pub Bench {
        dof = 3;
        body rod (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        force thrust on rod in rocket = (1 [N], 0);
        torque twist on rod in rod = 1 [N*m];
        force pull on x in rod = 1 [N];
    }
}

fn main() {}
