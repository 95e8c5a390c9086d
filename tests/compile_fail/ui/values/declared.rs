//! Declared values obey their own conditions, and no mass is negative.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 3;
        param l1 = -60 [mm] where l1 > 0;
        param l2 = 60 [mm] where l2 <= l1;
        param l3 = 60 [mm] where 0 >= l3;
        param l4 = 60 [mm] where l4 < l2;
        param m1 = -0.5 [kg];
        body crank (x1, y1, theta1) { mass = m1; inertia = m1*l1^2; }
    }
}

fn main() {}
