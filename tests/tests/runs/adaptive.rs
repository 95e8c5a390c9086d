//! Runs to a tolerance: errors are what was asked for, what lies between steps has its order,
//! looking does not change a run, and what cannot be integrated is named.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{
    Adaptive, Bs3, Components, Dop853, Dopri5, Error, Heun, Mechanism, Rk4, Sampled, Scheme, Simulation,
    System, Tolerances, mechanism,
};
use models::{SliderCrank, SliderCrankFree, SliderCrankFreeInputs, SliderCrankParameters, SpringMassDamper};
use tests::swing::{Swing, SwingCoordinates, SwingParameters, quarter_period};

mechanism! {
    /// A point that runs away: ẍ = 6 x² with x = 1/(1 s − t)².
    pub Runaway {
        dof = 1;
        body point (x) { mass = 1 [kg]; }
        force away on x = 6 [N/m^2]*x^2;
        start { x = 1 [m]; der(x) = 2 [m/s]; }
    }
}

mechanism! {
    /// A body on which nothing acts.
    pub Drift {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        start { x = 1 [m]; }
    }
}

const END: f64 = 0.3;
/// θ1 after 0.3 s with 0.5 N·m on the crank from 200 rpm: 1,000 and 3,000 steps of DOP853 with
/// projection, and as many with feedback, agree to 3e-14. `order.rs` has 5.644159549774 from
/// another program.
const THETA: f64 = 5.644_159_549_773_4;

fn tolerances(rtol: f64) -> Tolerances {
    Tolerances { rtol, atol: 1e-2 * rtol, ..Tolerances::default() }
}

fn crank<S: Scheme>(rtol: f64) -> Adaptive<SliderCrankFree, S> {
    let builder = Adaptive::builder(SliderCrankFree::declared()).scheme::<S>();
    let inputs = SliderCrankFreeInputs { crank_torque: 0.5 };
    builder.tolerances(tolerances(rtol)).inputs(inputs).build().expect("a start")
}

fn swing<S: Scheme>(rtol: f64) -> Adaptive<Swing, S> {
    let builder = Adaptive::builder(Swing::declared()).scheme::<S>();
    builder.tolerances(tolerances(rtol)).build().expect("a start")
}

fn reaches_its_tolerance<S: Scheme>() {
    for power in 4..=11 {
        let rtol = 10_f64.powi(-power);
        let mut run = crank::<S>(rtol);
        run.advance_to(END).expect("a regular motion");
        let error = (run.state().q.theta1 - THETA).abs() / THETA;
        let effort = run.effort();
        assert!(error < 10.0 * rtol, "{} {rtol:e}: {error:e}", S::TABLEAU.word);
        assert!(effort.rejected * 2 < effort.steps, "{} {rtol:e}: {effort:?}", S::TABLEAU.word);
        assert!(run.time() == END && run.violation() < 1e-15);
    }
}

#[test]
fn the_error_of_a_run_is_the_tolerance_within_a_factor_of_ten() {
    reaches_its_tolerance::<Bs3>();
    reaches_its_tolerance::<Dopri5>();
    reaches_its_tolerance::<Dop853>();
}

/// Steps of a given length.
fn in_steps_of<S: Scheme>(h: f64) -> Adaptive<Swing, S> {
    let tolerances = Tolerances { rtol: 1.0, atol: 1.0, max_step: h, first_step: Some(h) };
    let builder = Adaptive::builder(Swing::declared()).scheme::<S>();
    builder.tolerances(tolerances).build().expect("a start")
}

/// The largest errors of positions and of velocities within the steps of 0.8 s, against runs from the start
/// of each step to where it is looked at.
fn errors_between_steps<S: Scheme>(h: f64) -> [f64; 2] {
    let (mut errors, mut run) = ([0.0_f64; 2], in_steps_of::<S>(h));
    while run.time() < 0.8 - 1e-9 {
        let start = run.state();
        run.step().expect("a step");
        for share in [0.2, 0.35, 0.5, 0.7, 0.85] {
            let t = start.t + share * h;
            let builder = Adaptive::builder(Swing::declared()).scheme::<Dop853>().from_state(start);
            let mut exact = builder.tolerances(tolerances(1e-13)).build().expect("a consistent state");
            exact.advance_to(t).expect("a regular motion");
            let (found, exact) = (run.at(t).expect("within the step"), exact.state());
            let apart = |x: SwingCoordinates, y: SwingCoordinates| x.zip_map(y, |x, y| x - y).norm();
            errors = [errors[0].max(apart(found.q, exact.q)), errors[1].max(apart(found.v, exact.v))];
        }
    }
    errors
}

/// The polynomial through both ends is off by O(h⁶) and O(h⁵), with the ends of `bs3` by O(h⁴) and O(h³), and that
/// of `dop853` by O(h⁸). In steps of 0.1 s the angle changes by up to 0.4 rad.
#[test]
fn what_lies_between_steps_has_the_order_that_methods_say() {
    fn orders<S: Scheme>(h: f64) -> [f64; 2] {
        let [coarse, fine] = [h, 0.5 * h].map(errors_between_steps::<S>);
        [0, 1].map(|at| (coarse[at] / fine[at]).log2())
    }
    for (word, found, expected) in [
        ("bs3", orders::<Bs3>(0.02), [4.0, 3.0]),
        ("dopri5", orders::<Dopri5>(0.02), [6.0, 5.0]),
        ("dop853", orders::<Dop853>(0.1), [8.0, 8.0]),
    ] {
        println!("{word}: {found:?}");
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 0.4, "{word}: {found} and not {expected}");
        }
    }
}

/// A pendulum of 0.8 m, released from the side, against a run whose steps end where it is looked at: what is
/// seen between steps is off by ten times the error of their ends at most, and the end of the run, which is on no
/// grid, is the end of a step.
#[test]
fn samples_are_as_good_as_the_tolerance_and_the_end_is_the_end_of_a_step() {
    fn compare<S: Scheme>(rtol: f64, allowed: f64) {
        let end = 1.9371;
        let start = |rtol: f64| Tolerances { rtol, atol: rtol, ..Tolerances::default() };
        let build = |tolerances| {
            let builder = Adaptive::builder(Swing::declared()).scheme::<S>();
            builder.tolerances(tolerances).build().expect("a start")
        };
        let mut exact = Adaptive::builder(Swing::declared()).scheme::<Dop853>();
        exact = exact.tolerances(start(1e-13));
        let mut exact = exact.build().expect("a start");
        let mut samples = Sampled::new(build(start(rtol)), 0.0173).expect("an interval");
        let count = samples.ends_at(end).expect("a time ahead");
        assert_eq!(count, 112);
        let mut largest = 0.0_f64;
        for _ in 0..count {
            samples.step().expect("a regular motion");
            exact.advance_to(samples.time()).expect("a regular motion");
            let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
            samples.state(&mut q, &mut v);
            let at = exact.state();
            let errors = [q[0] - at.q.x, q[1] - at.q.y, v[0] - at.v.x, v[1] - at.v.y];
            largest = errors.into_iter().fold(largest, |largest, error| largest.max(error.abs()));
        }
        // looked at once, at the end
        let mut straight = build(start(rtol));
        straight.advance_to(end).expect("a regular motion");
        let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
        samples.state(&mut q, &mut v);
        assert_eq!(
            (samples.time(), q, v),
            (end, straight.state().q.into_array(), straight.state().v.into_array())
        );
        println!("{} {rtol:e}: {largest:e}", S::TABLEAU.word);
        assert!(largest < allowed * rtol, "{} {rtol:e}: {largest:e}", S::TABLEAU.word);
    }
    for rtol in [1e-6, 1e-9] {
        compare::<Bs3>(rtol, 100.0);
        compare::<Dopri5>(rtol, 30.0);
        compare::<Dop853>(rtol, 30.0);
    }
    compare::<Dop853>(1e-12, 30.0);
}

/// Behind an end that is on no grid samples are an interval apart again, and behind one on the grid they stay on
/// it.
#[test]
fn samples_go_on_behind_an_end() {
    let mut samples = Sampled::new(swing::<Dopri5>(1e-8), 0.1).expect("an interval");
    let mut times = Vec::new();
    for end in [0.25, 0.45, 0.65] {
        let count = samples.ends_at(end).expect("a time ahead");
        for _ in 0..count {
            samples.step().expect("a regular motion");
            times.push(samples.time());
        }
    }
    samples.step().expect("a regular motion");
    times.push(samples.time());
    let expected = [0.1, 0.2, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75];
    assert!(times.iter().zip(expected).all(|(t, expected)| (t - expected).abs() < 1e-12), "{times:?}");
    assert!(matches!(samples.ends_at(0.1), Err(Error::EndTime { .. })));
    assert_eq!(samples.ends_at(samples.time()), Ok(0));
}

/// Between steps the constraints are met as at their ends, to the rounding of x² + y² − l².
#[test]
fn states_between_steps_meet_the_constraints() {
    let (mut run, mechanism) = (swing::<Dopri5>(1e-6), Swing::declared());
    for k in 0..500 {
        let t = 0.01 * f64::from(k);
        run.cover(t).expect("a regular motion");
        let at = run.at(t).expect("within the step");
        let violation = mechanism.phi(t, &at.q).norm().max(mechanism.phi_dot(&at).norm());
        assert!(violation < 1e-13, "{t}: {violation:e}");
    }
}

#[test]
fn looking_does_not_change_a_run() {
    let mut seen = crank::<Dopri5>(1e-8);
    for k in 0..=300 {
        let t = 1e-3 * f64::from(k);
        seen.cover(t).expect("a regular motion");
        seen.at(t).expect("within the step");
    }
    let mut unseen = crank::<Dopri5>(1e-8);
    while unseen.time() < seen.time() {
        unseen.step().expect("a regular motion");
    }
    assert_eq!((seen.state(), seen.effort()), (unseen.state(), unseen.effort()));
}

/// Ending at many times takes more steps, but none of them shortens those behind it.
#[test]
fn a_step_that_is_cut_short_does_not_shorten_the_next_one() {
    let mut run = swing::<Dopri5>(1e-6);
    run.advance_to(1.0).expect("a regular motion");
    let next = run.next_step();
    run.advance_to(1.0 + 1e-6).expect("a regular motion");
    assert_eq!(run.next_step(), next);
}

/// With a torque of 0.5 N·m for 0.1 s and of −0.5 N·m for 0.1 s more: as two runs one after the
/// other, and as samples whose inputs are set; to the tolerance.
#[test]
fn inputs_change_from_one_moment_to_the_next() {
    let [forth, back] = [0.5, -0.5].map(|crank_torque| SliderCrankFreeInputs { crank_torque });
    let mut run = crank::<Dopri5>(1e-9);
    run.advance_to(0.1).expect("a regular motion");
    *run.inputs_mut() = back;
    run.advance_to(0.2).expect("a regular motion");

    let builder = Adaptive::builder(SliderCrankFree::declared()).tolerances(tolerances(1e-9));
    let second = {
        let mut first = builder.clone().inputs(forth).build().expect("a start");
        first.advance_to(0.1).expect("a regular motion");
        first.state()
    };
    let mut second = builder.inputs(back).from_state(second).build().expect("a start");
    second.advance_to(0.2).expect("a regular motion");
    let theta = run.state().q.theta1;
    assert!((theta - second.state().q.theta1).abs() < 1e-8);

    let mut samples = Sampled::new(crank::<Dopri5>(1e-9), 1e-3).expect("an interval");
    samples.advance(100).expect("a regular motion");
    samples.set_inputs(&[-0.5]);
    samples.advance(100).expect("a regular motion");
    let mut q = [0.0; 7];
    samples.state(&mut q, &mut [0.0; 7]);
    let at = SliderCrankFree::<f64>::INFO.coordinates.iter().position(|q| q.name == "theta1").expect("it");
    assert!((theta - q[at]).abs() < 1e-8 && samples.time() == 0.2);
}

#[test]
fn reactions_and_outputs_of_samples_are_those_of_their_states() {
    let mut samples = Sampled::new(swing::<Dopri5>(1e-8), 0.05).expect("an interval");
    samples.advance(7).expect("a regular motion");
    let ([mut q, mut v, mut a], [mut lambda, mut tension]) = ([[0.0; 2]; 3], [[0.0; 1]; 2]);
    samples.state(&mut q, &mut v);
    samples.reactions(&mut a, &mut lambda).expect("a regular position");
    samples.outputs(&a, &lambda, &mut tension).expect("finite outputs");
    // m (g sin + v²/l) inwards
    let expected = 2.0 * (-9.81 * q[1] + v[0] * v[0] + v[1] * v[1]);
    assert!((tension[0] - expected).abs() < 1e-12, "{} {expected}", tension[0]);
    assert_eq!(samples.steps_to(1.0), Ok(13));
}

#[test]
fn a_run_goes_back_within_its_last_step() {
    let mut run = swing::<Dopri5>(1e-8);
    run.cover(0.5).expect("a regular motion");
    let at = run.at(0.5).expect("within the step");
    run.rewind_to(0.5).expect("within the step");
    assert_eq!(run.state(), at);
    run.advance_to(1.0).expect("a regular motion");
    let mut straight = swing::<Dopri5>(1e-8);
    straight.advance_to(1.0).expect("a regular motion");
    assert!((run.state().q.x - straight.state().q.x).abs() < 1e-7);
    for t in [0.0, 2.0, f64::NAN] {
        assert!(matches!(run.rewind_to(t), Err(Error::EndTime { .. })), "{t}");
    }
}

/// The closed form of an underdamped oscillator in single precision, to 100 roundings.
#[test]
fn single_precision_keeps_its_tolerance() {
    let swing = Swing::<f32>::new(SwingParameters::default()).expect("declared parameters");
    let tolerances = Tolerances { rtol: 2e-5, atol: 1e-6, ..Tolerances::default() };
    let mut run = Adaptive::builder(swing).tolerances(tolerances).build().expect("a start");
    let bottom = quarter_period();
    run.advance_to(bottom).expect("a regular motion");
    assert!(run.state().q.x.abs() < 2e-4, "{:?}", run.state());
    let finer = Tolerances { rtol: 1e-9, ..tolerances };
    let refused = Adaptive::builder(swing).tolerances(finer).build().expect_err("too fine");
    assert!(matches!(refused, Error::Tolerance { name: "rtol", .. }));
}

#[test]
fn schemes_without_an_estimate_are_refused() {
    let builder = || Adaptive::builder(Swing::declared());
    let of = [builder().scheme::<Heun>().build().err(), builder().scheme::<Rk4>().build().err()];
    assert_eq!(of, ["heun", "rk4"].map(|scheme| Some(Error::NoEstimate { scheme })));
    let text = Error::NoEstimate { scheme: "rk4" }.to_string();
    assert!(text.contains("`rk4`") && text.contains("dopri5"));
}

/// A crank longer than its rod comes to asin(l2/l1), and no further.
#[test]
fn a_drive_beyond_reach_ends_where_the_reach_does() {
    let defaults = SliderCrankParameters::<f64>::default();
    let longer = SliderCrankParameters { l1: 1.1 * defaults.l2, ..defaults };
    let mechanism = SliderCrank::new(longer).expect("valid parameters");
    let last = (1.0_f64 / 1.1).asin() / mechanism.parameters().omega;
    let mut run = Adaptive::builder(mechanism).build().expect("a start");
    let error = run.advance_to(END).expect_err("a position that is not reached");
    assert!(matches!(error, Error::OutOfReach { .. } | Error::Singular { .. }), "{error}");
    let state = run.state();
    assert!(state.q.is_finite() && state.t < last && last - state.t < 1e-6, "{state:?} {last}");
    // it says so again, and stays where it is
    assert_eq!((run.step().is_err(), run.state()), (true, state));
}

/// An end as near as the next number, and steps where nothing happens for ever.
#[test]
fn the_shortest_and_the_longest_steps_are_taken() {
    let mut run = swing::<Dopri5>(1e-6);
    run.advance_to(1.0).expect("a regular motion");
    run.advance_to(1.0_f64.next_up()).expect("a regular motion");
    assert_eq!(run.time(), 1.0_f64.next_up());

    let mut run = Adaptive::builder(Drift::declared()).build().expect("a start");
    for _ in 0..500 {
        run.step().expect("a step");
    }
    assert!(run.time() > 1e9 && run.state().q.x == 1.0);
}

/// Trials in search of an error are no part of the run.
#[test]
fn an_error_leaves_the_watch_as_it_was() {
    let mut run = crank::<Dopri5>(1e-6);
    run.advance_to(0.1).expect("a regular motion");
    let before = run.worst_growth();
    run.inputs_mut().crank_torque = 1e300;
    assert!(run.step().is_err());
    assert_eq!(run.worst_growth(), before);
}

#[test]
fn a_motion_without_an_end_is_given_up() {
    let mut run = Adaptive::builder(Runaway::declared()).build().expect("a start");
    let error = run.advance_to(2.0).expect_err("a motion that ends at 1 s");
    assert!(matches!(error, Error::StepTooShort { .. } | Error::NonFinite { .. }), "{error}");
    assert!((run.time() - 1.0).abs() < 1e-3, "{}", run.time());
}

#[test]
fn bad_inputs_and_times_are_refused() {
    let mut run = crank::<Dopri5>(1e-6);
    run.inputs_mut().crank_torque = f64::NAN;
    assert!(matches!(run.step(), Err(Error::Input { name: "crank_torque", .. })));
    run.inputs_mut().crank_torque = 0.5;
    run.advance_to(0.1).expect("a regular motion");
    for end in [0.05, f64::NAN, f64::INFINITY] {
        assert!(matches!(run.advance_to(end), Err(Error::EndTime { .. })), "{end}");
    }
    assert!(matches!(Sampled::new(run, 0.0), Err(Error::Step { .. })));
}

/// A mechanism without constraints has nothing to project.
#[test]
fn a_mechanism_without_constraints_is_integrated_as_any_other() {
    let mut fine =
        Adaptive::builder(SpringMassDamper::declared()).tolerances(tolerances(1e-10)).build().expect("ok");
    fine.advance_to(1.0).expect("a regular motion");
    let mut run = Simulation::new(SpringMassDamper::declared(), 1e-4).expect("a start");
    run.advance_to(1.0).expect("a regular motion");
    let [fine, run] = [fine.state().q, run.state().q].map(|q| q.into_array()[0]);
    assert!((fine - run).abs() < 1e-6, "{fine} {run}");
}
