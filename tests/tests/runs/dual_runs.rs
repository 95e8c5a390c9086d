//! Runs of duals: on every path of a step the values are those of the run itself, to the last bit,
//! and the derivatives are those of differences of runs; starts, projections, kinematics, events
//! and runs to a tolerance end with derivatives that have converged too.
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests")]

use mbs_runtime::{
    Adaptive, Components, Dop853, Dopri5, Dual, Held, Kinematics, Mechanism, Method, PerStage, Projected,
    Real, Rk4, Sampled, Simulation, State, System, Tolerances, start,
};
use models::four_bar::FourBar;
use models::n_pendulum::NPendulum40;
use models::slider_crank::SliderCrank;
use models::slider_crank_free::{SliderCrankFree, SliderCrankFreeParameters};
use tests::differences::slopes;

type One = Dual<f64, 1>;
type Over<M> = <M as Mechanism>::Over<One>;

/// Parameters as constants, but for one, which is the variable.
fn along<M: Mechanism<Real = f64>>(mechanism: &M, parameter: usize) -> Over<M> {
    let plain = mechanism.parameters().into_array();
    let mut parameters = <Over<M> as Mechanism>::Parameters::default().into_array();
    for (at, (to, from)) in parameters.as_mut().iter_mut().zip(plain.as_ref()).enumerate() {
        *to = Dual::new(*from, [f64::from(u8::from(at == parameter))]);
    }
    Over::<M>::new(Components::from_array(parameters)).expect("parameters of the mechanism")
}

/// The mechanism with a parameter changed by a share of itself.
fn changed<M: Mechanism<Real = f64>>(mechanism: &M, parameter: usize, share: f64) -> M {
    let mut parameters = mechanism.parameters().into_array();
    parameters.as_mut()[parameter] *= 1.0 + share;
    M::new(Components::from_array(parameters)).expect("parameters near those of the mechanism")
}

/// Values and derivatives of numbers that a run of the mechanism gives.
fn compare<M: Mechanism<Real = f64>>(
    name: &str,
    mechanism: &M,
    parameter: usize,
    roundings: f64,
    plain: impl Fn(&M) -> Vec<f64>,
    dual: impl Fn(&Over<M>) -> Vec<One>,
) {
    let value = mechanism.parameters().into_array().as_ref()[parameter];
    let found = dual(&along(mechanism, parameter));
    let expected = plain(mechanism);
    let slopes = slopes(1.0, 1e-3, roundings, |share| plain(&changed(mechanism, parameter, share)));
    for (at, (found, (expected, slope))) in found.iter().zip(expected.iter().zip(&slopes)).enumerate() {
        assert_eq!(found.value.to_bits(), expected.to_bits(), "{name}, value {at}");
        let partial = value * found.partials[0];
        assert!(slope.is(partial), "{name}, derivative {at}: {partial:e} {slope:?}");
        // differences that tell nothing hold nothing
        assert!(slope.error <= 1e-5 * (1.0 + slope.value.abs()), "{name}, derivative {at}: {slope:?}");
    }
}

/// State, reactions and outputs at the end of a run.
fn seen<M: Mechanism, X: Method>(mut run: Simulation<M, X>, end: f64, is_in_stages: bool) -> Vec<M::Real> {
    let steps = run.steps_to(end).unwrap();
    for _ in 0..steps {
        if is_in_stages { run.step_in_stages() } else { run.step() }.unwrap();
    }
    let reactions = run.reactions().unwrap();
    let vectors = [
        run.state().q.into_array().as_ref().to_vec(),
        run.state().v.into_array().as_ref().to_vec(),
        reactions.acceleration.into_array().as_ref().to_vec(),
        reactions.multipliers.into_array().as_ref().to_vec(),
        run.outputs().unwrap().into_array().as_ref().to_vec(),
    ];
    vectors.concat()
}

fn every_path<M: Mechanism<Real = f64>, X: Method>(mechanism: &M, parameter: usize, [h, end]: [f64; 2]) {
    for is_in_stages in [false, true] {
        compare(
            &format!("{} by {}", M::INFO.name, core::any::type_name::<X>()),
            mechanism,
            parameter,
            1e4,
            |mechanism| {
                seen(Simulation::builder(*mechanism, h).method::<X>().build().unwrap(), end, is_in_stages)
            },
            |dual| seen(Simulation::builder(*dual, h).method::<X>().build().unwrap(), end, is_in_stages),
        );
    }
}

/// A step and the end of a run, in s.
const SHORT: [f64; 2] = [1e-3, 0.05];

/// Fused and in stages, with each kind of feedback and with projection, from a start that is
/// assembled with the parameter.
#[test]
fn steps_have_the_derivatives_of_differences_of_runs() {
    let (free, driven) = (SliderCrankFree::declared(), SliderCrank::declared());
    for parameter in [0, 1, 2] {
        every_path::<_, Held>(&free, parameter, SHORT);
    }
    every_path::<_, PerStage>(&free, 0, SHORT);
    every_path::<_, Held<Rk4>>(&free, 1, SHORT);
    every_path::<_, Projected<Dopri5>>(&free, 1, SHORT);
    every_path::<_, Held>(&driven, 1, SHORT);
    every_path::<_, Held>(&FourBar::declared(), 0, SHORT);
}

/// The arrays of a long chain. Its violation, ε of the 40 m of its positions, is fed back within a
/// step, so that velocities have the rounding ε·40 m/h, 10³ ε of the largest position: all numbers
/// are judged by that.
#[test]
fn chains_have_the_derivatives_of_differences_of_runs() {
    fn state<M: Mechanism>(mechanism: &M) -> Vec<M::Real> {
        let mut run = Simulation::new(*mechanism, 1e-3).unwrap();
        run.advance_to(5e-3).unwrap();
        [run.state().q, run.state().v].map(|x| x.into_array().as_ref().to_vec()).concat()
    }
    let (chain, lengths) = (NPendulum40::declared(), 0);
    let (found, plain) = (state(&along(&chain, lengths)), state(&chain));
    assert!(found.iter().map(|found| found.value).eq(plain));
    let slopes = slopes(1.0, 1e-3, 1.0, |share| state(&changed(&chain, lengths, share)));
    let rounding = 4e3 * f64::EPSILON * 40.0 * 1.5 / 0.25e-3;
    assert!(rounding < 1e-6);
    for (at, (found, slope)) in found.iter().zip(&slopes).enumerate() {
        let deviation = (found.partials[0] - slope.value).abs();
        assert!(deviation < slope.error + rounding, "{at}: {found} {slope:?}");
    }
}

/// A step with the reactions at its start is the step, and its reactions are those.
#[test]
fn steps_with_reactions_have_the_derivatives_of_both() {
    fn last<M: Mechanism>(mechanism: &M) -> Vec<M::Real> {
        let mut run = Simulation::new(*mechanism, 1e-3).unwrap();
        run.advance_to(0.01).unwrap();
        let reactions = run.step_with_reactions().unwrap();
        let q = run.state().q.into_array().as_ref().to_vec();
        [q, reactions.multipliers.into_array().as_ref().to_vec()].concat()
    }
    compare("step with reactions", &SliderCrankFree::declared(), 0, 1e4, last, last);
}

/// Positions that are solved for have the derivatives of the constraints: far from the guess, where
/// Newton's iteration takes several corrections.
#[test]
fn assembled_positions_have_converged_derivatives() {
    fn at<M: Mechanism>(mechanism: &M) -> Vec<M::Real> {
        let mut kinematics = Kinematics::new(*mechanism).unwrap();
        let number = M::Real::from_f64;
        let motions = [0.0, 0.011, 0.03].map(|t| {
            let motion = kinematics.at(number(t)).unwrap();
            [motion.state.q, motion.state.v, motion.acceleration]
                .map(|x| x.into_array().as_ref().to_vec())
                .concat()
        });
        motions.concat()
    }
    for parameter in [0, 1, 5] {
        compare("kinematics", &SliderCrank::declared(), parameter, 100.0, at, at);
    }
}

/// A start of which coordinates are kept has the derivatives of the others, although the values are
/// consistent from the first.
#[test]
fn projected_starts_have_the_derivatives_of_the_constraints() {
    fn projected<M: Mechanism>(mechanism: &M) -> Vec<M::Real> {
        let guess = Simulation::new(*mechanism, 1e-3).unwrap().state();
        let plain = guess.q.into_array().as_ref().iter().map(|q| q.to_f64()).collect::<Vec<_>>();
        let mut constant = guess.q.into_array();
        let number = M::Real::from_f64;
        constant.as_mut().iter_mut().zip(&plain).for_each(|(q, plain)| *q = number(*plain));
        let guess = State { q: Components::from_array(constant), ..guess };
        let start = start::project(mechanism, &guess, &["theta1"], &["theta1"]).unwrap();
        [start.q, start.v].map(|x| x.into_array().as_ref().to_vec()).concat()
    }
    for parameter in [0, 1] {
        compare("projection", &SliderCrankFree::declared(), parameter, 1e3, projected, projected);
    }
}

/// Derivatives of a run to a tolerance are those of the run whose steps are as long as its own:
/// they differ from those of the motion by the tolerance.
#[test]
fn runs_to_a_tolerance_have_the_derivatives_of_the_motion() {
    let fine = Tolerances { rtol: 1e-11, atol: 1e-12, ..Tolerances::default() };
    let mechanism = SliderCrankFree::declared();
    let state = |mechanism: &SliderCrankFree<f64>| {
        let mut run = Adaptive::builder(*mechanism).scheme::<Dop853>().tolerances(fine).build().unwrap();
        run.advance_to(0.1).unwrap();
        run.state()
    };
    for parameter in [0, 1, 2] {
        let dual = along(&mechanism, parameter);
        let mut run = Adaptive::builder(dual).scheme::<Dop853>().tolerances(fine).build().unwrap();
        run.advance_to(0.1).unwrap();
        let value = mechanism.parameters().into_array()[parameter];
        let expected = state(&mechanism);
        let errors = 1e-11 / f64::EPSILON;
        let slopes = slopes(1.0, 1e-2, errors, |share| {
            let State { q, v, .. } = state(&changed(&mechanism, parameter, share));
            [q, v].map(|x| x.into_array().to_vec()).concat()
        });
        let (q, v) = (run.state().q.into_array(), run.state().v.into_array());
        assert_eq!(q.map(|q| q.value), expected.q.into_array());
        for (at, (found, slope)) in q.into_iter().chain(v).zip(&slopes).enumerate() {
            let partial = value * found.partials[0];
            let size = 1e-6 * (1.0 + slope.value.abs());
            assert!((partial - slope.value).abs() < slope.error.min(size), "{at}: {partial} {slope:?}");
        }
        // the constraints keep their derivatives: to rounding, not to √ε
        let phi = dual.phi(run.time(), &run.state().q).into_array();
        assert!(phi.iter().all(|phi| phi.partials[0].abs() < 1e-13), "{phi:?}");
    }
}

mbs_runtime::mechanism! {
    Ball {
        dof = 1;
        param height = 1 [m];
        param g = 9.81 [m/s^2];
        gravity = (0, -g);
        body ball (y) { mass = 1 [kg]; }
        event ground: y = 0 falling;
        start { y = height; }
    }
}

/// The time of an event has derivatives, t = √(2h/g), and the motion behind it, which bounces with
/// the speed ev, has those of both: y(t) = ev τ − ½gτ² with τ = t − √(2h/g), v = √(2gh).
#[test]
fn events_have_derivatives() {
    let variables = |h: f64, g: f64| [Dual::<f64, 2>::variable(h, 0), Dual::variable(g, 1)];
    let [height, g] = variables(1.0, 9.81);
    let ball = Ball::new(BallParameters { height, g }).unwrap();
    let mut run = Adaptive::builder(ball).build().unwrap();
    run.advance_to_event(2.0).unwrap().expect("the ground");
    let fall = (2.0 / 9.81_f64).sqrt();
    let found = run.time();
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-11, "{found} {expected}");
    near(found.partials[0], fall / 2.0);
    near(found.partials[1], -fall / (2.0 * 9.81));
    // positions there do not change, whatever the variables are
    near(run.state().q.y.partials[0], 0.0);
    near(run.state().v.y.partials[0], -9.81 * fall / 2.0);

    let restitution = 0.7;
    let mut state = run.state();
    state.v.y = Dual::constant(-restitution) * state.v.y;
    run.set_state(state).unwrap();
    run.advance_to(0.8).unwrap();
    let y = {
        let fall = (Dual::constant(2.0) * height / g).sqrt();
        let tau = Dual::constant(0.8) - fall;
        Dual::constant(restitution) * g * fall * tau - Dual::constant(0.5) * g * tau * tau
    };
    assert!(!run.time().partials.iter().any(|partial| *partial != 0.0));
    near(run.state().q.y.value, y.value);
    for at in 0..2 {
        near(run.state().q.y.partials[at], y.partials[at]);
    }
}

/// Samples of a run, which lie between the ends of its steps.
#[test]
fn samples_have_the_derivatives_of_the_motion() {
    let [height, g] = [Dual::<f64, 1>::variable(1.0, 0), Dual::constant(9.81)];
    let run = Adaptive::builder(Ball::new(BallParameters { height, g }).unwrap()).build().unwrap();
    let mut samples = Sampled::new(run, 0.01).unwrap();
    let (mut q, mut v) = ([Dual::default()], [Dual::default()]);
    for _ in 0..20 {
        samples.step().unwrap();
        samples.state(&mut q, &mut v);
        assert!((q[0].partials[0] - 1.0).abs() < 1e-13 && v[0].partials[0].abs() < 1e-12);
    }
    let system: &mut dyn System<Dual<f64, 1>> = &mut samples;
    assert_eq!(system.time().value, 0.2);
}

/// Second derivatives of a step by duals of duals.
#[test]
fn duals_of_duals_make_steps() {
    type Two = Dual<Dual<f64, 1>, 1>;
    let plain = *SliderCrankFree::declared().parameters();
    let at = |l1: f64| {
        let parameters = SliderCrankFreeParameters { l1, ..plain }.map(|x| x);
        let number = |x: f64| Two::constant(Dual::constant(x));
        let mut lifted = parameters.into_array().map(number);
        lifted[0] = Dual::new(Dual::new(l1, [1.0]), [Dual::constant(1.0)]);
        let mechanism = SliderCrankFree::new(Components::from_array(lifted)).unwrap();
        let mut run = Simulation::new(mechanism, 1e-3).unwrap();
        run.advance_to(0.01).unwrap();
        run.state().q.x3
    };
    let Two { value: Dual { partials: [first], .. }, partials: [Dual { value, partials: [second] }] } =
        at(0.06);
    assert_eq!(first, value);
    let difference = (at(0.06 + 1e-5).value.partials[0] - at(0.06 - 1e-5).value.partials[0]) / 2e-5;
    // a central difference of size 1: (δ/l)² and ε/δ are some 1e-8
    assert!((second - difference).abs() < 1e-7 * (1.0 + second.abs()), "{second} {difference}");
}
