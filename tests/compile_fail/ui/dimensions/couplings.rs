//! Radii are lengths, teeth are counted, offsets fit what moves.

use mbs_runtime::mechanism;

mechanism! {
    pub Gearbox {
        dof = 1;
        param r = 20 [mm];
        body sun (phi1) { inertia = 1 [kg*m^2]; }
        body planet (phi2) { inertia = 1 [kg*m^2]; }
        body bar (x) { mass = 1 [kg]; }
        gear bare (sun, planet) radii (20, 40);
        gear counted (sun, planet) teeth (20 [mm], 40 [mm]);
        gear shifted (sun, planet) radii (r, 2*r) at r;
        belt half (sun, planet) radii (r, 2);
        rack mesh (sun, bar) along (1, 0) radius 2;
        rack other (sun, bar) along (1, 0) radius r at 30 [deg];
        coupler screw: bar.x = 2*sun.angle;
    }
}

fn main() {}
