//! Angles of more than a turn that were meant in degrees.

use mbs_runtime::mechanism;

mechanism! {
    pub Swing {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body arm (x, y, theta) { mass = 1 [kg]; inertia = 0.1 [kg*m^2]; }
        body hand (xh, yh, phi) { mass = 1 [kg]; inertia = 0.1 [kg*m^2]; }
        body wheel (psi) { inertia = 0.1 [kg*m^2]; }
        point base on arm = (-0.5 [m], 0);
        point tip on arm = (0.5 [m], 0);
        revolute pivot (arm.base, ground);
        fixed weld (arm.tip, hand) at 90;
        torsion_spring coil (wheel, ground) { stiffness = 1 [N*m]; angle = 180; }
        start { theta = -45; guess phi = 30 [deg]; psi = 400 [rad]; }
        output height [m] = 0.5 [m]*sin(45);
        output turns = cos(6.28) + sin(30 [deg]);
    }
}

fn main() {}
