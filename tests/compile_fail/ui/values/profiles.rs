//! A profile is three or more points, ascending, within one period.

use mbs_runtime::mechanism;

mechanism! {
    pub Cam {
        dof = 1;
        param r = 20 [mm];
        body disk (phi) { inertia = 1 [kg*m^2]; }
        profile few = spline((0, 1), (1, 2)) period 3;
        profile order = spline((0, 1), (2, 2), (1, 2)) period 3;
        profile twice = spline((0, 1), (1, 2), (1, 2)) period 3;
        profile beyond = spline((0 [deg], 1), (120 [deg], 2), (360 [deg], 1)) period 360 [deg];
        profile backwards = spline((0, 1), (1, 2), (2, 2)) period -3;
        profile degrees = spline((0, 1), (90, 2), (180, 1)) period 360 [deg];
        profile of_parameters = spline((0, r), (1, 2*r), (2, r)) period 3;
        profile of_itself = spline((0, other(0)), (1, 2), (2, 1)) period 3;
        profile other = spline((0, 0), (1, 2), (2, 1)) period 3;
        profile steep = spline((0, 0), (1e-300, 1e300), (2, 1)) period 3;
        profile sin = spline((0, 0), (1, 2), (2, 1)) period 3;
        profile harmonic = spline((0, 0), (1, 2), (2, 1)) period 3;
        profile r = spline((0, 0), (1, 2), (2, 1)) period 3;
        profile other = spline((0, 0), (1, 2), (2, 1)) period 3;
    }
}

fn main() {}
