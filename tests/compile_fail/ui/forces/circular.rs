//! A force that is the reaction to itself could have any size.

use mbs_runtime::mechanism;

mechanism! {
    pub Bench {
        dof = 1;
        body block (x, y) { mass = 1 [kg]; }
        constraint wall: x = 0;
        force push on block = (lambda(wall), 0);
    }
}

fn main() {}
