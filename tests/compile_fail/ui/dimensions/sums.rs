//! Only quantities of the same dimension can be added.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        param l1 = 60 [mm];
        param m1 = 500 [g];
        param omega = 200 [rpm];
        body slider (x3) { mass = 1 [kg]; }
        let a = l1 + m1;
        let b = l1 - omega*t;
        let c = l1 + 5;
        let d = 5 - l1;
        let e = l1^2 + l1*(1 + m1);
    }
}

fn main() {}
