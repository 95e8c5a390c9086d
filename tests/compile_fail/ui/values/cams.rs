//! The profile of a cam closes around a turn.

use mbs_runtime::mechanism;

mechanism! {
    pub Cams {
        dof = 1;
        param lobes = 2.5;
        body disk (phi) { inertia = 1 [kg*m^2]; }
        body spiral (ya) { mass = 1 [kg]; }
        body heart (yb) { mass = 1 [kg]; }
        body lobed (yc) { mass = 1 [kg]; }
        body whole (yd) { mass = 1 [kg]; }
        cam a (disk, spiral) = 20 [mm] + 2 [mm]*angle;
        cam b (disk, heart) = 20 [mm] + 2 [mm]*abs(angle);
        cam c (disk, lobed) = 20 [mm] + 2 [mm]*cos(lobes*angle + 1);
        cam d (disk, whole) = 20 [mm] + 2 [mm]*cos(3*angle + 1);
        start { guess ya = 20 [mm]; guess yb = 20 [mm]; guess yc = 20 [mm]; guess yd = 20 [mm]; }
    }
}

fn main() {}
