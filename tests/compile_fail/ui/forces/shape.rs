//! A force on a body is a vector, a torque or a force along a coordinate a scalar.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 3;
        body crank (x1, y1, theta1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        force push on crank = 3 [N];
        torque motor on crank = (1, 2) [N*m];
        force pull on x1 = (1, 2) [N];
    }
}

fn main() {}
