//! A definition needs its `=`.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof 1;
        param l 1 [m];
        const two 2;
        let half: l/2;
        gravity (0, -9.81) [m/s^2];
        body bob (x, y) { mass 1 [kg]; }
        constraint rod: x^2 + y^2;
        force wind on bob (1, 0) [N];
        start { x 1 [m]; }
        output height [m] y;
    }
}

fn main() {}
