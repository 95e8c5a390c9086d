//! A slider in two guides: the second one says nothing new.

use mbs_runtime::mechanism;

mechanism! {
    pub Carriage {
        dof = 1;
        param a = 0.2 [m];
        body carriage (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point left on carriage = (-a, 0);
        point right on carriage = (a, 0);
        prismatic rail (carriage, ground) along (1, 0);
        point_on_line guide (carriage.right, ground) along (1, 0);
    }
}

fn main() {}
