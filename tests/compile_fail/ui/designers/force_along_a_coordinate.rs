//! A coordinate is written by its name, and a start too.

use mbs_runtime::mechanism;

mechanism! {
    pub Block {
        dof = 2;
        body block (xb, y) { mass = 1 [kg]; }
        point edge on block = (0.1 [m], 0);
        force push on block.x = 3 [N];
        force pull on block.y = 3 [N];
        spring hold (block.xb, ground) { stiffness = 1 [N/m]; length = 0; }
        torque turn on block.angle = 1 [N*m];
    }
}

mechanism! {
    pub Started {
        dof = 2;
        body block (xb, y) { mass = 1 [kg]; }
        point edge on block = (0.1 [m], 0);
        start { block.edge.x = 1 [m]; block.y = 2 [m]; blok.x = 1 [m]; }
    }
}

fn main() {}
