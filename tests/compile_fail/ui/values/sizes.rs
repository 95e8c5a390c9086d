//! Lengths and radii are positive, whatever formula they come from.

use mbs_runtime::mechanism;

mechanism! {
    pub Numbers {
        dof = 1;
        body bob (x, y) { mass = 1 [kg]; }
        distance link (bob, ground) = -1 [m];
        start { y = 1 [m]; }
    }
}

mechanism! {
    pub Formulas {
        dof = 3;
        param l = 1 [m];
        param gap = 1 [m];
        param teeth = -20;
        body bob (x, y) { mass = 1 [kg]; }
        distance link (bob, ground) = 0.3 [m] - gap;
        body end (xe, ye) { mass = 1 [kg]; }
        distance string (end, bob) = l - gap;
        body wheel (xw, yw, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        rolling contact (wheel, ground) along (1, 0) radius sqrt(l*gap) - 2*l;
        body fan (angle = turn) { inertia = 1 [kg*m^2]; }
        belt strap (wheel, fan) teeth (20, teeth);
        start { y = 1 [m]; }
    }
}

fn main() {}
