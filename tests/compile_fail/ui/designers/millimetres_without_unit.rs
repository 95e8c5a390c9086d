//! A length in millimetres added to one with a unit.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 0;
        param r = 60 [mm];
        param l = 180 [mm] + 5;
        param omega = 200 [rpm];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 2e-4 [kg*m^2]; }
        body rod    (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 4e-3 [kg*m^2]; }
        body slider (x3) { mass = 2 [kg]; }
        point base on crank = (-r/2, 0);
        point pin on crank = (r/2, 0);
        point big_end on rod = (-l/2, 0);
        point small_end on rod = (l/2, 0);
        revolute main_bearing (ground, crank.base);
        revolute crank_pin (crank.pin, rod.big_end);
        revolute wrist_pin (rod.small_end, slider);
        drive motor: theta1 = omega*t;
        start { theta1 = 0; guess x3 = l; }
    }
}

fn main() {}
