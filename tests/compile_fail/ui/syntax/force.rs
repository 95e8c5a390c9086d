//! A force acts on something.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        force weight = (0, 1) [N];
        torque motor at crank = 1 [N*m];
        force push on = 1 [N];
        force pull on slider 1 [N];
        force lift on slider = (1, 2, 3) [N];
        force half on slider = 2*(1, 2) [N];
    }
}

fn main() {}
