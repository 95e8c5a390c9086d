//! A mass and a start that divide by a parameter declared as 0.

use mbs_runtime::mechanism;

mechanism! {
    pub Slider {
        dof = 2;
        param ratio = 0;
        body slider (x) { mass = 2 [kg]/ratio; }
        body mote (y) { mass = 4e-324 [kg]; }
        start { x = 1 [m]/ratio; }
    }
}

fn main() {}
