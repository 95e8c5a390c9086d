//! A pendulum with a closed form that several tests hold runs to.

use mbs_runtime::mechanism;

mechanism! {
    /// A bob on a rod, released from the side.
    pub Swing {
        dof = 1;
        param length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        start { x = length; guess y = 0; }
        output tension [N] = 2*length*lambda(rod);
    }
}

/// A quarter of its period, K(1/√2) √(l/g) with the complete elliptic integral K: the time in s
/// from the side to the bottom.
pub fn quarter_period() -> f64 {
    1.854_074_677_301_372 / 9.81_f64.sqrt()
}
