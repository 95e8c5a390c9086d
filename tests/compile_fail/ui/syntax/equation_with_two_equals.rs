//! One equation, one `=`.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        param l = 1 [m];
        constraint rod: x == l;
        constraint twice: x = y = l;
    }
}

fn main() {}
