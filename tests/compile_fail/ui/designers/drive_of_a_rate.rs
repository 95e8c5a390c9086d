//! A motor of constant speed, written as a rate.

use mbs_runtime::mechanism;

mechanism! {
    pub Turntable {
        dof = 0;
        param omega = 200 [rpm];
        body table (phi) { inertia = 1 [kg*m^2]; }
        body disk (psi) { inertia = 1 [kg*m^2]; }
        drive motor: der(phi) = 3 [rad/s];
        drive other: der(disk.angle) = omega;
    }
}

fn main() {}
