//! Only doc comments can stand before a statement.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        #[allow(unused)]
        param l1 = 60 [mm];
        #[doc(hidden)]
        param l2 = 60 [mm];
    }
}
mechanism! {
    #[derive(Clone)]
    pub Pendulum { dof = 0; }
}

fn main() {}
