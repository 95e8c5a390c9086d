//! Names that cannot stand in a formula by themselves.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        dof = 1;
        param l1 = 60 [mm];
        body crank (x1, y1) { mass = 1 [kg]; }
        constraint crank_x: x1 = l1;
        let a = crank*2;
        let b = crank_x;
        let c = sin;
        let d = 60*mm;
        let e = l1(x1 + y1);
        let f = lambda(2*crank_x);
        let g = lambda(crank_x, crank_x);
        let h = effort(crank_x);
        let i = effort;
        let j = step(x1);
    }
}

fn main() {}
