//! A spare link that is 1 mm too short to be spare.

use mbs_runtime::mechanism;

mechanism! {
    pub Parallelogram {
        dof = 1;
        redundant = minimum_norm;
        param l = 1 [m];
        param third = 0.999 [m];
        param w = 2 [m];
        param a = 0.3 [m];
        body left  (theta1) { inertia = 1 [kg*m^2]; }
        body right (theta2) { inertia = 1 [kg*m^2]; }
        body spare (theta3) { inertia = 1 [kg*m^2]; }
        body top   (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        constraint left_x:  l*cos(theta1) = x;
        constraint left_y:  l*sin(theta1) = y;
        constraint right_x: w + l*cos(theta2) = x + w*cos(theta);
        constraint right_y: l*sin(theta2) = y + w*sin(theta);
        constraint spare_x: a + third*cos(theta3) = x + a*cos(theta);
        constraint spare_y: third*sin(theta3) = y + a*sin(theta);
        start { theta1 = 1; guess theta2 = 1; guess theta3 = 1; guess x = 0.5 [m]; guess y = 0.8 [m]; }
    }
}

fn main() {}
