//! Nothing moves a massless body that no constraint holds.

use mbs_runtime::mechanism;

mechanism! {
    pub Slider {
        dof = 2;
        body slider (x1, y1) { mass = 0 [kg]; }
    }
}

fn main() {}
