//! Joints that join nothing, and directions that are none.

use mbs_runtime::mechanism;

mechanism! {
    pub Slider {
        dof = 3;
        body slider (x) { mass = 1 [kg]; }
        body wheel (theta) { inertia = 1 [kg*m^2]; }
        body cart (x5, y5) { mass = 1 [kg]; }
        revolute pin (slider, ground);
        revolute axle (wheel, ground);
        prismatic guide (slider, ground) along (1, 0);
        fixed weld (slider, slider);
        prismatic none (cart, ground) along (0, 0);
        distance zero (cart, ground) = 0;
        point_on_line same (wheel, ground) along (1, 0);
    }
}

fn main() {}
