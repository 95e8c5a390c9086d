//! Steps and gains that are none.

use mbs_runtime::mechanism;

mechanism! {
    pub NoStep {
        dof = 1;
        feedback = held(1500 [1/s], 2000 [1/s]);
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        start { x = 1 [m]; }
    }
}

mechanism! {
    pub Negative {
        dof = 1;
        step = -1 [ms];
        feedback = held(-1 [1/s], 2000);
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        start { x = 1 [m]; }
    }
}

mechanism! {
    pub Depends {
        dof = 1;
        step = h;
        param h = 1 [ms];
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        start { x = 1 [m]; }
    }
}

mechanism! {
    pub Twice {
        dof = 1;
        method = rk4;
        method = heun;
        param l = 1 [m];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = l^2;
        start { x = 1 [m]; }
    }
}

fn main() {}
