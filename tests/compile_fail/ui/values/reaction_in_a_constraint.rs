//! A constraint cannot depend on reactions, by way of a definition either.

use mbs_runtime::mechanism;

mechanism! {
    pub Slider {
        dof = 0;
        body slider (x, y) { mass = 1 [kg]; }
        let pull = lambda(guide);
        constraint spring: x = pull/(1 [N/m]);
        constraint guide: y = 0;
    }
}

fn main() {}
