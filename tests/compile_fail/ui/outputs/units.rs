//! An output is in a unit of its dimension.

use mbs_runtime::mechanism;

mechanism! {
    pub Slider {
        dof = 1;
        body slider (x) { mass = 1 [kg]; }
        output position [deg] = x;
        output momentum [N] = 2 [kg]*der(x);
        output bare [mm] = 3;
    }
}

fn main() {}
