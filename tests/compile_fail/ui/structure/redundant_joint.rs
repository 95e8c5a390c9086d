//! Two joints at the same pin.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        param l = 1 [m];
        body arm (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point base on arm = (-l/2, 0);
        revolute pin (arm.base, ground);
        revolute hinge (ground, arm.base);
    }
}

fn main() {}
