//! A formula that nests without end is refused before it can exhaust the stack.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        let a = ((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((1))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))));
    }
}

mechanism! {
    Blocks {
        dof = 1;
        body bob (x) { mass = 1 [kg]; }
        if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { if 1 > 0 { let b = 1; }}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}}
    }
}

fn main() {}
