//! A statement begins with a word of the language.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        parameter l1 = 60 [mm];
        constrain crank_x: x1 = l1/2*cos(theta1);
        revolute pin (crank, rod);
        mass = 2 [kg];
        = 3;
        "l1" = 3;
    }
}

fn main() {}
