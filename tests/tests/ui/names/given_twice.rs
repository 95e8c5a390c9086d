//! Statements that stand once.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 2;
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        gravity = (0, 9.81) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        start { x = 1 [m]; }
        start { x = 2 [m]; }
    }
}

fn main() {}
