//! A run in reverse takes transposed programs, which the declaration has to ask for.

use mbs_runtime::gradients::Sum;
use mbs_runtime::{Simulation, mechanism};

mechanism! {
    pub Pendulum {
        dof = 1;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        start { x = 1 [m]; guess y = 0; }
    }
}

fn main() {
    let swing = Simulation::builder(Pendulum::declared(), 1e-3);
    let _ = swing.gradient_in_reverse(&Sum::new(10, &[]), 1 << 20, |_| Ok(0.0), &mut []);
}
