//! A constraint cannot depend on the reaction of a joint.

use mbs_runtime::mechanism;

mechanism! {
    pub Bench {
        dof = 0;
        body arm (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        revolute pin (ground, arm);
        constraint held: phi = reaction(pin)/(1 [N]);
    }
}

fn main() {}
