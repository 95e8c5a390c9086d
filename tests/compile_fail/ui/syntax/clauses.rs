//! A joint takes clauses of its kind, each once, in any order.

use mbs_runtime::mechanism;

mechanism! {
    pub Gearbox {
        gear mesh (sun, planet) carrier arm;
        gear mesh (sun, planet) radii 20 [mm];
        gear mesh (sun, planet) radii (20 [mm], 40 [mm]) teeth (20, 40);
        gear mesh (sun, planet) radii (20 [mm], 40 [mm]) carrier arm carrier ground;
        gear mesh (sun, planet) radius 20 [mm];
        gear mesh (sun, planet) radi (20 [mm], 40 [mm]);
        gear mesh (sun, planet) ratio 2;
        gear mesh (sun, planet) = 2;
        internal_gear mesh (ring, planet) teeth (80, 20) at 30 deg;
        belt v_belt (driver, driven) radii (r1, r2) carrier;
        rack mesh (pinion, bar) along (1, 0);
        rack mesh (pinion, bar) radius 20 [mm];
        rolling contact (wheel, ground.track) along (1, 0) radius r at s0 s1;
        cam contact (disk, follower.tip);
        coupler screw = x;
    }
}

fn main() {}
