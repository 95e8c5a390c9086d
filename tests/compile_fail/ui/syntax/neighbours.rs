//! Words that other programs have lead to the ones of this language.

use mbs_runtime::mechanism;

mechanism! {
    pub SliderCrank {
        hinge pin (crank.tip, rod.base);
        contact floor (wheel, ground);
        damper brake (rod.tip, ground) { damping = 3 [N*s/m]; }
        slider guide (block, ground) along (1, 0);
        bushing mount (frame, ground) { stiffness = 1e6 [N/m]; }
        link bar (a, b) = 0.3 [m];
        actuator push (a, b) = 3 [N];
        velocity w = 3 [rad/s];
        initial theta = 3;
        Joint pin (crank.tip, rod.base);
    }
}

fn main() {}
