//! A component along which the body cannot move would be dropped: refused.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 3;
        param f = 3 [N];
        body slider (x3) { mass = 1 [kg]; }
        body lift (y4) { mass = 1 [kg]; }
        body wheel (theta5) { inertia = 1 [kg*m^2]; }
        force push on slider = (f, f);
        force pull on lift = (f*sin(y4/(1 [m])), 0);
        torque motor on slider = 1 [N*m];
        force turn on wheel = (f, 2*f);
    }
}

fn main() {}
