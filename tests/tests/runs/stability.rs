//! `is_stable` and `deadbeat` agree with the eigenvalues of the step map of
//! e¨ + 2αė + β²e = 0, which is stepped here independently, and with
//! simulations of a mechanism that is exactly that equation.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Baumgarte, Error, Held, Method, PerStage, Simulation, mechanism};
use nalgebra::{Matrix2, Vector2};
use tests::random::Random;

mechanism! {
    /// A mass that its drive holds at 0: Φ = x, so violations obey the linear
    /// model without any other error.
    HeldMass {
        dof = 0;
        body mass (x) { mass = 1 [kg]; }
        drive hold: x = 0 [m];
        start { x = 1 [mm]; }
    }
}

/// One step of Heun's method on (e, ė), as the textbook has it.
fn step<X: Method>([e, v]: [f64; 2], alpha: f64, beta: f64, h: f64) -> [f64; 2] {
    let pull = |e: f64, v: f64| -2.0 * alpha * v - beta * beta * e;
    let here = pull(e, v);
    let predicted = [e + h * v, v + h * here];
    let there = if X::EXPLICIT.is_held() { here } else { pull(predicted[0], predicted[1]) };
    [e + h / 2.0 * (v + predicted[1]), v + h / 2.0 * (here + there)]
}

fn map<X: Method>(alpha: f64, beta: f64, h: f64) -> Matrix2<f64> {
    // columns in units of (1, 1/h), so that both are of order 1
    let columns = [[1.0, 0.0], [0.0, 1.0 / h]].map(|start| {
        let [e, v] = step::<X>(start, alpha, beta, h);
        Vector2::new(e, v * h)
    });
    Matrix2::from_columns(&columns)
}

fn spectral_radius(map: &Matrix2<f64>) -> f64 {
    map.complex_eigenvalues().iter().map(|z| z.re.hypot(z.im)).fold(0.0, f64::max)
}

fn check_random_gains<X: Method>() {
    let mut random = Random::new(8);
    let (mut stable, mut unstable) = (0, 0);
    for _ in 0..20_000 {
        let h = 10.0_f64.powf(random.between(-6.0, 0.0));
        let (alpha, beta) = (random.between(0.0, 1.5) / h, random.between(0.0, 2.5) / h);
        let radius = spectral_radius(&map::<X>(alpha, beta, h));
        // eigenvalues near a double one are good to √ε only
        if (radius - 1.0).abs() < 1e-7 {
            continue;
        }
        let claim = Baumgarte::<X>::new(alpha, beta).expect("valid gains").is_stable(h);
        assert_eq!(
            claim,
            radius < 1.0,
            "{}: αh = {}, βh = {}: {radius}",
            X::EXPLICIT.stabilization.word(),
            alpha * h,
            beta * h
        );
        if claim { stable += 1 } else { unstable += 1 }
    }
    println!("{}: {stable} stable, {unstable} unstable", X::EXPLICIT.stabilization.word());
    assert!(stable > 1000 && unstable > 1000, "{stable} {unstable}");
}

#[test]
fn stability_is_that_of_the_eigenvalues() {
    check_random_gains::<PerStage>();
    check_random_gains::<Held>();
}

#[test]
fn stability_is_known_at_compile_time() {
    const PAPER: Baumgarte<PerStage> = match Baumgarte::new(2000.0, 2000.0) {
        Ok(baumgarte) => baumgarte,
        Err(_) => Baumgarte::NONE,
    };
    const IS_STABLE: bool = PAPER.is_stable(0.5e-3);
    assert!(IS_STABLE && PAPER != Baumgarte::NONE);
}

/// The map of deadbeat gains is nilpotent: its square vanishes to rounding of
/// entries of order 1. (Per stage even the map itself is 0: 1 + z + z²/2 is
/// then half the characteristic polynomial.) Gains 1 % off leave 1e-4.
#[test]
fn deadbeat_gains_end_a_violation_in_two_steps() {
    fn check<X: Method>() {
        for h in [1e-6, 0.5e-3, 0.1, 1.0] {
            let best = Baumgarte::<X>::deadbeat(h);
            let map = map::<X>(best.alpha(), best.beta(), h);
            let square = map * map;
            assert!(
                square.amax() <= 16.0 * f64::EPSILON,
                "{} {h}: {square}",
                X::EXPLICIT.stabilization.word()
            );
            let other = self::map::<X>(1.01 * best.alpha(), best.beta(), h);
            assert!((other * other).amax() > 1e-5, "{} {h}: {other}", X::EXPLICIT.stabilization.word());
        }
    }
    check::<PerStage>();
    check::<Held>();
}

/// The violation after many steps from one of 1 mm.
fn after<X: Method>(alpha: f64, beta: f64, steps: u32) -> f64 {
    let baumgarte = Baumgarte::<X>::new(alpha, beta).expect("valid gains");
    let mut simulation = Simulation::builder(HeldMass::declared(), 0.5e-3)
        .baumgarte(baumgarte)
        .as_declared()
        .allow_unstable()
        .build()
        .expect("a start");
    for _ in 0..steps {
        simulation.step().expect("a finite motion");
    }
    simulation.violation()
}

/// β = 2000 and h = 0.5 ms: both stages end at α = 2500 exactly (both roots of
/// Heun's polynomial reach 1); held, αh lies between 1/4 and 1. A gain that is
/// off by 1/1000 changes the radius by about as much: e^±2 or more in 4000 steps.
#[test]
fn simulation_decays_within_the_limits_and_grows_beyond() {
    let (inside, outside) = (0.999, 1.001);
    assert!(after::<PerStage>(2500.0 * inside, 2000.0, 4000) < 0.2e-3);
    assert!(after::<PerStage>(2500.0 * outside, 2000.0, 4000) > 5e-3);
    assert!(after::<Held>(2000.0 * inside, 2000.0, 4000) < 0.2e-3);
    assert!(after::<Held>(2000.0 * outside, 2000.0, 4000) > 5e-3);
    assert!(after::<Held>(500.0 / inside, 2000.0, 4000) < 0.5e-3);
    assert!(after::<Held>(500.0 / outside, 2000.0, 4000) > 2e-3);
}

/// Deadbeat: of 1 mm nothing is left after two steps but rounding of h²β²Φ.
#[test]
fn simulation_with_deadbeat_gains_is_still_after_two_steps() {
    fn after_two<X: Method>() -> f64 {
        let best = Baumgarte::<X>::deadbeat(0.5e-3);
        after::<X>(best.alpha(), best.beta(), 2)
    }
    assert!(after_two::<PerStage>() <= 1e-3 * 16.0 * f64::EPSILON);
    assert!(after_two::<Held>() <= 1e-3 * 16.0 * f64::EPSILON);
}

#[test]
fn unstable_gains_are_refused_unless_asked_for() {
    let builder = Simulation::builder(HeldMass::declared(), 0.5e-3);
    let gains = Baumgarte::<PerStage>::new(2501.0, 2000.0).expect("valid gains");
    let error = builder.baumgarte(gains).build().expect_err("unstable");
    let expected = Error::UnstableGains { alpha: 2501.0, beta: 2000.0, step: 0.5e-3, feedback: "per-stage" };
    assert_eq!(error, expected);
    assert!(builder.baumgarte(gains).allow_unstable().build().is_ok());
}
