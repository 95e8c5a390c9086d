//! A start that is assembled, but singular there and nowhere else: the massless
//! knee of two links that are stretched out.

use mbs_runtime::mechanism;

mechanism! {
    pub Stretched {
        dof = 2;
        body upper (x1, y1, p1) { mass = 0; inertia = 0; }
        body lower (x2, y2, p2) { mass = 1 [kg]; inertia = 0; }
        point top on upper = (0, 1 [m]);
        point top on lower = (0, 1 [m]);
        revolute hip (upper.top, ground);
        revolute knee (upper, lower.top);
        start { guess y1 = -1 [m]; guess y2 = -2 [m]; }
    }
}

fn main() {}
