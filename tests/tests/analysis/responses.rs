//! Frequency and step responses against closed forms and against runs of the mechanism itself.

use std::f64::consts::PI;

use mbs_analysis::nalgebra::Complex;
use mbs_analysis::{Error, Linearization, OperatingPoint, Ports, Search, equilibrium, linearize, phases};
use mbs_runtime::equations::Equations;
use mbs_runtime::{Adaptive, Tolerances, mechanism};

mechanism! {
    /// m ẍ + c ẋ + k x = push.
    pub Oscillator {
        dof = 1;
        param k = 200 [N/m];
        param c = 4 [N*s/m];
        input push [N];
        input unused [N];
        body block (x) { mass = 2 [kg]; }
        force all on x = push + 0*unused - k*x - c*der(x);
        output position [m] = x;
        output wall [N] = k*x + c*der(x);
        output acceleration [m/s^2] = der(der(x));
    }
}

mechanism! {
    /// A force on the first of two masses between springs.
    pub Absorber {
        dof = 2;
        input push [N];
        body a (x) { mass = 2 [kg]; }
        body b (x = y) { mass = 0.5 [kg]; }
        force fa on x = push - 300 [N/m]*x - 50 [N/m]*(x - y);
        force fb on y = -50 [N/m]*(y - x);
    }
}

mechanism! {
    /// A rod on a hinge with a torque and a damper.
    pub Pendulum {
        dof = 1;
        param l = 0.8 [m];
        input push [N*m];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, phi) { mass = 2 [kg]; inertia = 1/12*2 [kg]*l^2; }
        point hinge on rod = (0, l/2);
        revolute pivot (rod.hinge, ground);
        torque hand on rod = push - 0.5 [N*m*s]*der(phi);
        start { phi = 0; guess y = -0.4 [m]; }
        output height [mm] = y;
        output angle = phi;
    }
}

fn linear(mechanism: &dyn Equations<f64>, inputs: &[f64]) -> Result<Linearization, Error> {
    let search = Search { inputs: Some(inputs.to_vec()), ..Search::default() };
    let found = equilibrium(mechanism, &search)?;
    linearize(mechanism, &OperatingPoint::from(&found), &Ports::default())
}

/// H = 1/(k − mω² + icω), of the wall (k + icω) H, of the acceleration −ω² H.
#[test]
fn an_oscillator_answers_as_the_textbook_says() -> Result<(), Error> {
    let linear = linear(&Oscillator::declared(), &[0.0, 0.0])?;
    let frequencies: Vec<f64> = (0..60).map(|k| 10.0_f64.powf(-1.0 + 0.05 * f64::from(k))).collect();
    let mut positions = Vec::new();
    for &omega in &frequencies {
        let found = linear.frequency_response(omega)?;
        let h = 1.0 / Complex::new(200.0 - 2.0 * omega * omega, 4.0 * omega);
        let expected = [h, h * Complex::new(200.0, 4.0 * omega), -h * omega * omega];
        for (row, expected) in expected.into_iter().enumerate() {
            assert!((found[(row, 0)] - expected).norm() < 1e-10 * expected.norm(), "{found} {expected}");
            assert_eq!(found[(row, 1)].norm(), 0.0);
        }
        positions.push(found[(0, 0)]);
    }
    // from 0 to −π, without a jump
    let phases = phases(&frequencies, &positions, &[]);
    assert!(phases[0] < 0.0 && phases[0] > -0.01 && phases[59] > -PI && phases[59] < -3.1);
    assert!(phases.windows(2).all(|pair| pair[1] < pair[0]));
    Ok(())
}

/// x = (1 − e^{−δt}(cos νt + δ/ν sin νt))/k. Steps are exact whatever their length.
#[test]
fn an_oscillator_follows_a_step_as_the_textbook_says() -> Result<(), Error> {
    let linear = linear(&Oscillator::declared(), &[0.0, 0.0])?;
    let nu = 99.0_f64.sqrt();
    for steps in [3, 500] {
        let found = linear.step_response("push", 3.0, steps)?;
        assert_eq!(found.times.len(), steps + 1);
        for (row, t) in found.times.iter().enumerate() {
            let decay = (-t).exp();
            let x = (1.0 - decay * ((nu * t).cos() + (nu * t).sin() / nu)) / 200.0;
            let rate = decay * (nu + 1.0 / nu) * (nu * t).sin() / 200.0;
            assert!((found.outputs[(row, 0)] - x).abs() < 1e-13);
            assert!((found.outputs[(row, 1)] - (200.0 * x + 4.0 * rate)).abs() < 1e-11);
            // at once, through D
            assert!(row > 0 || (found.outputs[(row, 2)] - 0.5).abs() < 1e-12);
        }
    }
    Ok(())
}

/// Between two undamped resonances there is a frequency at which the first mass stands still, (k/m of the
/// absorber)½ = 10 rad/s: the phase falls by half a turn, comes back and falls again.
#[test]
fn phases_of_undamped_systems_fall_at_poles_and_rise_at_zeros() -> Result<(), Error> {
    let linear = linear(&Absorber::declared(), &[0.0])?;
    let resonances = linear.resonances()?;
    assert!(resonances[0] < 10.0 && resonances[1] > 10.0, "{resonances:?}");
    let frequencies = [1.0, 0.5 * (resonances[0] + 10.0), 0.5 * (resonances[1] + 10.0), 100.0];
    let responses: Result<Vec<_>, _> =
        frequencies.iter().map(|omega| linear.frequency_response(*omega).map(|h| h[(0, 0)])).collect();
    let found = phases(&frequencies, &responses?, &resonances);
    for (phase, expected) in found.iter().zip([0.0, -PI, 0.0, -PI]) {
        assert!((phase - expected).abs() < 1e-9, "{found:?}");
    }
    assert!(linear.frequency_response(10.0)?[(0, 0)].norm() < 1e-12);
    // of the second mass there is no zero: it falls twice
    let other: Result<Vec<_>, _> =
        frequencies.iter().map(|omega| linear.frequency_response(*omega).map(|h| h[(1, 0)])).collect();
    let found = phases(&frequencies, &other?, &resonances);
    assert!((found[3] + 2.0 * PI).abs() < 1e-9, "{found:?}");
    let at_resonance = linear.frequency_response(resonances[0])?[(0, 0)].norm();
    assert!(at_resonance > 1e9, "{at_resonance}");
    Ok(())
}

/// A pendulum held at an angle by a torque, and a torque a little larger: the linear response differs from
/// the motion by the square of the step, which is taken away by a step to the other side.
#[test]
fn a_small_step_moves_the_mechanism_as_the_linear_system() -> Result<(), Error> {
    let (torque, step, end, steps) = (3.0, 1e-4, 2.0, 20);
    let linear = linear(&Pendulum::declared(), &[torque])?;
    let response = linear.step_response("push", end, steps)?;
    let flown = |change: f64| -> Result<Vec<[f64; 2]>, Error> {
        let rest = mbs_runtime::start::assemble(
            &Pendulum::declared(),
            0.0,
            &PendulumCoordinates { x: linear.point.q[0], y: linear.point.q[1], phi: linear.point.q[2] },
        )?;
        let still = PendulumCoordinates { x: 0.0, y: 0.0, phi: 0.0 };
        let mut run = Adaptive::builder(Pendulum::declared())
            .from_state(mbs_runtime::State { t: 0.0, q: rest, v: still })
            .inputs(PendulumInputs { push: torque + change })
            .tolerances(Tolerances { rtol: 1e-12, atol: 1e-15, ..Tolerances::default() })
            .build()?;
        let mut places = vec![];
        for t in &response.times {
            if *t > 0.0 {
                run.advance_to(*t)?;
            }
            places.push([run.state().q.y, run.state().q.phi]);
        }
        Ok(places)
    };
    let (ahead, behind) = (flown(step)?, flown(-step)?);
    for (row, (a, b)) in ahead.iter().zip(&behind).enumerate() {
        for output in 0..2 {
            let expected = (a[output] - b[output]) / (2.0 * step);
            let found = response.outputs[(row, output)];
            // the third order of the step, and 1e-12 of the runs over it
            assert!((found - expected).abs() < 3e-8, "{row} {output}: {found} {expected}");
        }
    }
    Ok(())
}

#[test]
fn frequencies_and_times_are_above_zero() -> Result<(), Error> {
    let linear = linear(&Oscillator::declared(), &[0.0, 0.0])?;
    for omega in [0.0, -3.0, f64::NAN, f64::INFINITY] {
        let error = linear.frequency_response(omega).expect_err("there is none").to_string();
        assert!(error.contains("frequency = ") && error.contains("above 0"), "{error}");
    }
    assert!(matches!(linear.step_response("push", -1.0, 10), Err(Error::Range { .. })));
    assert!(matches!(linear.step_response("push", 1.0, 0), Err(Error::Range { .. })));
    let error = linear.step_response("pull", 1.0, 10).expect_err("there is none").to_string();
    assert!(error.contains("unknown input `pull`") && error.contains("`push`, `unused`"), "{error}");
    Ok(())
}
