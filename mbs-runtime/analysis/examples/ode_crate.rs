//! A mechanism given to a solver of another crate, from nothing but the documentation of both: the
//! functions f and ∂f/∂y of `FirstOrder` go where the crate asks for them. The crate here is diffsol
//! with its backward differentiation formulas; another one takes the same two functions.
//!
//! `cargo run --release -p mbs-analysis --features bdf --example ode_crate`

use std::error::Error;

use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, Vector};
use mbs_analysis::FirstOrder;
use mbs_analysis::nalgebra::{DMatrix, DVector};
use mbs_runtime::equations::Differentiated;
use mbs_runtime::{Simulation, mechanism};

mechanism! {
    /// A weight on a bar that falls into grease.
    pub Damped {
        dof = 1;
        param length = 0.3 [m];
        param grease = 2e3 [N*m*s];
        gravity = (0, -9.81) [m/s^2];
        body bar (x, y, phi) { mass = 4 [kg]; inertia = 0.03 [kg*m^2]; }
        point end on bar = (-length/2, 0);
        revolute hinge (bar.end, ground);
        torque damper on bar = -grease*der(phi);
        start { phi = 0.5; guess x = 0.13 [m]; guess y = 0.07 [m]; }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    // the mechanism, at a start that meets its constraints
    let system = FirstOrder::new(Differentiated(Damped::declared()))?;
    let start = system.state(&Simulation::new(Damped::declared(), 1e-3)?);

    // f, and products of ∂f/∂y with a vector, because that is what this crate asks for
    let of_slopes = system.clone();
    let slope = move |y: &[f64], _: &[f64], t: f64, f: &mut [f64]| of_slopes.derivative(t, y, f);
    let of_products = system.clone();
    let product = move |y: &[f64], _: &[f64], t: f64, x: &[f64], product: &mut [f64]| {
        let mut jacobian = DMatrix::zeros(y.len(), y.len());
        of_products.jacobian(t, y, &mut jacobian);
        product.copy_from_slice((jacobian * DVector::from_column_slice(x)).as_slice());
    };

    let n = system.dimension();
    let mut problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(1e-6)
        .atol(vec![1e-9; n])
        .rhs_implicit(slope, product)
        .init(move |_, _, y| y.copy_from_slice(&start), n)
        .build()?;
    // of stiff forces that turn with a mechanism it has to solve more often, and more finely
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    problem.ode_options.nonlinear_solver_tolerance = 0.02;

    let mut solver = problem.bdf::<NalgebraLU<f64>>()?;
    println!("   t [s]    phi [rad]   steps");
    for sample in 1..=5 {
        let t = 200.0 * f64::from(sample);
        while solver.state().t < t {
            solver.step()?;
        }
        let y = solver.interpolate(t)?.clone_as_vec();
        // all coordinates, in the order of the declaration
        let [q, _] = system.completed(t, &y);
        println!("{t:8.0} {:12.6} {:7}", q[2], solver.get_statistics().number_of_steps);
    }
    Ok(())
}
