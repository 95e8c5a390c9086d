//! Identification: parameters found again from noisy runs within the errors that are told, intervals that
//! contain the truth as often as they say, linear regression as a closed form, and what is refused.
//!
//! Noise is normal, from a generator with a seed, so that every run of the tests sees the same.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod refusals;

use std::sync::Arc;

use mbs_analysis::{Driven, Experiment, Fit, InputTable, Measurement, Trials, Unknown, trials_of_type};
use mbs_live::{Live, Prepared, Text};
use mbs_runtime::equations::Partials;
use mbs_runtime::{Adaptive, Mechanism, Sampled, System, Tolerances, mechanism};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

mechanism! {
    /// m ẍ + c ẋ + k x = push.
    pub Oscillator {
        dof = 1;
        param m = 2 [kg] where m > 0;
        param c = 4 [N*s/m] where c >= 0;
        param k = 200 [N/m] where k > 0;
        /// Without any influence.
        param paint = 1 [m];
        input push [N];
        body block (x) { mass = m; }
        force all on x = push - k*x - c*der(x);
        start { x = 0; }
        output wall [N] = k*x + c*der(x);
    }
}

const CAR: &str = "QuarterCar {
    dof = 2;
    param spring = 20 [kN/m] where spring > 0;
    param damper = 1200 [N*s/m] where damper >= 0;
    param sprung = 300 [kg] where sprung > 0;
    input road [m];
    body car (y = body) { mass = sprung; }
    body hub (y = wheel) { mass = 40 [kg]; }
    force above on body = -spring*(body - wheel) - damper*(der(body) - der(wheel));
    force below on wheel = spring*(body - wheel) + damper*(der(body) - der(wheel));
    force tyre on wheel = -180 [kN/m]*(wheel - road);
    start { body = 0; wheel = 0; }
    output acceleration [m/s^2] = der(der(body));
}";

/// Normal numbers by Box and Muller from those of Steele, Lea and Flood's SplitMix64.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let (a, b) = (self.uniform(), self.uniform());
        (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }

    fn added(&mut self, values: &[f64], deviation: f64) -> Vec<f64> {
        values.iter().map(|value| value + deviation * self.normal()).collect()
    }
}

/// x of the oscillator at rest that a force of 20 N pushes from t = 0 on:
/// x = F/k (1 − e^(−δt)(cos νt + δ/ν sin νt)).
fn pushed(times: &[f64]) -> Vec<f64> {
    let (delta, nu) = (1.0, 99.0_f64.sqrt());
    let at = |t: &f64| 0.1 * (1.0 - (-delta * t).exp() * ((nu * t).cos() + delta / nu * (nu * t).sin()));
    times.iter().map(at).collect()
}

fn instants(count: usize, interval: f64) -> Vec<f64> {
    (0..count).map(|at| at as f64 * interval).collect()
}

fn oscillator() -> Experiment {
    Experiment::of(<Oscillator as Mechanism>::INFO).inputs(vec![20.0])
}

fn trials_of_text(live: &Live) -> impl Trials + use<> {
    let over = live.over::<Partials>();
    move |parameters: &[Partials]| {
        let live = over.with_parameters(|own| own.copy_from_slice(parameters))?;
        Ok(Prepared::new(&live))
    }
}

/// How many standard errors each estimate is from the truth.
fn distances(fit: &Fit, truth: &[f64]) -> Vec<f64> {
    let all = fit.estimates.iter().zip(truth);
    all.map(|(estimate, truth)| (estimate.value - truth) / estimate.standard_error).collect()
}

/// From a third and three times the true values, from two seconds of a position with 2 % of noise.
#[test]
fn mass_damper_and_spring_are_found_again() {
    let times = instants(200, 0.01);
    let exact = pushed(&times);
    let truth = [2.0, 4.0, 200.0];
    let most = (0..20_u64)
        .into_par_iter()
        .map(|seed| {
            let values = Noise(seed).added(&exact, 2e-3);
            let factor = |bit: u64| if seed >> bit & 1 == 0 { 3.0 } else { 1.0 / 3.0 };
            let fit = oscillator()
                .measured("x", &times, &values)
                .unknown("m", 2.0 * factor(0))
                .unknown("c", 4.0 * factor(1))
                .unknown("k", 200.0 * factor(2))
                .fit(&trials_of_type::<Oscillator>())
                .unwrap();
            assert!(fit.has_converged);
            let distances = distances(&fit, &truth);
            assert!(
                distances.iter().all(|d| d.abs() < 3.0),
                "seed {seed}: {distances:?} {:?}",
                fit.estimates
            );
            assert!(
                (fit.remainders[0].deviation / 2e-3 - 1.0).abs() < 0.2,
                "{}",
                fit.remainders[0].deviation
            );
            fit.runs
        })
        .max();
    println!("{most:?} runs at most");
    assert!(most < Some(70), "{most:?}");
}

/// A car drives over a kerb that rises within 50 ms; a text, with the road from a table, and two sensors of
/// unlike noise and rates.
#[test]
fn a_suspension_is_found_again() {
    let live = Text::declaration("car.mbs", CAR).compile().unwrap();
    let road = InputTable::new(vec![0.1, 0.15], vec![(0, vec![0.0, 0.05])]).unwrap();
    let road = Arc::new(road);
    let (often, seldom) = (instants(301, 0.005), instants(76, 0.02));
    let sensors = recorded(&live, &road);
    let truth = [20e3, 1200.0, 300.0];
    let most = (0..20_u64)
        .into_par_iter()
        .map(|seed| {
            let trials = trials_of_text(&live);
            let mut noise = Noise(seed);
            let [position, acceleration] = &sensors;
            let every_fourth: Vec<f64> = position.iter().step_by(4).copied().collect();
            let factor = |bit: u64| if seed >> bit & 1 == 0 { 3.0 } else { 1.0 / 3.0 };
            let fit = Experiment::of(live.declared_info())
                .driven_by(road.clone())
                .measured("body", &seldom, &noise.added(&every_fourth, 0.5e-3))
                .measured("acceleration", &often, &noise.added(acceleration, 0.1))
                .unknown("spring", 20e3 * factor(0))
                .unknown("damper", 1200.0 * factor(1))
                .unknown("sprung", 300.0 * factor(2))
                .fit(&trials)
                .unwrap();
            let distances = distances(&fit, &truth);
            assert!(
                distances.iter().all(|d| d.abs() < 3.0),
                "seed {seed}: {distances:?} {:?}",
                fit.estimates
            );
            for (remainder, deviation) in fit.remainders.iter().zip([0.5e-3, 0.1]) {
                assert!((remainder.deviation / deviation - 1.0).abs() < 0.35, "{}", remainder.deviation);
            }
            fit.runs
        })
        .max();
    println!("{most:?} runs at most");
    assert!(most < Some(85), "{most:?}");
}

/// Position and acceleration of the car every 5 ms.
fn recorded(live: &Live, road: &Arc<InputTable>) -> [Vec<f64>; 2] {
    let tolerances = Tolerances { rtol: 1e-11, atol: 1e-13, ..Tolerances::default() };
    let car = Driven::new(Prepared::new(live), road.clone());
    let mut run = Sampled::new(Adaptive::builder(car).tolerances(tolerances).build().unwrap(), 5e-3).unwrap();
    let [mut positions, mut accelerations] = [Vec::new(), Vec::new()];
    for _ in 0..=300 {
        let (mut q, mut v, mut a) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        run.state(&mut q, &mut v);
        run.reactions(&mut a, &mut []).unwrap();
        positions.push(q[0]);
        accelerations.push(a[0]);
        run.step().unwrap();
    }
    [positions, accelerations]
}

/// Of 500 runs with other noise, 95 % of the intervals contain the truth: the number that do is binomial
/// with a standard deviation of 1 %.
#[test]
fn intervals_contain_the_truth_as_often_as_they_say() {
    let times = instants(60, 0.02);
    let exact = pushed(&times);
    let truth = [2.0, 4.0, 200.0];
    let hits: Vec<[bool; 3]> = (1000..1500_u64)
        .into_par_iter()
        .map(|seed| {
            let fit = oscillator()
                .measured("x", &times, &Noise(seed).added(&exact, 4e-3))
                .unknown("m", 2.2)
                .unknown("c", 3.6)
                .unknown("k", 210.0)
                .starts(1)
                .fit(&trials_of_type::<Oscillator>())
                .unwrap();
            [0, 1, 2].map(|at| {
                let [low, high] = fit.estimates[at].interval;
                low <= truth[at] && truth[at] <= high
            })
        })
        .collect();
    for at in 0..3 {
        let share = hits.iter().filter(|hit| hit[at]).count() as f64 / hits.len() as f64;
        println!("interval {at} contains the truth in {:.1} %", 100.0 * share);
        assert!((0.92..=0.98).contains(&share), "{at}: {share}");
    }
}

mechanism! {
    /// y = h + v t − ½ g t², linear in all that can be unknown.
    pub Ball {
        dof = 1;
        param g = 9.81 [m/s^2];
        gravity = (0, -g);
        body ball (y) { mass = 1 [kg]; }
        start { y = 1 [m]; der(y) = 5 [m/s]; }
    }
}

/// Estimates, errors and intervals of a linear model are those of linear regression: of
/// h, v and g from (XᵀX)⁻¹Xᵀy, s² = |r|²/(n − 3), Student's t of n − 3.
#[test]
fn a_linear_model_is_regression() {
    let times = instants(12, 0.1);
    let exact: Vec<f64> = times.iter().map(|t| 1.0 + 5.0 * t - 0.5 * 9.81 * t * t).collect();
    let values = Noise(7).added(&exact, 0.02);
    let fit = Experiment::of(<Ball as Mechanism>::INFO)
        .measured("y", &times, &values)
        .unknown("y", 2.0)
        .unknown("der(y)", 3.0)
        .unknown("g", 20.0)
        .fit(&trials_of_type::<Ball>())
        .unwrap();
    let x = powers(&times);
    let y = DVector::from_vec(values);
    let inverse = (x.transpose() * &x).try_inverse().unwrap();
    let expected = &inverse * x.transpose() * &y;
    let s = ((&y - &x * &expected).norm_squared() / 9.0).sqrt();
    // t.ppf(0.975, 9) of SciPy
    let t = 2.2621571627409915;
    for (at, estimate) in fit.estimates.iter().enumerate() {
        let error = s * inverse[(at, at)].sqrt();
        let near = |found: f64, expected: f64| {
            // the runs' tolerance, and that to which the minimum is found
            assert!((found - expected).abs() < 1e-6 * error, "{}: {found}, {expected}", estimate.name);
        };
        near(estimate.value, expected[at]);
        assert!((estimate.standard_error / error - 1.0).abs() < 1e-6);
        assert!((estimate.interval[0] - (expected[at] - t * error)).abs() < 1e-5 * error);
        assert!((estimate.interval[1] - (expected[at] + t * error)).abs() < 1e-5 * error);
    }
    assert!((fit.remainders[0].deviation / s - 1.0).abs() < 1e-6);
    assert_eq!(fit.freedom, 9);
}

fn powers(times: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(times.len(), 3, |row, column| {
        let t = times[row];
        [1.0, t, -0.5 * t * t][column]
    })
}

/// Given deviations weigh samples and set the errors, whatever is left over: the mean of two readings with
/// σ of 1 and 2 mm is (4a + b)/5, with σ² = 4/5 mm².
#[test]
fn given_deviations_are_believed() {
    mechanism! {
        pub Still {
            dof = 1;
            body block (x) { mass = 1 [kg]; }
            start { x = 0; }
            output same [m] = x;
        }
    }
    let reading = |name: &str, value: f64, deviation: f64| Measurement {
        name: name.into(),
        times: vec![1.0],
        values: vec![value],
        deviation: Some(deviation),
    };
    let fit = Experiment::of(<Still as Mechanism>::INFO)
        .with(reading("x", 10e-3, 1e-3))
        .with(reading("same", 20e-3, 2e-3))
        .unknown("x", 0.0)
        .fit(&trials_of_type::<Still>())
        .unwrap();
    let found = &fit.estimates[0];
    assert!((found.value - 12e-3).abs() < 1e-12, "{}", found.value);
    assert!((found.standard_error - (0.8e-6_f64).sqrt()).abs() < 1e-12);
    // of the normal distribution
    assert!((fit.coverage - 1.959963984540054).abs() < 1e-9);
    // (2/1)² + (8/2)²
    assert!((fit.chi_squared - 20.0).abs() < 1e-9);
}

/// From exact data the values come back to the error of the runs, and so does a start.
#[test]
fn exact_data_give_exact_values() {
    let times = instants(100, 0.02);
    let fit = oscillator()
        .measured("x", &times, &pushed(&times))
        .unknown("k", 600.0)
        .unknown("m", 1.0)
        .unknown("x", 0.03)
        .fit(&trials_of_type::<Oscillator>())
        .unwrap();
    for (estimate, truth) in fit.estimates.iter().zip([200.0, 2.0, 0.0]) {
        assert!((estimate.value - truth).abs() < 1e-7 * (1.0 + truth), "{estimate:?}");
    }
}

/// Restitution and friction of a block that slides against a wall and comes to rest: derivatives go through the impact and the
/// halt. Data are of the closed form.
#[test]
fn restitution_and_friction_are_found_again() {
    let (speed, e, mu) = (3.0_f64, 0.7, 0.15);
    let text = "Block { dof = 1; param e = 0.4 where e >= 0; param mu = 0.25 where mu >= 0;
        body block (x) { mass = 2 [kg]; }
        stop wall: x <= 1 [m] { restitution = e; }
        friction grip (block, ground) along (1, 0) { coefficient = mu; normal = 19.62 [N]; law = coulomb; }
        start { x = 0; der(x) = 3 [m/s]; } }";
    let live = Text::declaration("block", text).compile().unwrap_or_else(|error| panic!("{error}"));
    let a = mu * 9.81;
    let hit = (speed - (speed.powi(2) - 2.0 * a).sqrt()) / a;
    let back = e * (speed - a * hit);
    let at = |t: &f64| {
        let since = (t - hit).min(back / a);
        if *t < hit { speed * t - 0.5 * a * t * t } else { 1.0 - back * since + 0.5 * a * since * since }
    };
    let times = instants(120, 0.02);
    let exact: Vec<f64> = times.iter().map(at).collect();
    let experiment = Experiment::of(live.declared_info()).measured("x", &times, &exact);
    let fit = experiment.unknown("e", 0.5).unknown("mu", 0.2).fit(&trials_of_text(&live)).unwrap();
    for (estimate, truth) in fit.estimates.iter().zip([e, mu]) {
        assert!((estimate.value - truth).abs() < 1e-7, "{estimate:?}");
    }
}

/// True damping 0, which `where c >= 0` bounds; noise would have it below.
#[test]
fn declared_and_given_bounds_hold() {
    let times = instants(100, 0.02);
    let exact: Vec<f64> = times.iter().map(|t| 0.1 * (1.0 - (10.0 * t).cos())).collect();
    let mut at_bound = 0;
    for seed in 0..10 {
        let values = Noise(seed).added(&exact, 2e-3);
        let fit = oscillator()
            .measured("x", &times, &values)
            .unknown("c", 4.0)
            .unknown("k", 190.0)
            .fit(&trials_of_type::<Oscillator>())
            .unwrap();
        let [c, k] = &fit.estimates[..] else { panic!("two") };
        assert!(c.value >= 0.0 && (k.value - 200.0).abs() < 4.0 * k.standard_error, "{fit:?}");
        at_bound += usize::from(c.is_at_bound);
        assert_eq!(c.is_at_bound, c.value == 0.0 && c.standard_error == 0.0);
    }
    // about half of them
    assert!((2..=8).contains(&at_bound), "{at_bound}");
    let bounded = Unknown { name: "k".into(), guess: Some(210.0), bounds: [205.0, 300.0] };
    let fit = oscillator()
        .measured("x", &times, &exact)
        .looking_for(bounded)
        .fit(&trials_of_type::<Oscillator>())
        .unwrap();
    assert!(fit.estimates[0].value == 205.0 && fit.estimates[0].is_at_bound);
}
