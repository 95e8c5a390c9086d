//! Values that arithmetic does not give.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        param l1 = 60 [mm];
        param a = 1/0;
        param b = exp(1000);
        param c = ln(0);
        param d = sqrt(-2);
        param e = 0^-1;
        param f = (2 - 2)/(3 - 3);
        param g = acos(2);
        param h = 1e308 [km];
        body slider (x3) { mass = 1 [kg]; }
        let m = l1/(l1 - l1);
        let i = 0^(x3/l1);
        let j = (-8)^(1/3);
        let k = 1e300*1e300;
        let l = atan2(ln(-1), 1);
    }
}

fn main() {}
