//! A wheel needs both positions to roll, the contact holds one of them.

use mbs_runtime::mechanism;

mechanism! {
    pub Cart {
        dof = 1;
        body wheel (x, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        rolling contact (wheel, ground) along (1, 0) radius 0.3 [m];
    }
}

fn main() {}
