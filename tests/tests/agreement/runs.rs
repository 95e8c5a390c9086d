//! Runs of both, behind the interface that tools see.

use mbs_live::{Live, Run};
use mbs_runtime::equations::At;
use mbs_runtime::{
    Adaptive, Baumgarte, Error, Held, Mechanism, PerStage, Sampled, Simulation, State, System, Tolerances,
};

use crate::compare::{numbers, of, same};
use crate::declarations::{BOUNCER, Bouncer, FREE, Free};

/// Everything that a [`System`] tells is the same, at the start and on the way.
pub fn runs_agree<M: Mechanism<Real = f64>>(live: &Live, mechanism: M, inputs: &[f64], h: f64) {
    let typed = Simulation::builder(mechanism, h).inputs(of(inputs)).build().expect("a start");
    let run = Run::builder(live, h).inputs(inputs).build().expect("a start");
    assert!(run.derivation() == M::DERIVATION && run.sketch() == M::SKETCH);
    side_by_side(Box::new(typed), Box::new(run), inputs);
}

/// The same of runs to a tolerance, whose steps are the same too.
pub fn tolerances_agree<M: Mechanism<Real = f64>>(live: &Live, mechanism: M, inputs: &[f64], h: f64) {
    let tolerances = Tolerances { rtol: 1e-7, ..Tolerances::default() };
    let typed = Adaptive::builder(mechanism).tolerances(tolerances).inputs(of(inputs)).build();
    let typed = Sampled::new(typed.expect("a start"), h).expect("an interval");
    let run = Run::adaptive(live).tolerances(tolerances).inputs(inputs.to_vec()).build();
    let run = Sampled::new(run.expect("a start"), h).expect("an interval");
    side_by_side(Box::new(typed), Box::new(run), inputs);
}

fn side_by_side(mut typed: Box<dyn System>, mut run: Box<dyn System>, inputs: &[f64]) {
    for steps in [0, 1, 7, 92] {
        typed.advance(steps).expect("steps");
        run.advance(steps).expect("steps");
        assert_eq!(run.time().to_bits(), typed.time().to_bits());
        assert_eq!(run.steps(), typed.steps());
        assert_eq!(run.steps_to(1.0), typed.steps_to(1.0));
        assert_eq!(run.steps_to(-1.0), typed.steps_to(-1.0));
        same("what a run tells", &told(&*run), &told(&*typed));
        assert_eq!(run.worst_place(), typed.worst_place());
        assert_eq!(run.effort(), typed.effort());
        let pushed: Vec<f64> = inputs.iter().map(|input| 1.5 * input).collect();
        typed.set_inputs(&pushed);
        run.set_inputs(&pushed);
    }
}

/// Both find the same declared events on their way.
#[test]
fn events_are_the_same() {
    let live = mbs_live::Text::declaration("bouncer.mbs", BOUNCER).compile().expect("a mechanism");
    assert_eq!(live.declared_info(), Bouncer::<f64>::INFO);
    let typed = Adaptive::builder(Bouncer::declared()).build().expect("a start");
    let mut typed = Sampled::new(typed, 0.01).expect("an interval");
    let run = Run::adaptive(&live).build().expect("a start");
    let mut run = Sampled::new(run, 0.01).expect("an interval");
    let mut found = 0;
    for _ in 0..100 {
        let (event, other) = (run.step_to_event().expect("a step"), typed.step_to_event().expect("a step"));
        assert_eq!(event, other);
        assert_eq!(run.time().to_bits(), System::time(&typed).to_bits());
        found += usize::from(event.is_some());
    }
    assert_eq!(found, 3);
}

/// All numbers that a run tells in its present state.
fn told(run: &dyn System) -> Vec<f64> {
    let info = run.equations().info();
    let zeros = |count: usize| vec![0.0; count];
    let n = info.coordinates.len();
    let (mut q, mut v, mut acceleration) = (zeros(n), zeros(n), zeros(n));
    let (mut multipliers, mut outputs) = (zeros(info.constraints.len()), zeros(info.outputs.len()));
    let (mut inputs, mut parameters) = (zeros(info.inputs.len()), zeros(info.parameters.len()));
    let mut points = zeros(2 * run.sketch().points.len());
    run.state(&mut q, &mut v);
    run.reactions(&mut acceleration, &mut multipliers).expect("reactions");
    run.outputs(&acceleration, &multipliers, &mut outputs).expect("outputs");
    run.inputs(&mut inputs);
    run.parameters(&mut parameters);
    run.points(run.time(), &q, &mut points);
    let energies = run.energies(At { t: run.time(), q: &q, v: &v });
    let health = [run.worst_growth(), run.digits_left(), run.step_size()];
    let scalars = [&run.violations()[..], &energies, &health].concat();
    [q, v, acceleration, multipliers, outputs, inputs, parameters, points, scalars].concat()
}

/// Both refuse choices that cannot be made, and steps that cannot be taken, in the same words.
#[test]
fn runs_are_refused_with_the_same_words() {
    let live = mbs_live::Text::declaration("free.mbs", FREE).compile().expect("a mechanism");
    let unstable = Baumgarte::<PerStage>::new(2600.0, 2000.0).expect("gains");
    let not_finite = f64::NAN;
    for (h, input, gains) in
        [(0.0, 0.5, None), (not_finite, 0.5, None), (1e-3, not_finite, None), (0.5e-3, 0.5, Some(unstable))]
    {
        let typed = Simulation::builder(Free::declared(), h).inputs(of(&[input]));
        let run = Run::builder(&live, h).inputs(&[input]);
        let (typed, run) = match gains {
            Some(gains) => (typed.baumgarte(gains).build().err(), run.baumgarte(gains).build().err()),
            None => (typed.build().err(), run.build().err()),
        };
        assert_eq!(words(run), words(typed));
    }
    // the start of a given state
    let start = Simulation::new(Free::declared(), 1e-3).expect("a start").state();
    let (q, v) = (numbers(start.q), numbers(start.v));
    for (t, bent) in [(1e14, 0.0), (0.0, 0.1), (0.0, not_finite)] {
        let mut state = State { t, ..start };
        state.q.theta2 += bent;
        let q: Vec<f64> = numbers(state.q);
        let typed = Simulation::builder(Free::declared(), 1e-3).from_state(state).build().err();
        let run = Run::builder(&live, 1e-3).from_state(At { t, q: &q, v: &v }).build().err();
        assert_eq!(words(run), words(typed));
    }
    assert!(Run::builder(&live, 1e-3).from_state(At { t: 0.0, q: &q, v: &v }).build().is_ok());

    let mut typed = Simulation::new(Free::declared(), 0.5e-3).expect("a start");
    let mut run =
        Run::builder(&live, 0.5e-3).baumgarte(Baumgarte::<Held>::deadbeat(0.5e-3)).build().expect("a start");
    System::set_inputs(&mut typed, &[f64::INFINITY]);
    run.set_inputs(&[f64::INFINITY]);
    assert_eq!(words(run.step().err()), words(System::step(&mut typed).err()));
    assert_eq!(run.steps(), 0);
    System::set_inputs(&mut typed, &[1e9]);
    run.set_inputs(&[1e9]);
    assert_eq!(words(run.advance(1000).err()), words(System::advance(&mut typed, 1000).err()));
    assert_eq!(run.steps(), System::steps(&typed));
}

#[track_caller]
fn words(error: Option<Error>) -> String {
    error.expect("refused").to_string()
}
