//! What functions take.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        param l1 = 60 [mm];
        body slider (x3) { mass = 1 [kg]; }
        let a = sin(l1);
        let b = atan2(x3, 1 [kg]);
        let c = max(x3, 1);
        let d = exp(t);
        let e = l1^x3;
        let f = l1^t;
        let g = 2^l1;
        let h = l1^pi;
        let i = sqrt(l1)^(1/5);
        let l = sqrt(l1^(1/6));
        let j = (1 [kg*m])^(1/7);
    }
}

fn main() {}
