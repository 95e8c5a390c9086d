//! A start lists coordinates and their rates.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        start { theta1 = 0 }
    }
}
mechanism! {
    pub SliderCrank2 {
        start { der(theta1 + theta2) = 0; }
    }
}
mechanism! {
    pub SliderCrank3 {
        start { der theta1 = 0; }
    }
}
mechanism! {
    pub SliderCrank4 {
        start = { theta1 = 0; }
    }
}
mechanism! {
    pub SliderCrank5 {
        start theta1 = 0;
    }
}

fn main() {}
