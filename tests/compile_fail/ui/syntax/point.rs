//! A point has a name, a body and a place on it.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        point tip = (1, 0) [m];
        point tip of crank = (1, 0) [m];
        point tip on crank (1, 0) [m];
        point tip on crank = 1 [m];
        point tip on crank = (1, 0, 0) [m];
        point on crank = (1, 0) [m];
        let a = crank.tip.;
        let b = crank..tip;
    }
}

fn main() {}
