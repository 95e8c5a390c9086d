//! A spring connects two places and has properties.

use mbs_runtime::mechanism;

mechanism! {
    pub Swing {
        spring s = 100 [N/m];
        spring s (bob) { stiffness = 100 [N/m]; length = 1 [m]; }
        spring s (bob, ground);
        spring s (bob, ground, arm) { stiffness = 100 [N/m]; length = 1 [m]; }
        spring s (bob, ground) { stiffness: 100 [N/m]; }
        torsion_spring (arm, ground) { stiffness = 1 [N*m]; angle = 0; }
        torsion_spring s (arm) { stiffness = 1 [N*m]; angle = 0; }
    }
}

fn main() {}
