//! Ensembles: every member as its simulation alone, to the last bit, with failing
//! neighbours, on any number of threads.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_ensemble::{Ensemble, Extremes, Run, Samples, Violation};
use mbs_runtime::{Baumgarte, Components, Error, Held, Mechanism, Method, PerStage, Simulation, mechanism};
use models::{DoublePendulum, FourBar, SliderCrank, SliderCrankFree, SliderCrankParameters};
use models::{NFourBar2, NFourBar2Parameters, SliderCrankFreeInputs, SliderCrankFreeParameters};
use paths::EXHAUSTIVE;

const H: f64 = 0.5e-3;
const END: f64 = 0.5;
const STEPS: u64 = 1000;

mechanism! {
    /// Springs, a cam, dry friction that depends on a reaction, and one of every
    /// function whose code is a library's or a choice.
    Everything {
        dof = 2;
        param r0 = 20 [mm];
        param mu = 0.1;
        input push [N];
        gravity = (0, -9.81) [m/s^2];
        body disk (angle = phi) { inertia = 1e-3 [kg*m^2]; }
        body valve (y) { mass = 0.1 [kg]; }
        body block (x) { mass = 1 [kg]; }
        profile lift = spline((0 [deg], 0 [mm]), (90 [deg], 4 [mm]), (180 [deg], 9 [mm]), (270 [deg], 3 [mm]))
            period 360 [deg];
        cam contact (disk, valve) = r0 + lift(angle);
        friction rub (block, ground) along (1, 0) {
            coefficient = mu;
            normal = 10 [N] + 0.1*lambda(contact);
            transition = 0.05 [m/s];
        }
        let s = t/1 [s];
        force pushed on block = (push*max(0, cos(3*s)) - 1 [N]*sign(x)*abs(sin(s)), 0);
        torque drive on disk = 0.01 [N*m]*(tanh(phi) + exp(-s) + ln(2 + s) + atan2(1, 2 + phi^2)
            + pow(1 + phi^2, 0.3) + sqrt(1 + s) + asin(0.5*sin(phi)) + tan(0.2*cos(phi)) + min(s, 0.1));
        start { phi = 10 [deg]; x = 0.01 [m]; guess y = 25 [mm]; }
        output contact_force [N] = lambda(contact);
        output heat [W] = -power(rub);
    }
}

type Observer = (Violation, (Extremes, Samples));
const OBSERVER: Observer = (Violation, (Extremes { from: 0.1 }, Samples::every(100)));

/// The numbers of `OBSERVER`, found by scalar steps.
fn alone<M: Mechanism<Real = f64>, X: Method>(mut run: Simulation<M, X>) -> Vec<f64> {
    let mut numbers = vec![0.0_f64; 2];
    let count = M::Outputs::NAMES.len();
    let mut extremes = vec![[f64::NAN; 4]; count];
    let mut samples: Vec<f64> = Vec::new();
    for step in 0..=STEPS {
        numbers[0] = numbers[0].max(run.violation());
        numbers[1] = numbers[1].max(run.velocity_violation());
        let outputs = run.outputs().expect("a regular position").into_array();
        let t = run.time();
        for (&value, [low, low_t, high, high_t]) in outputs.as_ref().iter().zip(&mut extremes) {
            if t >= 0.1 && (value < *low || low.is_nan()) {
                (*low, *low_t) = (value, t);
            }
            if t >= 0.1 && (value > *high || high.is_nan()) {
                (*high, *high_t) = (value, t);
            }
        }
        if step % 100 == 0 {
            samples.extend(run.state().q.into_array().as_ref());
            samples.extend(run.state().v.into_array().as_ref());
        }
        if step < STEPS {
            run.step().expect("a step");
        }
    }
    (0..4).for_each(|what| numbers.extend(extremes.iter().map(|extreme| extreme[what])));
    numbers.extend(samples);
    numbers
}

type Observed<M> = (
    mbs_ensemble::OfConstraints<f64>,
    (
        mbs_ensemble::OfOutputs<<M as Mechanism>::Outputs>,
        Vec<mbs_runtime::State<<M as Mechanism>::Coordinates>>,
    ),
);

fn numbers<M: Mechanism<Real = f64>>(run: &Run<M, Observed<M>>) -> Vec<f64> {
    let (violation, (extremes, samples)) = &run.observed;
    let mut numbers = vec![violation.phi, violation.phi_dot];
    for outputs in [extremes.low, extremes.low_time, extremes.high, extremes.high_time] {
        numbers.extend(outputs.into_array().as_ref());
    }
    for state in samples {
        numbers.extend(state.q.into_array().as_ref());
        numbers.extend(state.v.into_array().as_ref());
    }
    numbers
}

/// 19 members: two blocks and a part of one.
fn same_bits<M, X>(member: impl Fn(usize) -> Result<Simulation<M, X>, Error> + Sync)
where
    M: Mechanism<Real = f64>,
    X: Method,
{
    let outcomes = Ensemble::new(END).run(19, &member, &OBSERVER).expect("nobody cancels");
    assert_eq!(outcomes.len(), 19);
    for (index, outcome) in outcomes.iter().enumerate() {
        let run = outcome.as_ref().expect("a start");
        assert_eq!((run.ended, run.steps), (None, STEPS), "{} {index}", M::INFO.name);
        let mut simulation = member(index).expect("a start");
        simulation.advance_to(END).expect("a motion");
        assert_eq!(run.state, simulation.state());
        let (found, expected) = (numbers(run), alone(member(index).expect("a start")));
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&found), bits(&expected), "{} {index}: {found:?} {expected:?}", M::INFO.name);
    }
}

fn driven(index: usize) -> SliderCrankParameters {
    let x = index as f64;
    SliderCrankParameters { l1: 0.04 + 0.001 * x, omega: 15.0 + x, ..Default::default() }
}

#[test]
fn driven_slider_crank() {
    same_bits(|index| Simulation::new(SliderCrank::new(driven(index))?, H));
    if EXHAUSTIVE {
        // gains of their own, another feedback, a start that is not consistent
        same_bits(|index| {
            let gains = Baumgarte::<PerStage>::new(1000.0 + 50.0 * index as f64, 1500.0)?;
            Simulation::builder(SliderCrank::new(driven(index))?, H).baumgarte(gains).as_declared().build()
        });
    }
}

fn free(index: usize) -> Result<Simulation<SliderCrankFree>, Error> {
    let x = index as f64;
    let parameters = SliderCrankFreeParameters { m3: 1.0 + 0.1 * x, ..Default::default() };
    Simulation::builder(SliderCrankFree::new(parameters)?, H)
        .inputs(SliderCrankFreeInputs { crank_torque: 0.3 + 0.02 * x })
        .build()
}

#[test]
fn free_slider_crank() {
    same_bits(free);
}

#[test]
fn other_functions() {
    if EXHAUSTIVE {
        same_bits(|index| {
            let mut start = DoublePendulum::declared().declared_start();
            let name = <DoublePendulum as Mechanism>::Coordinates::NAMES[2];
            start.q = start.q.with(name, 0.1 * index as f64).expect("a coordinate");
            let start = mbs_runtime::start::consistent(&DoublePendulum::declared(), &start)?;
            Simulation::builder(DoublePendulum::declared(), H).from_state(start).build()
        });
        same_bits(|_| Simulation::new(FourBar::declared(), H));
    }
    same_bits(|index| {
        let parameters = EverythingParameters { r0: 0.02 + 1e-4 * index as f64, ..Default::default() };
        Simulation::builder(Everything::new(parameters)?, H)
            .inputs(EverythingInputs { push: 20.0 + index as f64 })
            .build()
    });
}

/// Lanes of other widths, and other numbers of steps in a block.
#[test]
fn other_widths_and_steps() {
    fn compare<const N: usize>() {
        let member =
            |index: usize| Simulation::new(SliderCrank::new(driven(index))?, H * (1.0 + (index % 3) as f64));
        let runs = Ensemble::new(END).lanes::<N>().run(11, member, &()).expect("nobody cancels");
        for (index, run) in runs.into_iter().enumerate() {
            let run = run.expect("a start");
            let mut simulation = member(index).expect("a start");
            simulation.advance_to(END).expect("a motion");
            assert_eq!((run.state, run.steps, run.ended), (simulation.state(), simulation.steps(), None));
        }
    }
    compare::<4>();
    if EXHAUSTIVE {
        compare::<1>();
        compare::<16>();
    }
}

/// Sines of `f32` lanes may be off by ε/2: what 1000 steps make of it is what
/// `tests/solutions/single_precision.rs` allows between `f32` and `f64`.
#[test]
fn single_precision() {
    let member = |index: usize| {
        let of = |x: f64| x as f32;
        let SliderCrankParameters { l1, omega, .. } = driven(index);
        let parameters = SliderCrankParameters::<f32> { l1: of(l1), omega: of(omega), ..Default::default() };
        Simulation::new(SliderCrank::<f32>::new(parameters)?, H)
    };
    let runs = Ensemble::new(END).lanes::<16>().run(20, member, &Violation).expect("nobody cancels");
    for (index, run) in runs.into_iter().enumerate() {
        let run = run.expect("a start");
        let mut simulation = member(index).expect("a start");
        simulation.advance_to(END).expect("a motion");
        assert_eq!((run.ended, run.steps), (None, STEPS));
        for (x, y) in run.state.q.into_array().into_iter().zip(simulation.state().q.into_array()) {
            // angles up to 17 rad
            assert!((x - y).abs() <= 4.0 * 17.0 * f32::EPSILON, "{index}: {x} and {y}");
        }
        assert!(run.observed.phi > 0.0 && run.observed.phi < 1e-4);
    }
}

/// Rods that are shorter than the crank: the crank gets stuck.
fn some_stuck(index: usize) -> Result<Simulation<SliderCrank>, Error> {
    let short = [2, 5, 8].contains(&index);
    let parameters = SliderCrankParameters { l2: if short { 0.03 } else { 0.18 }, ..driven(index) };
    Simulation::new(SliderCrank::new(parameters)?, H)
}

#[test]
fn a_failing_lane_disturbs_nobody() {
    let outcomes = Ensemble::new(END).run(12, some_stuck, &Violation).expect("nobody cancels");
    let healthy = |index: usize| Simulation::new(SliderCrank::new(driven(index))?, H);
    let undisturbed = Ensemble::new(END).run(12, healthy, &Violation).expect("nobody cancels");
    for (index, (outcome, undisturbed)) in outcomes.into_iter().zip(undisturbed).enumerate() {
        let run = outcome.expect("a start");
        let mut simulation = some_stuck(index).expect("a start");
        assert_eq!(run.ended, simulation.advance_to(END).err(), "{index}");
        assert_eq!((run.state, run.steps), (simulation.state(), simulation.steps()));
        assert_eq!(run.ended.is_some(), [2, 5, 8].contains(&index), "{index}: {:?}", run.ended);
        if run.ended.is_none() {
            assert_eq!(Ok(run), undisturbed);
        }
    }
}

/// To the same end as its simulation alone, whether somebody looks or not: state, steps
/// and error.
fn same_end<M: Mechanism<Real = f64>>(
    count: usize,
    end: f64,
    member: impl Fn(usize) -> Result<Simulation<M>, Error> + Sync,
) -> Vec<Option<Error>> {
    let outcomes = Ensemble::new(end).run(count, &member, &Violation).expect("nobody cancels");
    let unseen = Ensemble::new(end).run(count, &member, &()).expect("nobody cancels");
    let ended = outcomes.into_iter().zip(unseen).enumerate().map(|(index, (outcome, unseen))| {
        let (run, unseen) = (outcome.expect("a start"), unseen.expect("a start"));
        let mut simulation = member(index).expect("a start");
        let alone = simulation.advance_to(end).err();
        // as text: a growth may be NaN
        assert_eq!(format!("{:?}", run.ended), format!("{alone:?}"), "{} {index}", M::INFO.name);
        assert_eq!(format!("{:?}", unseen.ended), format!("{alone:?}"), "{} {index}", M::INFO.name);
        assert_eq!((run.state, run.steps), (simulation.state(), simulation.steps()));
        assert_eq!((unseen.state, unseen.steps), (run.state, run.steps));
        run.ended
    });
    ended.collect()
}

/// Cranks get stuck after a few steps and after thousands, so that steps which nobody looks
/// at, and which are tested together, have a bad one first, in the middle, and last.
#[test]
fn every_bad_step_is_found() {
    let steps =
        [1, 2, 3, 30, 126, 127, 128, 129, 130, 255, 256, 300, 383, 384, 385, 1000, 1023, 1024, 1025, 2000];
    let ended = same_end(steps.len() + 1, 1.25, |index| {
        // the crank is stuck at sin θ1 = l2/l1
        let steps = steps.get(index).map_or(5000.0, |&steps| f64::from(steps));
        let omega = (0.03_f64 / 0.04).asin() / (steps * H);
        let parameters = SliderCrankParameters { l1: 0.04, l2: 0.03, omega, ..Default::default() };
        Simulation::new(SliderCrank::new(parameters)?, H)
    });
    let stuck = |ended: &Option<Error>| ended.is_some();
    assert_eq!(ended.iter().map(stuck).collect::<Vec<_>>(), [vec![true; steps.len()], vec![false]].concat());
}

/// Steps that end on θ = 0, ±90° and 180°, to rounding, for three turns.
#[test]
fn through_dead_centres() {
    let quarter = |steps: usize| std::f64::consts::FRAC_PI_2 / (steps as f64 * H);
    let ended = same_end(11, 0.6, |index| {
        let parameters = SliderCrankParameters { omega: quarter(100 - 5 * index), ..Default::default() };
        Simulation::new(SliderCrank::new(parameters)?, H)
    });
    assert!(ended.iter().all(Option::is_none), "{ended:?}");
    // without a drive the crank is carried over them
    let ended = same_end(11, 1.0, |index| {
        let omega = quarter(100 - 5 * index);
        let parameters = SliderCrankFreeParameters { omega, ..Default::default() };
        Simulation::new(SliderCrankFree::new(parameters)?, H)
    });
    assert!(ended.iter().all(Option::is_none), "{ended:?}");
}

/// A row of parallelograms passes its change points between steps. One that starts
/// in a change point is singular at once, beside neighbours that do not notice.
#[test]
fn change_points_of_parallelograms() {
    let member = |index: usize| {
        let parameters = NFourBar2Parameters { speed: 1.0 + 0.05 * index as f64, ..Default::default() };
        Simulation::new(NFourBar2::new(parameters)?, 1e-3)
    };
    let ended = same_end(11, 3.0, member);
    assert!(ended.iter().filter(|ended| ended.is_none()).count() >= 9, "{ended:?}");
    let some_flat = |index: usize| {
        let simulation = member(index)?;
        let mut state = simulation.state();
        if index == 3 {
            // uprights lie to the right, bars too
            let coordinates: &[&str] = <NFourBar2 as Mechanism>::Coordinates::NAMES;
            for name in coordinates {
                let at = name.rsplit('_').next().and_then(|digit| digit.parse::<f64>().ok()).unwrap_or(0.0);
                let value = match name.split('_').next() {
                    Some("xu") => at + 0.5,
                    Some("xb") => at + 0.5,
                    _ => 0.0,
                };
                state.q = state.q.with(name, value).unwrap_or(state.q);
            }
        }
        Simulation::builder(*simulation.mechanism(), 1e-3).from_state(state).as_declared().build()
    };
    let ended = same_end(8, 0.2, some_flat);
    for (index, ended) in ended.iter().enumerate() {
        assert_eq!(matches!(ended, Some(Error::Singular { .. })), index == 3, "{index}: {ended:?}");
    }
}

/// The error of a member that cannot start is its outcome, wherever it stands.
#[test]
fn members_that_cannot_start() {
    let member = |index: usize| {
        let l1 = if index.is_multiple_of(3) { -1.0 } else { 0.06 };
        Simulation::new(SliderCrank::new(SliderCrankParameters { l1, ..Default::default() })?, H)
    };
    let outcomes = Ensemble::new(0.01).run(10, member, &()).expect("nobody cancels");
    for (index, outcome) in outcomes.iter().enumerate() {
        match outcome {
            Err(Error::Parameter { name: "l1", .. }) => assert!(index.is_multiple_of(3)),
            Ok(run) => assert_eq!((run.steps, run.ended), (20, None)),
            Err(error) => panic!("{error}"),
        }
    }
    let none = |_| Err::<Simulation<SliderCrank>, _>(Error::Step { step: 0.0 });
    let outcomes = Ensemble::new(0.01).run(3, none, &()).expect("nobody cancels");
    assert!(outcomes.iter().all(|outcome| matches!(outcome, Err(Error::Step { .. }))));
    let late = Ensemble::new(f64::NAN).run(1, free, &()).expect("nobody cancels");
    assert!(matches!(late[0], Err(Error::EndTime { .. })));
}

/// Beyond 10⁹ rad the lanes compute nothing; the scalar does.
#[test]
fn angles_beyond_the_range_of_the_lanes() {
    let fast = |step: f64, omega: f64| {
        let parameters = SliderCrankParameters { omega, ..Default::default() };
        Simulation::builder(SliderCrank::new(parameters)?, step).baumgarte(Baumgarte::<Held>::NONE).build()
    };
    let member = |index: usize| match index {
        1 => fast(1e-7, 1.05e13),
        _ => fast(1e-7, 100.0),
    };
    let ended = same_end(3, 1e-4, member);
    let mut fast = member(1).expect("a start");
    let end = fast.advance_to(1e-4);
    assert_eq!(end.err(), ended[1]);
    assert!(fast.state().q.theta1 > 1e9 || ended[1].is_some());
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let observer = (Violation, Extremes::default());
        pool.install(|| {
            let ensemble = Ensemble::new(0.05);
            ensemble.run(3000, |index| some_stuck(index % 12), &observer).expect("nobody cancels")
        })
    };
    let (one, two) = (run(1), run(2));
    // as text: NaN is not equal to itself, and digits are printed until they are unique
    assert!(format!("{one:?}") == format!("{two:?}"));
    assert_eq!(one.len(), 3000);
}
