//! Gravity is a vector.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        gravity = 9.81 [m/s^2];
        gravity = -9.81;
        gravity = (-9.81) [m/s^2];
        gravity = (0, 0, -9.81) [m/s^2];
        gravity = (0 -9.81) [m/s^2];
        gravity = [0, -9.81];
    }
}

fn main() {}
