//! An input has a unit.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        input torque;
        input force = 3 [N];
        input speed [rpm] = 3;
        input level [1]
        input other [1];
    }
}

fn main() {}
