//! Gradients of sums over runs are those of closed forms: by parameters, by the start, by inputs
//! over some of the steps; however many variables a run differentiates by at once.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::{Dual, Error, Held, Rk4, Simulation, mechanism};

mechanism! {
    /// m ẍ + c ẋ + k x = F
    Oscillator {
        dof = 1;
        param mass = 2 [kg];
        param damping = 3 [N*s/m];
        param stiffness = 80 [N/m];
        input push [N];
        body block (x) { mass = mass; }
        force spring on x = -stiffness*x;
        force damper on x = -damping*der(x);
        force pushed on x = push;
        start { x = 0.1 [m]; der(x) = 0.5 [m/s]; }
    }
}

mechanism! {
    /// A weight on a massless rod whose length decides where it starts.
    Swing {
        dof = 1;
        param length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        start { x = 0.6 [m]; guess y = -0.8 [m]; }
    }
}

type OscillatorRun<const N: usize> = Simulation<Oscillator<Dual<f64, N>>, Held<Rk4>>;

/// x(t) of the free motion from x₀ and v₀, in any scalar.
fn free_motion<const N: usize>([m, c, k, x, v]: [Dual<f64, N>; 5], t: f64) -> Dual<f64, N> {
    use mbs_runtime::Real;
    let number = |x: f64| Dual::<f64, N>::constant(x);
    let decay = c / (number(2.0) * m);
    let omega = (k / m - decay * decay).sqrt();
    let (s, cosine) = (omega * number(t)).sin_cos();
    (-decay * number(t)).exp() * (x * cosine + (v + decay * x) / omega * s)
}

const VARIABLES: [Variable; 5] = [
    Variable::Parameter("mass"),
    Variable::Parameter("damping"),
    Variable::Parameter("stiffness"),
    Variable::Position("x"),
    Variable::Velocity("x"),
];

const H: f64 = 1e-3;

/// The sum of x over the run; RK4 is off by some (ωh)⁴ ωt/120 of it, 10⁻¹¹.
fn sum_of_positions<const N: usize>(variables: &[Variable]) -> (f64, Vec<f64>) {
    let mut gradient = vec![f64::NAN; variables.len()];
    let builder = Simulation::builder(Oscillator::declared(), H).method::<Held<Rk4>>();
    let sum = Sum::new(500, variables);
    let value = builder.gradient(&sum, |run: &OscillatorRun<N>| Ok(run.state().q.x), &mut gradient);
    (value.unwrap(), gradient)
}

#[test]
fn an_oscillator_has_the_sensitivities_of_its_solution() {
    let numbers = [2.0, 3.0, 80.0, 0.1, 0.5];
    let seeded = std::array::from_fn(|at| Dual::<f64, 5>::variable(numbers[at], at));
    let expected = (0..=500).fold(Dual::default(), |sum, k| sum + free_motion(seeded, f64::from(k) * H));
    let (value, gradient) = sum_of_positions::<5>(&VARIABLES);
    assert!((value - expected.value).abs() < 1e-9 * expected.value.abs());
    for (found, expected) in gradient.iter().zip(expected.partials) {
        assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{found} {expected}");
    }
}

/// The number of derivatives per run changes their cost alone.
#[test]
fn chunks_do_not_matter() {
    let all = sum_of_positions::<8>(&VARIABLES);
    assert_eq!(sum_of_positions::<1>(&VARIABLES), all);
    assert_eq!(sum_of_positions::<2>(&VARIABLES), all);
    let value = sum_of_positions::<4>(&[]);
    assert_eq!(value, (all.0, vec![]));
}

/// A constant force over some of the steps: the response of a linear oscillator to it is that of a
/// step up and of a step down, f(t) = (1 − free(t))/k with free(0) = 1 and no velocity.
#[test]
fn inputs_act_over_their_steps() {
    let variables = [Variable::Input { name: "push", from: 100, until: 200 }, Variable::input("push")];
    let mut gradient = [f64::NAN; 2];
    let builder = Simulation::builder(Oscillator::declared(), H).method::<Held<Rk4>>();
    let last =
        |run: &OscillatorRun<2>| Ok(if run.steps() == 300 { run.state().q.x } else { Dual::default() });
    let signal = |step: u64, _: usize| if step < 50 { 1.0 } else { 0.5 };
    builder.gradient(&Sum::new(300, &variables).driven_by(&signal), last, &mut gradient).unwrap();
    let response = |t: f64| {
        let numbers = [2.0, 3.0, 80.0, 1.0, 0.0].map(Dual::<f64, 1>::constant);
        (1.0 - free_motion(numbers, t).value) / 80.0
    };
    for (found, expected) in gradient.into_iter().zip([response(0.2) - response(0.1), response(0.3)]) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

/// Where the start is assembled, the positions that are solved for have their derivatives:
/// y₀ = −√(l² − x₀²).
#[test]
fn starts_are_differentiated_through_their_assembly() {
    let variables = [Variable::Parameter("length"), Variable::Position("x"), Variable::Position("y")];
    let mut gradient = [f64::NAN; 3];
    let builder = Simulation::builder(Swing::declared(), H);
    let y = |run: &Simulation<Swing<Dual<f64, 4>>>| Ok(run.state().q.y);
    let value = builder.gradient(&Sum::new(0, &variables), y, &mut gradient).unwrap();
    assert!((value + 0.8).abs() < 1e-15);
    // y is a guess, which the start does not keep
    for (found, expected) in gradient.into_iter().zip([-1.0 / 0.8, 0.6 / 0.8, 0.0]) {
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
}

#[test]
fn mistakes_have_names() {
    let builder = Simulation::builder(Oscillator::declared(), H);
    let term = |run: &Simulation<Oscillator<Dual<f64, 1>>>| Ok(run.state().q.x);
    let of = |variable, gradient: &mut [f64]| builder.gradient(&Sum::new(1, &[variable]), term, gradient);
    let refused = of(Variable::Parameter("stifness"), &mut [0.0]);
    assert_eq!(refused, Err(Error::NoVariable { what: "parameter", name: "stifness" }));
    assert_eq!(of(Variable::input("x"), &mut [0.0]), Err(Error::NoVariable { what: "input", name: "x" }));
    let error = of(Variable::Position("x"), &mut [0.0; 2]).unwrap_err();
    assert_eq!(error, Error::Length { what: "the gradient", found: 2, expected: 1 });
    assert!(error.to_string().contains("room for 2 numbers"), "{error}");
    // the root of what vanishes has no derivative
    let kink = |run: &Simulation<Oscillator<Dual<f64, 1>>>| {
        use mbs_runtime::Real;
        let way = run.state().q.x - Dual::constant(run.state().q.x.value);
        Ok(way.sqrt())
    };
    let variables = [Variable::Position("x")];
    let error = builder.gradient(&Sum::new(0, &variables), kink, &mut [0.0]).unwrap_err();
    assert!(error.to_string().contains("the derivative of the sum by `x`"), "{error}");
    let mut parameters = *Oscillator::declared().parameters();
    // its force is beyond all numbers behind the first step
    parameters.stiffness = f64::MAX;
    let divergent = Simulation::builder(Oscillator::new(parameters).unwrap(), H);
    assert!(divergent.gradient(&Sum::new(2, &variables), term, &mut [0.0]).is_err());
}
