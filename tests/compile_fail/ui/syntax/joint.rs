//! A joint connects two places.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        revolute (crank.tip, rod.base);
        revolute pin: crank.tip = rod.base;
        revolute pin (crank.tip);
        revolute pin (crank.tip rod.base);
        revolute pin (crank.tip, rod.base, slider);
        revolute pin (crank.tip, rod.base) at 3;
        revolute pin (crank.tip.x, rod.base);
        prismatic guide (slider, ground);
        prismatic guide (slider, ground) along x;
        prismatic guide (slider, ground) at 90 [deg];
        point_on_line slot (rod.end, ground) on (1, 0);
        distance link (bob, ground);
        distance link (bob, ground) 0.5 [m];
        fixed weld (arm.end, hand.base) = 90 [deg];
        revolut pin (crank.tip, rod.base);
    }
}

fn main() {}
