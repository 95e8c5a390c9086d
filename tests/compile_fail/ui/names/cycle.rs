//! Definitions that need each other.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        body slider (x3) { mass = 1 [kg]; }
        let a = b + 1;
        let b = 2*c;
        let c = a^2;
        const d = d + 1;
        let e = e;
    }
}

fn main() {}
