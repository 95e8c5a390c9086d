//! Faults that rustc finds in the code that it is given.

use mbs_runtime::gradients::Sum;
use mbs_runtime::{Simulation, mechanism};

// a limit of the stack that a step cannot promise to keep
mechanism! {
    pub Limited {
        dof = 1;
        limit stack = 512;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        start { x = 1 [m]; }
    }
}

// gains that are too large for the step
mechanism! {
    pub Unstable {
        dof = 1;
        step = 0.5 [ms];
        feedback = per_stage(2600 [1/s], 2000 [1/s]);
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        start { x = 1 [m]; }
    }
}

// a run in reverse takes transposed programs, which the declaration has to ask for
mechanism! {
    pub Pendulum {
        dof = 1;
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        start { x = 1 [m]; }
    }
}

fn main() {
    let swing = Simulation::builder(Pendulum::declared(), 1e-3);
    let _ = swing.gradient_in_reverse(&Sum::new(10, &[]), 1 << 20, |_| Ok(0.0), &mut []);
}
