//! A joint of several rows has several multipliers.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 0;
        body rod (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point end on rod = (1 [m], 0);
        revolute pin (rod.end, ground);
        drive turn: phi = 3 [rad/s]*t;
        output a = lambda(pin);
        output b = effort(pin);
        output c = effort(pin_x);
        output d = reaction(turn);
    }
}

fn main() {}
