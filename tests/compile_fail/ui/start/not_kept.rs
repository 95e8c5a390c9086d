//! Values of a start that contradict each other: one degree of freedom takes one.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        param l1 = 60 [mm];
        param l2 = 180 [mm];
        body crank (theta1) { inertia = 1 [kg*m^2]; }
        body rod (theta2) { inertia = 1 [kg*m^2]; }
        body slider (x3) { mass = 1 [kg]; }
        constraint along: x3 = l1*cos(theta1) + l2*cos(theta2);
        constraint across: l1*sin(theta1) + l2*sin(theta2) = 0;
        start { theta1 = 90 [deg]; x3 = 200 [mm]; der(theta1) = 1 [rad/s]; der(x3) = 2 [m/s]; }
    }
}

mechanism! {
    pub Pendulum {
        dof = 1;
        body bob (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point up on bob = (0, 1 [m]);
        revolute pivot (bob.up, ground);
        start { x = 0; y = -1 [m]; phi = 30 [deg]; }
    }
}

fn main() {}
