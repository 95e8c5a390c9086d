//! A four-bar whose links reach 1.5 m of 1.55 m, started on one line: Newton's
//! iteration stands still there, and no other start closes either.

use mbs_runtime::mechanism;

mechanism! {
    pub FourBar {
        dof = 1;
        body a (x1, y1, p1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body b (x2, y2, p2) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body c (x3, y3, p3) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point tip on a = (0.5 [m], 0);
        point tip on b = (0.5 [m], 0);
        point tip on c = (0.5 [m], 0);
        point far on ground = (1.55 [m], 0);
        revolute j1 (a, ground);
        revolute j2 (a.tip, b);
        revolute j3 (b.tip, c);
        revolute j4 (c.tip, ground.far);
    }
}

fn main() {}
