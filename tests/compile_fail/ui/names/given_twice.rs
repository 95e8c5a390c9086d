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
        start { y = 1 [m]; }
        redundant = minimum_norm;
        redundant = minimum_norm;
        states = all;
        states = reduced;
        gradients = reverse;
        gradients = reverse;
        limit operations = 100;
        limit operations = 200;
        limit stack = 4096;
        limit stack = 8192;
        limit unrolled = 0;
        limit unrolled = 1;
        step = 1 [ms];
        step = 2 [ms];
        feedback = held(1 [1/s], 1 [1/s]);
        feedback = held(2 [1/s], 2 [1/s]);
    }
}

fn main() {}
