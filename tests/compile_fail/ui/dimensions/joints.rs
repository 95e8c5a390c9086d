//! Places are lengths, directions of one dimension, stiffnesses per what they resist.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 3;
        param l = 1 [m];
        body arm (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point end on arm = (l, 1);
        point top on arm = (1 [kg], 0) ;
        prismatic guide (arm, ground) along (1, l);
        prismatic rail (arm, ground) along (1, 0) at l;
        distance rod (arm.end, ground) = 3;
        spring s (arm, ground) { stiffness = 1 [N]; length = 3; damping = 1 [N/m]; }
        torsion_spring t (arm, ground) { stiffness = 1 [N/m]; angle = l; damping = 2; }
    }
}

fn main() {}
