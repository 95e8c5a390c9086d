//! A parallelogram with a spare link: no equation repeats another one in
//! general, but at these lengths one of them does.

use mbs_runtime::mechanism;

mechanism! {
    pub Parallelogram {
        dof = 0;
        param l = 1 [m];
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
        constraint spare_x: a + l*cos(theta3) = x + a*cos(theta);
        constraint spare_y: l*sin(theta3) = y + a*sin(theta);
        start { theta1 = 1; guess theta2 = 1; guess theta3 = 1; guess x = 0.5 [m]; guess y = 0.8 [m]; }
    }
}

fn main() {}
