//! Gears that turn nothing, sizes that are none, couplers that couple nothing.

use mbs_runtime::mechanism;

mechanism! {
    pub Gearbox {
        dof = 1;
        param r = 20 [mm];
        body sun (phi1) { inertia = 1 [kg*m^2]; }
        body planet (phi2) { inertia = 1 [kg*m^2]; }
        body bar (x) { mass = 1 [kg]; }
        gear still (sun, bar) radii (r, 2*r);
        gear itself (sun, planet) radii (r, 2*r) carrier planet;
        internal_gear fixed_ring (ground, planet) radii (3*r, r);
        rack mesh (bar, ground) along (1, 0) radius r;
        rack turned_round (ground, bar) along (1, 0) radius r;
        gear zero (sun, planet) radii (0, 2*r);
        gear negative (sun, planet) radii (r, -20 [mm]);
        gear half (sun, planet) teeth (20, 30.5);
        rolling contact (sun, bar) along (0, 0) radius 0 [mm];
        belt loose (sun, planet) radii (r, r) carrier arm;
        coupler alone: sun.angle = t/(2 [s]);
        coupler nothing: r = 20 [mm];
    }
}

fn main() {}
