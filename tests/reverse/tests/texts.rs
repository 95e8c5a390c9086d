//! Derivatives in reverse of types are those of their texts, to the last bit: by all parameters, inputs and a
//! start, of states and outputs, whatever part of the states is kept. Those of the texts of all mechanisms of
//! the library are held to dual numbers (`mbs-runtime/live/tests/reverse.rs`).
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

use std::fs;
use std::path::Path;

use mbs_live::{Live, Run, Text};
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::reverse::{Moment, Transposed};
use mbs_runtime::{Error, Held, Heun, Info, Method, PerStage, Projected, Rk4, Simulation};
use paths::EXHAUSTIVE;
use reverse::block_on_incline::BlockOnIncline;
use reverse::cam_follower::CamFollower;
use reverse::dc_motor::DcMotor;
use reverse::four_bar_free::FourBarFree;
use reverse::n_four_bar::NFourBar10;
use reverse::slider_crank::SliderCrank;
use reverse::slider_crank_free::SliderCrankFree;
use reverse::spring_mass_damper::SpringMassDamper;
use reverse::tipper::Tipper;

const STEPS: u64 = 30;
const H: f64 = 0.47e-3;

/// The weight of a number in the sum, another one for every number and every step.
fn weight(step: u64, at: usize) -> f64 {
    (1.0 + 0.7 * step as f64 + 1.3 * at as f64).sin()
}

/// All positions, velocities and outputs, weighed.
fn term(moment: &mut Moment<'_>) -> Result<f64, Error> {
    let numbers = [moment.at.q, moment.at.v, moment.outputs()?].concat();
    let places = moment.by_q.iter_mut().chain(&mut *moment.by_v).chain(&mut *moment.by_outputs);
    places.enumerate().for_each(|(at, place)| *place = weight(moment.step, at));
    Ok(numbers.iter().enumerate().map(|(at, x)| weight(moment.step, at) * x).sum())
}

/// All parameters, all inputs over a part of the run, and where the first coordinate begins.
fn variables(info: &Info) -> Vec<Variable> {
    let parameters = info.parameters.iter().map(|parameter| Variable::Parameter(parameter.name));
    let inputs = info.inputs.iter().map(|input| Variable::Input { name: input.name, from: 7, until: 23 });
    let first = info.coordinates[0].name;
    parameters.chain(inputs).chain([Variable::Position(first), Variable::Velocity(first)]).collect()
}

/// The sum and its derivatives as bits.
type Bits = Vec<u64>;

fn bits(run: impl FnOnce(&mut [f64]) -> Result<f64, Error>, count: usize) -> Bits {
    let mut gradient = vec![0.0; count];
    let value = run(&mut gradient).unwrap();
    gradient.iter().chain([&value]).map(|number| number.to_bits()).collect()
}

/// The type and its text, with a method, with all states and with few.
fn same<M: Transposed<Real = f64>, X: Method>(live: &Live) {
    let info = M::INFO;
    let variables = variables(info);
    let signal = |step: u64, at: usize| 0.3 + 0.2 * at as f64 + 0.01 * step as f64;
    let sum = Sum::new(STEPS, &variables).driven_by(&signal);
    let builder = Run::builder(live, H).method(X::EXPLICIT);
    let text =
        bits(|gradient| builder.gradient_in_reverse(&sum, usize::MAX, term, gradient), variables.len());
    // ten states, and the steps between two of them
    for memory in [usize::MAX, 2 * 8 * info.states.len() * 12] {
        let builder = Simulation::builder(M::new(M::Parameters::default()).unwrap(), H).method::<X>();
        let found =
            bits(|gradient| builder.gradient_in_reverse(&sum, memory, term, gradient), variables.len());
        assert_eq!(found, text, "{}, {:?}", info.name, X::EXPLICIT.stabilization);
    }
}

/// A text of the library with more statements.
fn text(file: &str, statements: &str) -> Text {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src").join(file);
    let source = fs::read_to_string(path).unwrap();
    // chains are made by a macro
    let source = source.replace("$(#[$($attribute)*])*", "").replace("$Name", "Chain").replace("$n", "10");
    Text::rust(file, source.replace(" dof = ", &format!(" {statements} dof = ")))
}

/// A text with the statement, and one without it that is compiled for that.
#[test]
fn the_statement_is_enough() {
    let live = text("slider_crank_free.rs", "gradients = reverse;").compile().unwrap();
    same::<SliderCrankFree, Held<Heun>>(&live);
    let live = text("slider_crank_free.rs", "").compile_with_transposes().unwrap();
    same::<SliderCrankFree, Held<Heun>>(&live);
}

#[test]
fn every_method() {
    let live = text("slider_crank_free.rs", "gradients = reverse;").compile().unwrap();
    same::<SliderCrankFree, PerStage<Rk4>>(&live);
    if EXHAUSTIVE {
        same::<SliderCrankFree, PerStage<Heun>>(&live);
        same::<SliderCrankFree, Held<Rk4>>(&live);
        same::<SliderCrankFree, Projected<Heun>>(&live);
    }
}

#[test]
fn every_kind_of_mechanism() {
    let live = |file| text(file, "gradients = reverse;").compile().unwrap();
    same::<BlockOnIncline, Held<Heun>>(&live("block_on_incline.rs"));
    same::<CamFollower, Held<Heun>>(&live("cam_follower.rs"));
    same::<DcMotor, Held<Heun>>(&live("dc_motor.rs"));
    if EXHAUSTIVE {
        same::<FourBarFree, Held<Heun>>(&live("four_bar_free.rs"));
        same::<SliderCrank, Held<Heun>>(&live("slider_crank.rs"));
        same::<SpringMassDamper, Held<Heun>>(&live("spring_mass_damper.rs"));
        same::<Tipper, Held<Heun>>(&live("tipper.rs"));
    }
}

#[test]
fn long_programs() {
    let live = text("n_four_bar.rs", "gradients = reverse;").compile().unwrap();
    same::<NFourBar10, Projected<Heun>>(&live);
    if EXHAUSTIVE {
        same::<NFourBar10, Held<Heun>>(&live);
    }
}

#[test]
fn reduced_states() {
    use reverse::{reduced_four_bar_free, reduced_slider_crank_free};
    let live = |file| text(file, "states = reduced; gradients = reverse;").compile().unwrap();
    let crank = live("slider_crank_free.rs");
    assert!(crank.declared_info().states.len() < crank.declared_info().coordinates.len());
    same::<reduced_slider_crank_free::SliderCrankFree, Projected<Heun>>(&crank);
    if EXHAUSTIVE {
        same::<reduced_slider_crank_free::SliderCrankFree, Held<Heun>>(&crank);
        same::<reduced_four_bar_free::FourBarFree, Held<Heun>>(&live("four_bar_free.rs"));
    }
}
