//! A damper is a spring without stiffness, and needs no free length or angle.

use mbs_runtime::mechanism;

mechanism! {
    pub Dampers {
        dof = 2;
        body block (x) { mass = 1 [kg]; }
        body wheel (phi) { inertia = 1 [kg*m^2]; }
        spring brake (block, ground) { stiffness = 0; damping = 1 [N*s/m]; }
        torsion_spring drag (wheel, ground) { stiffness = 0; damping = 1 [N*m*s]; }
        spring slack (block, ground) { stiffness = 0; length = 1 [m]; }
        torsion_spring loose (wheel, ground) { stiffness = 1 [N*m]; }
    }
}

fn main() {}
