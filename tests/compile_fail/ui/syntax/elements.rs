//! Force elements: places, direction and properties are expected where they
//! belong.

use mbs_runtime::mechanism;

mechanism! {
    pub Bench {
        motor m = 3 [N*m];
        motor n (rotor) { stall = 2 [N*m]; }
        friction f (block, ground) { coefficient = 0.3; }
        drag air (ball) { density = 1; }
        drag gust on ball;
        torsion_friction g (arm, ground) { torque: 3 [N*m]; }
        mottor p (rotor, ground) { stall = 2 [N*m]; }
    }
}

fn main() {}
