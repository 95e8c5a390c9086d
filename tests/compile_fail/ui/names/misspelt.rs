//! A name that is not declared, with the nearest one that is.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 0;
        param l1 = 60 [mm];
        param omega = 200 [rpm];
        body crank (x1, y1, theta1) { mass = 0.5 [kg]; inertia = mas*l1^2; }
        constraint crank_x: x1 = l1/2*cos(thet1);
        constraint crank_y: y1 = l2/2*sinus(theta1);
        constraint guide: z1 = 0;
        drive crank_speed: theta1 = omga*t;
        torque motor on cranck = 1 [N*m];
        torque brake on wheel = 1 [N*m];
        start { theta = 0; der(x3) = 0; velocity = 0; }
        output reaction = lambda(crank_z);
        output push = lambda(wall);
        output power = omega*effort(crank_sped);
    }
}

fn main() {}
