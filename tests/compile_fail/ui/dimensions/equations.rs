//! Both sides of an equation have the same dimension.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 0;
        param l1 = 60 [mm];
        param m1 = 500 [g];
        param omega = 200 [deg];
        body crank (x1, y1, theta1) { mass = m1; inertia = m1*l1^2; }
        constraint crank_x: x1 = m1*cos(theta1);
        constraint crank_y: y1 = sin(theta1);
        drive crank_speed: theta1 = omega*t;
    }
}

fn main() {}
