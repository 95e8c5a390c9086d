//! Points belong to bodies.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 4;
        body crank (x1, y1, theta1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body slider (x3) { mass = 1 [kg]; }
        body ground (x4) { mass = 1 [kg]; }
        point tip on crank = (30 [mm], 0);
        point tip on crank = (-30 [mm], 0);
        point x on crank = (0, 0);
        point base on crnk = (0, 0);
        point rail on wall = (0, 0);
        revolute pin (crank.tpi, slider);
        revolute hinge (crank.base, slidr);
        revolute end (tip, slider);
        force pull on crank.top = (1, 0) [N];
        force lift on x3.tip = (1, 0) [N];
        let a = crank.tip;
        let b = crank.theta;
        let c = crank.tip.z;
        let d = crank.tip.x.y;
        let e = wheel.x;
        let f = tip.x;
        output g = lambda(pin);
        output h = lambda(pin_z);
    }
}

fn main() {}
