//! The names of a declaration become names in Rust, where keywords cannot stand.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        param type = 1;
        const static = 2;
        let in = 3;
        input loop [N];
        param gen = 4;
        param _ = 5;
        param r#fn = 6;
        revolute r#in (box, ground);
        body box (x, y) { mass = 1 [kg]; }
        body fn (move) { mass = 1 [kg]; }
        constraint where: x1 = 0;
        let a = 2*loop;
        force crate on box = (0, 0);
        start { move = 0; }
        output self = x;
    }
}

fn main() {}
