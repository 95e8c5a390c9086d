//! One unit for one number.

use mbs_runtime::mechanism;

mechanism! {
    pub Slider {
        dof = 1;
        param l1 = 60 [mm];
        const l2 = (60 [mm]) [m];
        body slider (x) { mass = 1 [kg]; }
        let twice = (x + l1) [m];
    }
}

fn main() {}
