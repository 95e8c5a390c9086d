//! A parameter is a number; computed values are `const` or `let`.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        const r = 60 [mm];
        param l1 = 2*r;
        param l2 = 60 [mm] + 3 [mm];
        param l0 = 60 [mm];
        param l3 = 2*l0;
        const c = 2*l0;
        body slider (x3) { mass = 1 [kg]; }
    }
}

fn main() {}
