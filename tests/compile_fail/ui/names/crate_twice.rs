//! The runtime is named twice, and the mechanism like its scalar type.

use mbs_runtime::mechanism;

mechanism! {
    pub T {
        dof = 2;
        crate = ::mbs_runtime;
        crate = mbs_runtime;
        body bob (x, y) { mass = 1 [kg]; }
    }
}

fn main() {}
