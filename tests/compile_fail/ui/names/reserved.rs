//! Words of the language cannot be declared.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 2;
        param t = 1;
        param pi = 3;
        const sin = 1;
        let der = 2;
        input lambda [N];
        body crank (min, y1) { mass = 1 [kg]; }
    }
}

fn main() {}
