//! The slider-crank without its guide.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 0;
        param l1 = 60 [mm];
        param l2 = 180 [mm];
        param omega = 200 [rpm];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 1 [kg*m^2]; }
        body rod    (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 1 [kg*m^2]; }
        body slider (x3)             { mass = 2 [kg]; }
        constraint crank_x: x1 = l1/2*cos(theta1);
        constraint crank_y: y1 = l1/2*sin(theta1);
        drive crank_speed: theta1 = omega*t;
        constraint rod_x: x2 = l1*cos(theta1) + l2/2*cos(theta2);
        constraint rod_y: y2 = l1*sin(theta1) + l2/2*sin(theta2);
        constraint slider: x3 = l1*cos(theta1) + l2*cos(theta2);
    }
}

fn main() {}
