//! A unit is a product of powers of known units.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        param l1 = 60 [milimeter];
        param l2 = 180 [MM];
        param torque = 1 [Nm];
        param n = 1 [];
        param l3 = 1 [2*m];
        param l4 = 1 [m+m];
        param l5 = 1 [m*];
        param a = 1 [m/s s];
        param b = 1 [m^s];
        param c = 1 [m^99];
        param d = 1 [m^1.5];
        param e = 1 [m**2];
        param f = 1 ["m"];
    }
}

fn main() {}
