//! States of a declaration's own: closed forms, orders of all kinds of methods, stiff kinetics, events, lanes,
//! equilibria and linear systems.

use mbs_analysis::{OperatingPoint, Ports, Search, equilibrium, linearize};
use mbs_ensemble::Ensemble;
use mbs_runtime::equations::Differentiated;
use mbs_runtime::implicit::Esdirk4;
use mbs_runtime::{
    Adaptive, AdaptiveScheme, Dop853, Dopri5, Error, Held, Heun, Mechanism, Rk4, Scheme, Simulation,
    Tolerances, TrBdf2, mechanism,
};

mechanism! {
    /// A DC motor with inductance.
    Motor {
        dof = 1;
        param resistance = 1 [ohm];
        param inductance = 0.5 [mH];
        param constant = 0.05 [N*m/A];
        param inertia = 1e-4 [kg*m^2];
        input voltage [V];
        body rotor (angle = theta) { inertia = inertia; }
        state current [A] = 0;
        der(current) = (voltage - resistance*current - constant*der(theta))/inductance;
        torque drive on rotor = constant*current;
        event half: current = 6 [A] rising;
        output rise [A/s] = der(current);
    }
}

mechanism! {
    /// A block on a spring, the integral of its position, and what follows it with a delay.
    Follower {
        dof = 1;
        param stiffness = 4 [N/m];
        param delay = 0.5 [s];
        body block (x) { mass = 1 [kg]; }
        force spring on x = -stiffness*x;
        state integral [m*s];
        der(integral) = x;
        state late [m] = 0;
        der(late) = (x - late)/delay;
        start { x = 1 [m]; }
    }
}

mechanism! {
    /// Hares and foxes, without a body.
    Populations {
        dof = 0;
        state hares [1] = 10;
        state foxes [1] = 5;
        der(hares) = 1.1 [1/s]*hares - 0.4 [1/s]*hares*foxes;
        der(foxes) = 0.1 [1/s]*hares*foxes - 0.4 [1/s]*foxes;
    }
}

mechanism! {
    /// Robertson's reactions: rates from 0.04 to 3e7.
    Kinetics {
        dof = 0;
        state a [1] = 1;
        state b [1] = 0;
        state c [1] = 0;
        der(a) = -0.04 [1/s]*a + 1e4 [1/s]*b*c;
        der(b) = 0.04 [1/s]*a - 1e4 [1/s]*b*c - 3e7 [1/s]*b^2;
        der(c) = 3e7 [1/s]*b^2;
    }
}

const VOLTAGE: f64 = 12.0;

fn powered() -> MotorInputs {
    MotorInputs { voltage: VOLTAGE }
}

/// Current and speed of the motor from standstill, with λ² + R/L λ + k²/(LJ) = 0:
///
/// ω = (u/k) (1 + (λ₂ e^(λ₁t) − λ₁ e^(λ₂t))/(λ₁ − λ₂)),  i = J ω̇/k
fn exact(t: f64) -> [f64; 2] {
    let p: MotorParameters = MotorParameters::default();
    let (half, product) =
        (0.5 * p.resistance / p.inductance, p.constant * p.constant / (p.inductance * p.inertia));
    let root = (half * half - product).sqrt();
    // without the cancellation of the slow one
    let fast = -half - root;
    let slow = product / fast;
    let (a, b, apart) = ((slow * t).exp(), (fast * t).exp(), slow - fast);
    let speed = VOLTAGE / p.constant;
    let acceleration = speed * product * (a - b) / apart;
    [p.inertia * acceleration / p.constant, speed * (1.0 + (fast * a - slow * b) / apart)]
}

fn to_tolerance<M: Mechanism<Real = f64>, S: AdaptiveScheme>(
    mechanism: M,
    inputs: M::Inputs,
    rtol: f64,
) -> Result<Adaptive<M, S>, Error> {
    Adaptive::builder(mechanism).scheme::<S>().tolerances(Tolerances::relative(rtol)).inputs(inputs).build()
}

/// To a relative error of 1e-12, by a tolerance of as much.
#[test]
fn the_motor_starts_as_its_closed_form_says() -> Result<(), Error> {
    let mut run = to_tolerance::<_, Dopri5>(Motor::declared(), powered(), 1e-12)?;
    for t in [1e-3, 5e-3, 20e-3] {
        run.advance_to(t)?;
        let ([current, speed], v) = (exact(t), run.state().v);
        assert!((v.current / current - 1.0).abs() < 1e-12, "{t}: {} for {current}", v.current);
        assert!((v.theta / speed - 1.0).abs() < 1e-12, "{t}: {} for {speed}", v.theta);
    }
    Ok(())
}

/// The error of a step of 10 µs over that of half of it, with the stable fast rate of 2000/s.
fn order(run: impl Fn(f64) -> Result<[f64; 2], Error>) -> Result<f64, Error> {
    let of = |step: f64| -> Result<f64, Error> {
        let ([current, speed], [i, omega]) = (exact(5e-3), run(step)?);
        Ok((i - current).abs().max((omega - speed).abs()))
    };
    Ok((of(1e-4)? / of(0.5e-4)?).log2())
}

fn explicit<S: Scheme>(step: f64) -> Result<[f64; 2], Error> {
    let mut run =
        Simulation::builder(Motor::declared(), step).method::<Held<S>>().inputs(powered()).build()?;
    run.advance_to(5e-3)?;
    let v = run.state().v;
    Ok([v.current, v.theta])
}

#[test]
fn constant_steps_keep_their_orders() -> Result<(), Error> {
    for (found, expected) in [
        (order(explicit::<Heun>)?, 2.0),
        (order(explicit::<Rk4>)?, 4.0),
        (order(explicit::<Dopri5>)?, 5.0),
        (
            order(|step| {
                let mut run = TrBdf2::builder(Motor::declared(), step).inputs(powered()).build()?;
                run.advance_to(5e-3)?;
                let v = run.state().v;
                Ok([v.current, v.theta])
            })?,
            2.0,
        ),
    ] {
        assert!((found - expected).abs() < 0.35, "{found} for {expected}");
    }
    Ok(())
}

/// The rate of a state is known to implicit schemes with what couples it to the mechanism: their error is the
/// tolerance's.
#[test]
fn implicit_schemes_meet_their_tolerance() -> Result<(), Error> {
    let mut run = to_tolerance::<_, Esdirk4>(Motor::declared(), powered(), 1e-8)?;
    run.advance_to(20e-3)?;
    let ([current, speed], v) = (exact(20e-3), run.state().v);
    assert!((v.current - current).abs() < 1e-7 * 12.0 && (v.theta - speed).abs() < 1e-7 * 240.0, "{v:?}");
    assert!(run.effort().steps < 150, "{}", run.effort().steps);
    Ok(())
}

/// ∫ cos 2t dt = sin(2t)/2, and the delay's closed form, from a delay of a microsecond to one of 1000 s.
#[test]
fn integrals_and_delays_follow_an_oscillator() -> Result<(), Error> {
    for delay in [1e-6, 1e-3, 0.5, 1e3] {
        let mechanism = Follower::new(FollowerParameters { delay, ..FollowerParameters::default() })?;
        let mut run = to_tolerance::<_, Esdirk4>(mechanism, Default::default(), 1e-8)?;
        run.advance_to(1.0)?;
        let (omega, t, v) = (2.0_f64, 1.0_f64, run.state().v);
        let square = 1.0 + (omega * delay).powi(2);
        let late = ((omega * t).cos() + omega * delay * (omega * t).sin() - (-t / delay).exp()) / square;
        assert!((v.integral - 0.5 * (omega * t).sin()).abs() < 1e-6, "{delay}: {}", v.integral);
        assert!((v.late - late).abs() < 1e-6, "{delay}: {} for {late}", v.late);
    }
    Ok(())
}

/// The motion keeps 0.1 h − 0.4 ln h + 0.4 f − 1.1 ln f.
#[test]
fn populations_without_a_body_keep_their_invariant() -> Result<(), Error> {
    let mut run = to_tolerance::<_, Dop853>(Populations::declared(), Default::default(), 1e-12)?;
    let kept =
        |v: PopulationsCoordinates| 0.1 * v.hares - 0.4 * v.hares.ln() + 0.4 * v.foxes - 1.1 * v.foxes.ln();
    let before = kept(run.state().v);
    run.advance_to(50.0)?;
    assert!((kept(run.state().v) - before).abs() < 1e-10);
    Ok(())
}

/// Against explicit steps that are short enough, at a tolerance of 1e-12: a = 0.71582707, b = 9.1855348e-6.
#[test]
fn stiff_kinetics_end_where_short_explicit_steps_do() -> Result<(), Error> {
    let mut reference = to_tolerance::<_, Dop853>(Kinetics::declared(), Default::default(), 1e-12)?;
    reference.advance_to(10.0)?;
    let mut run = to_tolerance::<_, Esdirk4>(Kinetics::declared(), Default::default(), 1e-8)?;
    run.advance_to(10.0)?;
    let (found, expected) = (run.state().v, reference.state().v);
    for (found, expected) in [(found.a, expected.a), (found.b, expected.b), (found.c, expected.c)] {
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} for {expected}");
    }
    assert!(20 * run.effort().steps < reference.effort().steps, "{:?}", reference.effort());
    Ok(())
}

#[test]
fn events_see_states() -> Result<(), Error> {
    let mut run = to_tolerance::<_, Dop853>(Motor::declared(), powered(), 1e-12)?;
    let found = run.advance_to_event(20e-3)?.map(|event| event.t);
    let at = found.ok_or(Error::EndTime { end: 20e-3, now: 0.0 })?;
    assert!((exact(at)[0] - 6.0).abs() < 1e-9, "{at}");
    Ok(())
}

/// To the bit.
#[test]
fn lanes_run_as_alone() -> Result<(), Error> {
    let motor = |at: usize| {
        let resistance = 1.0 + 0.1 * at as f64;
        let parameters = MotorParameters { resistance, ..MotorParameters::default() };
        Simulation::builder(Motor::new(parameters)?, 1e-5).inputs(powered()).build()
    };
    let together = Ensemble::new(5e-3).run(11, motor, &()).unwrap_or_default();
    assert_eq!(together.len(), 11);
    for (at, together) in together.into_iter().enumerate() {
        let mut alone = motor(at)?;
        alone.advance_to(5e-3)?;
        assert_eq!(alone.state(), together?.state, "{at}");
    }
    Ok(())
}

/// A motor that a spring holds: at rest the voltage drives u/R, whose torque the spring balances.
#[test]
fn at_an_equilibrium_states_rest_too() -> Result<(), mbs_analysis::Error> {
    mechanism! {
        Held {
            dof = 1;
            input voltage [V];
            body rotor (angle = theta) { inertia = 1e-4 [kg*m^2]; }
            state current [A];
            der(current) = (voltage - 2 [ohm]*current - 0.05 [V*s]*der(theta))/0.5 [mH];
            torque drive on rotor = 0.05 [N*m/A]*current - 0.3 [N*m]*theta;
        }
    }
    let search = Search { inputs: Some(vec![12.0]), ..Search::default() };
    for differentiable in [false, true] {
        let rest = match differentiable {
            false => equilibrium(&Held::declared(), &search)?,
            true => equilibrium(&Differentiated(Held::declared()), &search)?,
        };
        assert!((rest.q[0] - 1.0).abs() < 1e-9 && (rest.q[1] - 6.0).abs() < 1e-9, "{rest:?}");
        let point = OperatingPoint::from(&rest);
        assert_eq!((point.q[1], point.v[1]), (0.0, rest.q[1]));
    }
    Ok(())
}

/// λ³ + R/L λ² + k²/(LJ) λ = 0 of the free motor: its modes, and H(iω) from voltage to speed.
#[test]
fn linear_systems_have_states_behind_velocities() -> Result<(), mbs_analysis::Error> {
    let point = OperatingPoint::at_rest(0.0, &[0.0, 0.0], &[0.0]);
    let ports = Ports { outputs: Some(vec!["der(theta)".into(), "current".into()]), ..Ports::default() };
    let linear = linearize(&Differentiated(Motor::declared()), &point, &ports)?;
    let names: Vec<&str> = linear.states.iter().map(|state| state.name.as_str()).collect();
    assert_eq!(names, ["theta", "der(theta)", "current"]);
    let expected = [[0.0, 1.0, 0.0], [0.0, 0.0, 500.0], [0.0, -100.0, -2000.0]];
    for (row, expected) in linear.a.row_iter().zip(expected) {
        assert!(row.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9 * 2000.0), "{row}");
    }
    let roots = [0.0, -1000.0 + 950_000_f64.sqrt(), -1000.0 - 950_000_f64.sqrt()];
    for (mode, root) in linear.modes()?.iter().zip(roots) {
        assert!((mode.eigenvalue.re - root).abs() < 1e-12 * 2000.0 && mode.eigenvalue.im == 0.0, "{mode:?}");
    }
    let omega = 30.0;
    let found = linear.frequency_response(omega)?[(0, 0)];
    // (k/(LJ))/((iω)² + R/L iω + k²/(LJ))
    let (re, im) = (5e4 - omega * omega, 2e3 * omega);
    let expected = [re, -im].map(|part| 1e6 * part / (re * re + im * im));
    assert!((found.re - expected[0]).abs() < 1e-9 && (found.im - expected[1]).abs() < 1e-9, "{found}");
    Ok(())
}

/// The library's motor with its PI controller: beside the 0 of its angle the roots of λ³ + R/L λ² + (k² + k p)/(LJ) λ +
/// k i/(LJ) = 0, by Newton's method from the eigenvalues, in complex numbers.
#[test]
fn a_loop_has_the_eigenvalues_of_its_polynomial() -> Result<(), mbs_analysis::Error> {
    use models::{DcMotor, DcMotorParameters};
    use nalgebra::Complex;
    let p: DcMotorParameters<f64> = DcMotorParameters::default();
    let rest = [0.0; 3];
    let point = OperatingPoint::at_rest(0.0, &rest, &[0.0]);
    let linear = linearize(&Differentiated(DcMotor::declared()), &point, &Ports::default())?;
    let scale = p.inductance * p.inertia;
    let [c2, c1, c0] = [
        p.resistance / p.inductance,
        p.constant * (p.constant + p.proportional) / scale,
        p.constant * p.integrating / scale,
    ];
    let mut found: Vec<Complex<f64>> =
        linear.modes()?.iter().map(|mode| Complex::new(mode.eigenvalue.re, mode.eigenvalue.im)).collect();
    found.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    assert!(found[0].norm() < 1e-9);
    for eigenvalue in &found[1..] {
        let mut root = *eigenvalue;
        for _ in 0..5 {
            let value = ((root + c2) * root + c1) * root + c0;
            let slope = (root * 3.0 + 2.0 * c2) * root + c1;
            root -= value / slope;
        }
        assert!((root - eigenvalue).norm() < 1e-12 * root.norm(), "{eigenvalue} for {root}");
    }
    Ok(())
}

/// Kinematics follows constraints, of which a state has none.
#[test]
fn kinematics_refuses_states() {
    mechanism! {
        Driven {
            dof = 0;
            body crank (angle = phi) { inertia = 0.5 [kg*m^2]; }
            drive motor: phi = 3 [rad/s^2]*t^2;
            state turned [rad*s];
            der(turned) = phi;
        }
    }
    let refused = mbs_runtime::Kinematics::new(Driven::declared()).map(|_| ());
    assert_eq!(refused, Err(Error::OwnState { state: "turned" }));
}
