//! Names have units already.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        param l1 = 60 [mm];
        let half = l1 [mm] / 2;
        output height = y [m];
    }
}

fn main() {}
