//! Derivatives in reverse of types are those that dual numbers carry forward through the same types.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::reverse::Transposed;
use mbs_runtime::{Components, Dual, Held, Heun, Method, Projected, Simulation};
use paths::EXHAUSTIVE;
use reverse::{four_bar_free, reduced_slider_crank_free, slider_crank_free};

const STEPS: u64 = 600;
const H: f64 = 0.5e-3;
/// Partials of a dual.
const N: usize = 4;

/// The weight of a number at the end, another one for every number.
fn weight(at: usize) -> f64 {
    (1.0 + 1.3 * at as f64).sin()
}

/// All parameters, and where the first coordinate begins: the sum of weighed positions, velocities and outputs at
/// the end agrees to 1e-10 of the terms that a derivative is summed of.
fn same<M: Transposed<Real = f64>, X: Method>() {
    let builder = || Simulation::builder(M::new(M::Parameters::default()).unwrap(), H).method::<X>();
    let parameters = M::INFO.parameters.iter().map(|parameter| Variable::Parameter(parameter.name));
    let first = M::INFO.coordinates[0].name;
    let variables: Vec<Variable> = parameters.chain([Variable::Velocity(first)]).collect();
    let sum = Sum::new(STEPS, &variables);

    let [mut forward, mut sizes] = [(); 2].map(|()| vec![0.0; variables.len()]);
    let mut chunk = 0;
    let term = |run: &Simulation<M::Over<Dual<f64, N>>, X>| {
        let mut sum = Dual::default();
        if run.steps() < STEPS {
            return Ok(sum);
        }
        let (q, v) = (run.integrated().q.into_array(), run.integrated().v.into_array());
        let outputs = run.outputs()?.into_array();
        let numbers = q.as_ref().iter().chain(v.as_ref()).chain(outputs.as_ref());
        for (at, x) in numbers.enumerate() {
            let term = Dual::constant(weight(at)) * *x;
            let places = sizes.iter_mut().skip(chunk * N);
            places.zip(term.partials).for_each(|(size, partial)| *size += partial.abs());
            sum = sum + term;
        }
        chunk += 1;
        Ok(sum)
    };
    let expected = builder().gradient(&sum, term, &mut forward).unwrap();

    let mut backward = vec![0.0; variables.len()];
    let found = builder().gradient_in_reverse(
        &sum,
        1 << 20,
        |moment| {
            if moment.step < STEPS {
                return Ok(0.0);
            }
            let numbers = [moment.at.q, moment.at.v, moment.outputs()?].concat();
            let places = moment.by_q.iter_mut().chain(&mut *moment.by_v).chain(&mut *moment.by_outputs);
            places.enumerate().for_each(|(at, place)| *place = weight(at));
            Ok(numbers.iter().enumerate().map(|(at, x)| weight(at) * x).sum())
        },
        &mut backward,
    );
    let found = found.unwrap();
    // the same terms, summed in the same order
    assert!((found - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{found:e} {expected:e}");
    for (((variable, forward), backward), size) in variables.iter().zip(&forward).zip(&backward).zip(&sizes) {
        let name = M::INFO.name;
        assert!((forward - backward).abs() <= 1e-10 * size, "{name}, {variable:?}: {forward:e} {backward:e}");
    }
}

#[test]
fn slider_crank() {
    same::<slider_crank_free::SliderCrankFree, Held<Heun>>();
}

#[test]
fn others_where_all_are_asked_for() {
    if EXHAUSTIVE {
        same::<slider_crank_free::SliderCrankFree, Projected<Heun>>();
        same::<reduced_slider_crank_free::SliderCrankFree, Held<Heun>>();
        same::<four_bar_free::FourBarFree, Held<Heun>>();
    }
}
