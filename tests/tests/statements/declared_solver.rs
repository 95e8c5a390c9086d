//! Promises of a declaration about its solver: step, gains, cost.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Baumgarte, Mechanism, PerStage, Rk4, Simulation, State, mechanism};

mechanism! {
    /// A pendulum with everything that can be promised.
    pub Pendulum {
        dof = 1;
        limit operations = 40;
        limit stack = 4096;
        const h = 0.5 [ms];
        step = h;
        feedback = per_stage(0.9/h, 1.2/h);
        param length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        start { x = length; }
    }
}

#[test]
fn the_declared_solver_is_what_runs() {
    let run = Simulation::builder(Pendulum::declared(), Pendulum::STEP).baumgarte(Pendulum::FEEDBACK);
    let run: Simulation<Pendulum, PerStage> = run.build().expect("stable");
    assert_eq!(run.step_size(), 0.5e-3);
    assert_eq!((run.baumgarte().alpha(), run.baumgarte().beta()), (1800.0, 2400.0));
}

mechanism! {
    /// A pendulum with another scheme, for which its gains are stable; for Heun's method they
    /// would not be.
    pub Accurate {
        dof = 1;
        const h = 1 [ms];
        step = h;
        method = rk4;
        feedback = per_stage(1.2/h, 2.2/h);
        param length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        start { x = length; }
    }
}

#[test]
fn gains_are_judged_with_the_declared_scheme() {
    let run = Simulation::builder(Accurate::declared(), Accurate::STEP).baumgarte(Accurate::FEEDBACK);
    let run: Simulation<Accurate, PerStage<Rk4>> = run.build().expect("stable");
    let (alpha, beta) = (run.baumgarte().alpha(), run.baumgarte().beta());
    assert!(!Baumgarte::<PerStage>::new(alpha, beta).expect("gains").is_stable(Accurate::STEP));
}

#[test]
fn the_cost_is_that_of_the_description() {
    let counted = Pendulum::<f64>::INFO.operations("stabilized").expect("a generated function");
    let mbs_runtime::Operations { mul, add, div, sin_cos, other, watch } = counted;
    assert_eq!(Pendulum::<f64>::OPERATIONS, mul + add + div + sin_cos + other + watch);
    const { assert!(Pendulum::<f64>::OPERATIONS <= 40) };
    // Time, two positions, two velocities.
    assert_eq!((Pendulum::<f64>::STATE_BYTES, Pendulum::<f32>::STATE_BYTES), (40, 20));
    assert_eq!(Pendulum::<f64>::STATE_BYTES, size_of::<State<PendulumCoordinates<f64>>>());
}
