//! Arguments and values of a profile have one dimension each, which formulas keep.

use mbs_runtime::mechanism;

mechanism! {
    pub Cam {
        dof = 1;
        body disk (phi) { inertia = 1 [kg*m^2]; }
        body follower (x) { mass = 1 [kg]; }
        profile mixed = spline((0 [deg], 20 [mm]), (1 [mm], 25 [mm]), (180 [deg], 20)) period 1 [s];
        profile lift = spline((0 [deg], 20 [mm]), (90 [deg], 25 [mm]), (180 [deg], 20 [mm])) period 360 [deg];
        constraint a: x = lift(t);
        constraint b: phi = lift(phi);
        constraint c: x = lift(phi, x);
        constraint d: x = lift;
        constraint e: x = lif(phi);
        cam contact (disk, follower) = 2 + cos(angle);
        cam other (disk, follower) = 2 [mm]*angle*t;
        constraint f: x = 1 [m]*angle;
    }
}

fn main() {}
