//! Steps of reduced states: their motion is that of all coordinates up to the error of the method,
//! reactions at the same state are the same to rounding, the coordinates that constraints give meet
//! them, and every path computes the same bits: fused, in stages, in lanes, from the text.
#![allow(clippy::expect_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_live::{Live, Run, Text};
use mbs_runtime::{
    Adaptive, Components, Error, Mechanism, Pack, Projected, Rk4, Sampled, Simulation, State, System,
    Tolerances,
};

/// Calls a function with a mechanism of the library, the same with reduced states, the file that
/// declares it, and a step.
macro_rules! each {
    ($call:ident) => {
        some!($call);
        if paths::EXHAUSTIVE {
            others!($call);
        }
    };
    ($call:ident: $Name:ident, $file:literal, $step:literal) => {
        $call(models::$Name::declared(), reduced::$Name::declared(), $file, $step)
    };
}

/// The same for those that are like one of `some`.
macro_rules! others {
    ($call:ident) => {
        each!($call: DoublePendulum, "double_pendulum", 0.5e-3);
        each!($call: FourBar, "four_bar", 0.5e-3);
        each!($call: CartPendulum, "cart_pendulum", 0.5e-3);
        each!($call: BlockOnIncline, "block_on_incline", 1e-4);
        each!($call: GearedMotor, "geared_motor", 0.5e-3);
        each!($call: ScotchYoke, "scotch_yoke", 0.5e-3);
        each!($call: VEngine, "v_engine", 0.1e-3);
        each!($call: QuickReturn, "quick_return", 0.5e-3);
        each!($call: Metronome, "metronome", 0.5e-3);
    };
}

/// The same for some of them: with a drive, with an input, with a loop, a table and gears.
macro_rules! some {
    ($call:ident) => {
        each!($call: SliderCrank, "slider_crank", 0.5e-3);
        each!($call: SliderCrankFree, "slider_crank_free", 0.5e-3);
        each!($call: FourBarFree, "four_bar_free", 0.5e-3);
        each!($call: CamFollower, "cam_follower", 0.5e-3);
        each!($call: PlanetaryGear, "planetary_gear", 0.5e-3);
    };
}

const STEPS: u64 = 200;

fn run<M: Mechanism<Real = f64>>(mechanism: M, h: f64, steps: u64) -> Simulation<M> {
    let mut run = Simulation::new(mechanism, h).expect("a start");
    run.advance_to(run.time() + h * steps as f64).expect("steps");
    run
}

/// Positions and velocities.
fn state<M: Mechanism<Real = f64>>(run: &Simulation<M>) -> Vec<f64> {
    let State { q, v, .. } = run.state();
    [q.into_array().as_ref(), v.into_array().as_ref()].concat()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Components of one mechanism as those of another with the same names.
fn cast<A: Components<Real = f64>, B: Components<Real = f64>>(from: A) -> B {
    let mut array = B::splat(f64::NAN).into_array();
    array.as_mut().copy_from_slice(from.into_array().as_ref());
    B::from_array(array)
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max)
}

/// The error of a method of second order is about 4/3 of what halving the step changes; near
/// rounding, 200 steps of some ε are left.
#[test]
fn motions_agree_to_the_error_of_the_method() {
    fn check<A: Mechanism<Real = f64>, R: Mechanism<Real = f64>>(all: A, reduced: R, file: &str, h: f64) {
        let [of_all, halved] = [1, 2].map(|parts| state(&run(all, h / parts as f64, parts * STEPS)));
        let [of_reduced, reduced_halved] =
            [1, 2].map(|parts| state(&run(reduced, h / parts as f64, parts * STEPS)));
        let error = difference(&of_all, &halved) + difference(&of_reduced, &reduced_halved);
        let apart = difference(&of_reduced, &of_all);
        assert!(apart <= 2.0 * error + 1e-12, "{file}: {apart:e} apart, an error of {error:e}");
        println!(
            "{file}: {} of {} coordinates, {apart:.1e} apart, error {error:.1e}",
            R::INFO.states.len(),
            R::INFO.coordinates.len()
        );
    }
    each!(check);
}

/// Reactions at a state of a run, those of all coordinates computed from the same numbers; and those
/// that a step gives. Rounding is magnified by the pivot growth.
#[test]
fn reactions_are_those_of_all_coordinates() {
    fn check<A: Mechanism<Real = f64>, R: Mechanism<Real = f64>>(all: A, reduced: R, file: &str, h: f64) {
        let mut run = run(reduced, h, 50);
        for _ in 0..20 {
            let State { t, q, v } = run.state();
            let at = State { t, q: cast(q), v: cast(v) };
            let none = A::Constraints::splat(0.0);
            let expected = all.reactions(&at, &cast(*run.inputs()), &none);
            let found = run.reactions().expect("reactions");
            let of_step = run.step_with_reactions().expect("a step");
            for (what, found, expected) in [
                ("q̈", numbers(found.acceleration), numbers(expected.acceleration)),
                ("λ", numbers(found.multipliers), numbers(expected.multipliers)),
                ("q̈ of a step", numbers(of_step.acceleration), numbers(expected.acceleration)),
                ("λ of a step", numbers(of_step.multipliers), numbers(expected.multipliers)),
            ] {
                let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                for (found, expected) in found.iter().zip(&expected) {
                    assert!((found - expected).abs() <= 1e-12 * size, "{file}, {what}: {found} {expected}");
                }
            }
        }
    }
    fn numbers<C: Components<Real = f64>>(components: C) -> Vec<f64> {
        components.into_array().as_ref().to_vec()
    }
    each!(check);
}

/// Coordinates that constraints give meet them to a rounding of the terms, however long a run is.
#[test]
fn given_coordinates_meet_their_constraints() {
    fn check<A: Mechanism<Real = f64>, R: Mechanism<Real = f64>>(_: A, reduced: R, file: &str, h: f64) {
        let run = run(reduced, h, 1000);
        let State { t, q, v } = run.state();
        let phi = reduced.phi(t, &q).into_array();
        let met = phi.as_ref().iter().filter(|phi| phi.abs() < 1e-15 * (1.0 + q.largest().1)).count();
        let given = R::INFO.coordinates.len() - R::INFO.states.len();
        assert!(met >= given, "{file}: {given} given, {met} met: {:?}", phi.as_ref());
        let rates = reduced.phi_dot(&State { t, q, v }).into_array();
        let small = 1e-14 * (1.0 + v.largest().1);
        let met = rates.as_ref().iter().filter(|rate| rate.abs() < small).count();
        assert!(met >= given, "{file}: {given} given, {met} rates met: {:?}", rates.as_ref());
    }
    each!(check);
}

#[test]
fn stages_and_lanes_compute_the_same_bits() {
    fn check<A: Mechanism<Real = f64>, R: Mechanism<Real = f64>>(_: A, reduced: R, file: &str, h: f64) {
        let start = Simulation::new(reduced, h).expect("a start");
        let (mut fused, mut staged, mut pack) = (start, start, Pack::new([start; 4]));
        for _ in 0..STEPS {
            fused.step().expect("a step");
            staged.step_in_stages().expect("a step");
            assert_eq!(pack.step(), [true; 4], "{file}");
        }
        assert_eq!(bits(&state(&staged)), bits(&state(&fused)), "{file} in stages");
        assert_eq!(bits(&state(&pack.simulation(3))), bits(&state(&fused)), "{file} in lanes");
        assert_eq!(pack.state(2), fused.state(), "{file}");
    }
    each!(check);
}

/// The declaration as text, run by `mbs-live`: steps, other methods, and runs to a tolerance.
#[test]
fn texts_compute_the_same_bits() {
    fn check<A: Mechanism<Real = f64>, R: Mechanism<Real = f64>>(_: A, reduced: R, file: &str, h: f64) {
        let live = from_text(file);
        assert_eq!(live.declared_info(), R::INFO);
        let typed: [Box<dyn System>; 4] = [
            Box::new(Simulation::new(reduced, h).expect("a start")),
            Box::new(Simulation::builder(reduced, h).method::<Projected<Rk4>>().build().expect("a start")),
            sampled(Adaptive::builder(reduced).tolerances(TOLERANCES).build(), h),
            sampled(Adaptive::builder(reduced).scheme::<mbs_runtime::Dop853>().build(), h),
        ];
        let projected = mbs_runtime::Explicit::projected(&mbs_runtime::RK4);
        let texts: [Box<dyn System>; 4] = [
            Box::new(Run::builder(&live, h).build().expect("a start")),
            Box::new(Run::builder(&live, h).method(projected).build().expect("a start")),
            sampled(Run::adaptive(&live).tolerances(TOLERANCES).build(), h),
            sampled(Run::adaptive(&live).scheme::<mbs_runtime::Dop853>().build(), h),
        ];
        for (mut typed, mut text) in typed.into_iter().zip(texts) {
            for _ in 0..STEPS / 4 {
                typed.step().expect("a step");
                text.step().expect("a step");
            }
            assert_eq!(bits(&told(&*text)), bits(&told(&*typed)), "{file}");
        }
    }
    some!(check);
}

const TOLERANCES: Tolerances =
    Tolerances { rtol: 1e-8, atol: 1e-10, max_step: f64::INFINITY, first_step: None };

fn sampled<D: mbs_runtime::Dynamics<Real = f64> + 'static, S: mbs_runtime::Scheme>(
    run: Result<Adaptive<D, S>, Error>,
    h: f64,
) -> Box<dyn System> {
    Box::new(Sampled::new(run.expect("a start"), h).expect("an interval"))
}

fn from_text(file: &str) -> Live {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../models/src/{file}.rs"));
    let text = std::fs::read_to_string(path).expect("a mechanism of the library");
    Text::rust(file, text.replace(" dof = ", " states = reduced; dof = ")).compile().expect("a mechanism")
}

/// Everything that a run tells.
fn told(run: &dyn System) -> Vec<f64> {
    let info = run.equations().info();
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    let [mut q, mut v, mut a] = [(); 3].map(|()| vec![0.0; n]);
    let (mut multipliers, mut outputs) = (vec![0.0; m], vec![0.0; info.outputs.len()]);
    run.state(&mut q, &mut v);
    run.reactions(&mut a, &mut multipliers).expect("reactions");
    run.outputs(&a, &multipliers, &mut outputs).expect("outputs");
    [&q[..], &v, &a, &multipliers, &outputs, &run.violations()].concat()
}
