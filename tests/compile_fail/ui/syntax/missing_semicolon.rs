//! A statement ends in `;`. The next statement is where it is missed.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg] }
        start { x = l }
        output height = y
    }
}

fn main() {}
