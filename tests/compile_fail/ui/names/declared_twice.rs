//! A second declaration of a name points at the first one.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 0;
        param l1 = 60 [mm];
        param l1 = 180 [mm];
        const l1 = 3;
        input l1 [N];
        body crank (x1, y1, theta1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; mass = 2 [kg]; }
        body crank (x2) { mass = 1 [kg]; }
        body slider (x1) { mass = 1 [kg]; }
        constraint crank_x: x1 = l1*cos(theta1);
        constraint crank_x: y1 = l1*sin(theta1);
        drive crank_x: theta1 = t/(1 [s]);
        force push on crank = (1, 0) [N];
        torque push on crank = 1 [N*m];
        start { theta1 = 0; theta1 = 1; der(theta1) = 0; der(theta1) = 1 [1/s]; }
        output path = x1;
        output path = y1;
    }
}

fn main() {}
