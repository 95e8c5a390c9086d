//! Places, directions and stiffnesses are fixed by parameters.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 3;
        input k [N/m];
        body arm (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point end on arm = (x, 0);
        distance rod (arm.end, ground) = x;
        prismatic guide (arm, ground) along (t, 0) at theta;
        spring s (arm, ground) { stiffness = k; length = 0; }
        param l = 1 [m] where l > arm.x;
    }
}

fn main() {}
