//! Events: what they may be written in, and how.
use mbs_runtime::mechanism;

mechanism! {
    Door {
        dof = 0;
        param l = 1 [m];
        body leaf (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        drive motor: x = 0.1 [m/s]*t;
        event length: x = 1 [s];
        event force: lambda(rod) = 0;
        event acceleration: der(der(y)) = 0;
        event still: l = 2 [m];
        event twice: x = 0;
        event twice: y = 0;
        start { guess y = l; }
    }
}

mechanism! {
    Bad {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        event hit x = 1 [m];
        event hit: x = 1 [m] up;
        event hit: x > 1 [m];
        event: x = 1 [m];
    }
}

fn main() {}
