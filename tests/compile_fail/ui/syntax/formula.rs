//! What is not a formula.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        param a = ;
        let b = 2 * ;
        let c = (1, 2);
        let d = "one";
        let e = true;
        let f = 2 + (3 * );
        let h = sin(theta1 theta2);
        let i = x1 ** 2;
        let j = x1 < 2;
        let k = crank.x;
        let l = 1e999;
        let m = 0x1F [mm];
        let n = {x1};
        let o = [x1];
    }
}

fn main() {}
