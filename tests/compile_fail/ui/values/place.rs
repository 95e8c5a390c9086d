//! What may stand where: constants are numbers, masses fixed, constraints in
//! positions, forces without accelerations.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 0;
        param l1 = 60 [mm] where l1 > x3;
        input torque [N*m];
        const twice_l1 = 2*l1;
        let speed = der(theta1);
        let twice = 2*speed;
        gravity = (0 [m/s^2], x3/t^2);
        body crank (x1, y1, theta1) { mass = 1 [kg]; inertia = x1*1 [kg*m]; }
        body slider (x3) { mass = t*1 [kg/s]; }
        constraint by_input: x1 = l1*cos(theta1) + torque/(1 [N]);
        constraint by_rate: der(y1) = 0;
        constraint by_name: theta1 = twice*t;
        constraint by_reaction: x3*lambda(by_rate)/(1 [N]) = 0;
        drive speed_drive: theta1 = torque/(1 [N*m]);
        torque brake on crank = -der(speed)*(1 [kg*m^2]);
        start { theta1 = x1/l1; der(theta1) = speed; }
    }
}

fn main() {}
