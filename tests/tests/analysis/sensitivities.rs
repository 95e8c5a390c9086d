//! How frequencies and damping ratios follow parameters, against closed forms; of types and texts.

use mbs_analysis::{Behaviour, Error, Ports, Search, of_type, sensitivities};
use mbs_live::Text;
use mbs_runtime::equations::Differentiated;
use mbs_runtime::{Mechanism, mechanism};

mechanism! {
    /// m ẍ + c ẋ + k x = 0.
    pub Oscillator {
        dof = 1;
        param m = 2 [kg] where m > 0;
        param k = 200 [N/m];
        param c = 4 [N*s/m] where c >= 0;
        body block (x) { mass = m; }
        force all on x = -k*x - c*der(x);
    }
}

mechanism! {
    /// A rod on a hinge, held by a coil.
    pub Flap {
        dof = 1;
        param k = 3 [N*m];
        param l = 0.2 [m];
        param m = 2 [kg];
        gravity = (0, -9.81) [m/s^2];
        body bar (x, y, phi) { mass = m; inertia = m*l^2/12; }
        point hinge on bar = (-l/2, 0);
        revolute pivot (bar.hinge, ground);
        torque coil on bar = -k*phi;
        start { phi = -0.3; guess x = 0.1 [m]; }
    }
}

mechanism! {
    /// A point on two springs, as stiff as each other.
    pub Cross {
        dof = 2;
        param kx = 50 [N/m];
        param coupling = 0 [N/m];
        body point (x, y) { mass = 2 [kg]; }
        force fx on x = -kx*x - coupling*y;
        force fy on y = -50 [N/m]*y - coupling*x;
    }
}

mechanism! {
    /// A cart that nothing holds.
    pub Free {
        dof = 1;
        param m = 2 [kg];
        body cart (x) { mass = m; }
    }
}

fn names<const N: usize>(names: [&str; N]) -> Vec<String> {
    names.map(str::to_owned).to_vec()
}

fn declared<M: Mechanism>() -> Vec<f64> {
    M::INFO.parameters.iter().map(|p| p.default).collect()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * (1.0 + expected.abs()), "{found} and not {expected}");
}

/// ω = √(k/m), ζ = c/(2√(km)).
#[test]
fn of_an_oscillator() -> Result<(), Error> {
    let all = names(["m", "k", "c"]);
    let (family, ports) = (of_type::<Oscillator>(), Ports::default());
    let found = sensitivities(&family, &declared::<Oscillator>(), &Search::default(), &ports, &all)?;
    let (omega, zeta) = (10.0, 0.1);
    for (at, [slope, ratio]) in [
        [-omega / (2.0 * 2.0), -zeta / (2.0 * 2.0)],
        [omega / (2.0 * 200.0), -zeta / (2.0 * 200.0)],
        [0.0, zeta / 4.0],
    ]
    .into_iter()
    .enumerate()
    {
        near(found.natural_frequency(0, at), slope, 1e-9);
        near(found.damping_ratio(0, at), ratio, 1e-9);
    }
    // damping below 0 is refused, so that at 0 the other side is taken
    let undamped = [2.0, 200.0, 0.0];
    let found = sensitivities(&family, &undamped, &Search::default(), &ports, &names(["c"]))?;
    near(found.damping_ratio(0, 0), 1.0 / 40.0, 1e-9);
    // at critical damping the frequency has no slope, beyond it every decay has
    let critical = sensitivities(&family, &[2.0, 200.0, 40.0], &Search::default(), &ports, &names(["c"]))?;
    assert!(critical.natural_frequency(0, 0).is_nan());
    let over = sensitivities(&family, &[2.0, 200.0, 50.0], &Search::default(), &ports, &names(["c"]))?;
    // λ² + c/m λ + k/m = 0: dλ/dc = −λ/(m (2λ + c/m))
    for (mode, lambda) in [-5.0, -20.0].into_iter().enumerate() {
        near(over.eigenvalues[(mode, 0)].re, -lambda / (2.0 * (2.0 * lambda + 25.0)), 1e-9);
    }
    Ok(())
}

/// κ = (k − m g (l/2) sin φ)/(m l²/3), where k φ + m g (l/2) cos φ = 0 moves φ with every parameter.
#[test]
fn the_equilibrium_moves_with_the_parameters() -> Result<(), Error> {
    let family = of_type::<Flap>();
    let all = names(["k", "l", "m"]);
    let found = sensitivities(&family, &declared::<Flap>(), &Search::default(), &Ports::default(), &all)?;
    let (g, k, l, m) = (9.81, 3.0, 0.2, 2.0);
    let phi = found.equilibrium.q[2];
    let (sin, cos) = phi.sin_cos();
    let (inertia, weight) = (m * l * l / 3.0, m * g * l / 2.0);
    let held = k - weight * sin;
    // of k, l and m: dφ, and dκ with φ held
    let slopes = [
        (-phi / held, 1.0 / inertia),
        (-weight / l * cos / held, -weight / l * sin / inertia - 2.0 / l * held / inertia),
        (-weight / m * cos / held, -weight / m * sin / inertia - held / inertia / m),
    ];
    let omega = (held / inertia).sqrt();
    near(found.modes[0].natural_frequency(), omega, 1e-10);
    for (at, (turned, direct)) in slopes.into_iter().enumerate() {
        let change = direct - weight * cos / inertia * turned;
        near(found.natural_frequency(0, at), change / (2.0 * omega), 1e-8);
    }
    Ok(())
}

/// A coupling parts two equal frequencies, ω² = (k ∓ c)/m; a stiffness in one direction moves one of them.
#[test]
fn equal_frequencies_part() -> Result<(), Error> {
    let family = of_type::<Cross>();
    let all = names(["coupling", "kx"]);
    let found = sensitivities(&family, &declared::<Cross>(), &Search::default(), &Ports::default(), &all)?;
    let omega = 5.0;
    for (at, mut expected) in [[-1.0, 1.0], [0.0, 1.0]].into_iter().enumerate() {
        let mut slopes = [0, 1].map(|mode| found.natural_frequency(mode, at) * 2.0 * omega * 2.0);
        slopes.sort_by(f64::total_cmp);
        expected.sort_by(f64::total_cmp);
        slopes.iter().zip(expected).for_each(|(slope, expected)| near(*slope, expected, 1e-8));
    }
    Ok(())
}

/// To the last bit, with the same equations over duals.
#[test]
fn a_text_has_the_sensitivities_of_its_type() -> Result<(), Error> {
    let live =
        Text::rust(file!(), include_str!("sensitivities.rs")).named("Flap").compile().expect("it compiles");
    let of_a_text = |p: &[f64]| live.with_parameters(|parameters| parameters.copy_from_slice(p));
    let of_a_type = |p: &[f64]| of_type::<Flap>()(p).map(Differentiated);
    let (parameters, search, ports) = (declared::<Flap>(), Search::default(), Ports::default());
    let typed = sensitivities(&of_a_type, &parameters, &search, &ports, &names(["l"]))?;
    assert_eq!(typed, sensitivities(&of_a_text, &parameters, &search, &ports, &names(["l"]))?);
    Ok(())
}

#[test]
fn what_has_no_sensitivity_says_so() -> Result<(), Error> {
    let family = of_type::<Free>();
    let (search, ports) = (Search::default(), Ports::default());
    let found = sensitivities(&family, &[2.0], &search, &ports, &names(["m"]))?;
    assert_eq!(found.modes[0].behaviour, Behaviour::RigidBody);
    assert!(found.natural_frequency(0, 0).is_nan());
    let error = sensitivities(&family, &[2.0], &search, &ports, &names(["mass"])).expect_err("unknown");
    assert!(error.to_string().contains("unknown parameter `mass`"), "{error}");
    let error = sensitivities(&of_type::<Oscillator>(), &[-2.0, 1.0, 1.0], &search, &ports, &names(["m"]));
    assert!(matches!(error, Err(Error::Mechanism(_))), "{error:?}");
    Ok(())
}
