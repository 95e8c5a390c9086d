//! A body has coordinates in parentheses and properties in braces.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        body crank { mass = 1 [kg]; }
        body rod (x, y, theta);
        body slider (x3) { mass: 2 [kg]; }
        body other (x4 y4) { mass = 2 [kg]; }
        body wheel (x = ) { mass = 2 [kg]; }
    }
}

fn main() {}
