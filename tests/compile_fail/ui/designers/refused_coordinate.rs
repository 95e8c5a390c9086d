//! What uses a coordinate that was refused has no error of its own.

use mbs_runtime::mechanism;

mechanism! {
    pub Unclear {
        dof = 1;
        body block (q) { mass = 1 [kg]; }
        body twice (xa, xb) { mass = 1 [kg]; }
        body many (xm, ym, phim, zm) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point edge on block = (0.1 [m], 0);
        prismatic guide (block.edge, ground) along (1, 0);
        constraint with: q = xb + zm;
        force push on q = 3 [N];
        force pull on block = (3 [N], 0);
        spring hold (block, twice) { stiffness = 1 [N/m]; length = 0; }
        start { q = 3 [m]; der(q) = 0; guess xb = 1 [m]; }
        output where_it_is = q + block.edge.x;
        output held [N] = lambda(guide_normal);
    }
}

fn main() {}
