//! Units stand in brackets; a product has its `*`.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        param l1 = 60mm;
        param l2 = 180 mm;
        param omega = 200rpm;
        let twice = 2l1;
        let half = l1 2;
    }
}

fn main() {}
