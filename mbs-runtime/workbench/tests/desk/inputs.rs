//! Inputs from a table are functions of time: whatever the step and the method, every stage sees the inputs of its
//! own time, so that a method keeps its order.

use mbs_runtime::{
    DOP853, HEUN, Mechanism, RATTLE, RATTLE4, RK4, Stabilization, TRBDF2, Tableau, Tolerances,
};
use mbs_workbench::{OtherMethod, Settings, Signals, model};

mbs_runtime::mechanism! {
    /// A weight on a massless rod that is pushed to the side.
    pub Pendulum {
        dof = 1;
        param length = 0.8 [m];
        input push [N];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        force pushed on bob = (push, 0);
        start { guess x = 0.1 [m]; y = -0.79 [m]; }
        output acting [N] = push;
    }
}

const END: f64 = 0.96;

/// 12 N · sin 5t in so many straight lines.
fn swell(lines: u32) -> Signals {
    let times: Vec<f64> = (0..=lines).map(|at| END * f64::from(at) / f64::from(lines)).collect();
    let values = times.iter().map(|t| 12.0 * (5.0 * t).sin()).collect();
    signals(times, values)
}

fn signals(times: Vec<f64>, values: Vec<f64>) -> Signals {
    Signals::new(<Pendulum as Mechanism>::INFO, times, vec![("push".into(), values)]).unwrap()
}

/// x at the end.
fn end(signals: &Signals, settings: Settings) -> f64 {
    let settings = Settings { end: END, signals: Some(signals.clone()), ..settings };
    let recording = model::of::<Pendulum>().simulate(&settings, &mut |_, _| ()).unwrap();
    assert!(recording.ended.is_none(), "{:?}", recording.ended);
    *recording.column("x").unwrap().values.last().unwrap()
}

fn to_a_tolerance(step: f64) -> Settings {
    let tolerances = Tolerances { rtol: 1e-12, atol: 1e-13, ..Tolerances::default() };
    Settings { step, tolerances: Some(tolerances), scheme: Some(&DOP853), ..Settings::default() }
}

fn order(signals: &Signals, step: f64, with: impl Fn(f64) -> Settings) -> f64 {
    let reference = end(signals, to_a_tolerance(END));
    let error = |step: f64| (end(signals, with(step)) - reference).abs();
    (error(step) / error(0.5 * step)).log2()
}

/// Where inputs were held over a step, every method was of second order. The table is so fine that its corners
/// change the motion by less than a thousandth of the error; a ramp has none.
#[test]
fn methods_keep_their_order() {
    let ramp = signals(vec![0.0, END], vec![2.0, 14.0]);
    let of_scheme = |scheme: &'static Tableau, stabilization: Stabilization| {
        move |step: f64| Settings {
            step,
            scheme: Some(scheme),
            stabilization: Some(stabilization),
            ..Settings::default()
        }
    };
    let constant =
        |method: OtherMethod| move |step: f64| Settings { step, other: Some(method), ..Settings::default() };
    for (what, signals) in [("swell", swell(48_000)), ("ramp", ramp)] {
        let check = |method: &str, expected: f64, found: f64| {
            println!("{what}: {method} {found:.3}");
            assert!(found > expected - 0.25, "{what}: {method} {found}");
        };
        for stabilization in Stabilization::ALL {
            check("heun", 2.0, order(&signals, 2e-3, of_scheme(&HEUN, stabilization)));
        }
        check("rk4", 4.0, order(&signals, 3e-2, of_scheme(&RK4, Stabilization::Projection)));
        check("rattle", 2.0, order(&signals, 4e-3, constant(OtherMethod::Rattle(&RATTLE))));
        check("rattle4", 4.0, order(&signals, 3e-2, constant(OtherMethod::Rattle(&RATTLE4))));
        check("trbdf2", 2.0, order(&signals, 4e-3, constant(OtherMethod::Implicit(&TRBDF2))));
    }
}

/// The time between two samples of a run to a tolerance was the time over which an input was held.
#[test]
fn samples_do_not_change_a_run_to_a_tolerance() {
    let coarse = signals(vec![0.0, 0.11, 0.37, END], vec![0.0, 30.0, -20.0, 5.0]);
    let reference = end(&coarse, to_a_tolerance(END));
    for step in [0.48, 0.06, 1e-3] {
        assert!((end(&coarse, to_a_tolerance(step)) - reference).abs() < 1e-11, "{step}");
    }
    // steps end at the corners, so that few are taken and none is rejected for a corner
    let settings = Settings { end: END, signals: Some(coarse), ..to_a_tolerance(END) };
    let recording = model::of::<Pendulum>().simulate(&settings, &mut |_, _| ()).unwrap();
    let effort = recording.summary.effort.unwrap();
    assert!(effort.steps < 50 && effort.rejected < 5, "{effort:?}");
}

/// Outputs beside a state are those of the input at its time. They were those of the input in the middle of the next
/// step.
#[test]
fn outputs_are_those_of_their_time() {
    let signals = signals(vec![0.0, 1.0], vec![0.0, 10.0]);
    for settings in [to_a_tolerance(0.25), Settings { step: 0.25, ..Settings::default() }] {
        let settings =
            Settings { end: 1.0, signals: Some(signals.clone()), allow_unstable: true, ..settings };
        let recording = model::of::<Pendulum>().simulate(&settings, &mut |_, _| ()).unwrap();
        assert_eq!(recording.column("acting").unwrap().values, [0.0, 2.5, 5.0, 7.5, 10.0]);
    }
}

/// A constant input from a table gives the numbers of the same input as a value.
#[test]
fn a_constant_table_is_a_value() {
    let table = Settings { signals: Some(signals(vec![0.0], vec![7.0])), ..Settings::default() };
    let value = Settings { inputs: vec![("push".into(), 7.0)], ..Settings::default() };
    for (scheme, stabilization) in
        [(&HEUN, Stabilization::Held), (&RK4, Stabilization::PerStage), (&RK4, Stabilization::Projection)]
    {
        let run = |settings: &Settings| {
            let (scheme, stabilization) = (Some(scheme), Some(stabilization));
            let settings = Settings { end: 0.5, scheme, stabilization, ..settings.clone() };
            let recording = model::of::<Pendulum>().simulate(&settings, &mut |_, _| ()).unwrap();
            recording.columns.iter().map(|column| column.values.clone()).collect::<Vec<_>>()
        };
        assert_eq!(run(&table), run(&value), "{} {}", scheme.word, stabilization.word());
    }
}
