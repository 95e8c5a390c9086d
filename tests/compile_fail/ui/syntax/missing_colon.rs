//! A constraint and a drive have a name and a `:`.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        constraint rod x^2 + y^2 = l^2;
        constraint x^2 + y^2 = l^2;
        drive theta = omega*t;
        drive : theta = omega*t;
    }
}

fn main() {}
