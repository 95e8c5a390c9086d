//! Equations that are met where their derivatives vanish, or nowhere.

use mbs_runtime::mechanism;

mechanism! {
    pub Square {
        dof = 1;
        body a (x = x) { mass = 1 [kg]; }
        body b (x = y) { mass = 1 [kg]; }
        constraint equal: (x - y)^2 = 0;
        start { x = 1 [m]; }
    }
}

mechanism! {
    pub AtInfinity {
        dof = 0;
        body a (angle = x) { inertia = 1 [kg*m^2]; }
        constraint never: exp(x) = 0;
    }
}

fn main() {}
