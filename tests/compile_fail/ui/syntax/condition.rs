//! A condition compares two formulas.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        param l1 = 60 [mm] where;
        param l2 = 60 [mm] where l2;
        param l3 = 60 [mm] where l3 == 0;
        param l4 = 60 [mm] where 0 < l4 < 1;
        param l5 = 60 [mm] if l5 > 0;
        param l6 = 60 [mm] where l6 >;
    }
}

fn main() {}
