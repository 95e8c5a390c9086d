//! A name is expected, and something else stands there.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        param 1st = 1;
        param = 1;
        const "two" = 2;
        let 3 = 3;
        body (x, y) { mass = 1 [kg]; }
        body b (1, 2) { mass = 1 [kg]; }
        constraint 1: x1 = 0;
        force on crank = 1 [N];
        output 2 = x;
    }
}

fn main() {}
