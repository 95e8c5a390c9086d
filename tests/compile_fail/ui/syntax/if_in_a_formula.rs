//! `if` chooses statements; a value is chosen by a function.

use mbs_runtime::mechanism;

mechanism! {
    pub Stop {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        let press = if x > 0 { -1000 [N/m]*x } else { 0 };
        force stop on x = if (x > 0) { 1 [N] } else if x < -1 [m] { 2 [N] } else { 0 [N] };
        output y = if x;
    }
}

fn main() {}
