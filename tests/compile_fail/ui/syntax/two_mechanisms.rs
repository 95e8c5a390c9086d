//! One mechanism per `mechanism!`.

use mbs_runtime::mechanism;

mechanism! {
    pub A { dof = 0; }
    pub B { dof = 0; }
}

fn main() {}
