//! Functions have a fixed number of arguments.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        body slider (x3) { mass = 1 [kg]; }
        let a = sin();
        let b = sin(x3/(1 [m]), 1);
        let c = atan2(x3);
        let d = max(1, 2, 3);
        let e = der(x3, x3);
        let f = der();
    }
}

fn main() {}
