//! `crate = …;` names the path of the runtime.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        crate = 3;
        crate my_runtime;
        crate = "my_runtime";
    }
}

fn main() {}
