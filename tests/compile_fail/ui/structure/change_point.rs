//! A parallelogram that starts with all its links on one line: it is singular
//! there and nowhere else, so no constraint is redundant.

use mbs_runtime::mechanism;

mechanism! {
    pub Parallelogram {
        dof = 1;
        param l = 1 [m];
        param w = 2 [m];
        body left  (theta1) { inertia = 1 [kg*m^2]; }
        body right (theta2) { inertia = 1 [kg*m^2]; }
        body top   (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        constraint left_x:  l*cos(theta1) = x;
        constraint left_y:  l*sin(theta1) = y;
        constraint right_x: w + l*cos(theta2) = x + w*cos(theta);
        constraint right_y: l*sin(theta2) = y + w*sin(theta);
        start { x = 1 [m]; }
    }
}

fn main() {}
