//! Gains that are too large for the step.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 1;
        step = 0.5 [ms];
        feedback = per_stage(2600 [1/s], 2000 [1/s]);
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        start { x = 1 [m]; }
    }
}

fn main() {}
