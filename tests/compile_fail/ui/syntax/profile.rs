//! A profile is a name, points and a period.

use mbs_runtime::mechanism;

mechanism! {
    pub Cam {
        profile = spline((0, 1), (1, 2), (2, 1)) period 3;
        profile lift (0, 1), (1, 2), (2, 1);
        profile lift = splin((0, 1), (1, 2), (2, 1)) period 3;
        profile lift = spline [(0, 1)] period 3;
        profile lift = spline((0, 1), (1, 2), (2, 1));
        profile lift = spline((0, 1) (1, 2), (2, 1)) period 3;
        profile lift = spline(0, 1, 2) period 3;
        profile lift = spline((0, 1), (1, 2, 3), (2, 1)) period 3;
    }
}

fn main() {}
