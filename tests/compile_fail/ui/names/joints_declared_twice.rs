//! The rows of a joint are named after it.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        body arm (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        constraint pin_x: x = 0;
        revolute pin (arm, ground);
        revolute pin (arm, ground);
        spring rubber (arm, ground) { stiffness = 1 [N/m]; stiffness = 2 [N/m]; length = 0; }
        spring rubber (arm, ground) { stiffness = 1 [N/m]; length = 0; }
    }
}

fn main() {}
