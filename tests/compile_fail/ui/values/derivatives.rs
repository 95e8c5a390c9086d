//! `der` is taken of what the equations determine.

use mbs_runtime::mechanism;

mechanism! {
    pub Slider {
        dof = 1;
        input push [N];
        body slider (x) { mass = 1 [kg]; }
        force pushed on x = push;
        constraint rest: x = 0;
        output jerk = der(der(der(x)));
        output change = der(push);
        output rise = der(lambda(rest));
    }
}

fn main() {}
