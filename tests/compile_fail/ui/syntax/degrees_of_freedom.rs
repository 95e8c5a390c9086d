//! The contract is a whole number.

use mbs_runtime::mechanism;

mechanism! {
    pub A {
        dof = n;
    }
}
mechanism! {
    pub B {
        dof = 1.5;
    }
}
mechanism! {
    pub C {
        dof = 1 + 1;
    }
}
mechanism! {
    pub D {
        dof = 99999999999999999999;
    }
}
mechanism! {
    pub E {
        dof = 1 [m];
    }
}

fn main() {}
