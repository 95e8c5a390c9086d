//! A, B, C and D against closed forms; types and texts alike; which coordinates are states; and what cannot
//! be linearized.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_analysis::nalgebra::DMatrix;
use mbs_analysis::{Error, OperatingPoint, Ports, Search, equilibrium, linearize, of_type};
use mbs_live::Text;
use mbs_runtime::equations::Differentiated;
use mbs_runtime::{Simulation, System, mechanism};

mechanism! {
    /// m ẍ + c ẋ + k x = push + k s.
    pub Oscillator {
        dof = 1;
        param m = 2 [kg];
        param k = 200 [N/m];
        param c = 4 [N*s/m];
        param s = 1 [cm];
        input push [N];
        body block (x) { mass = m; }
        force all on x = push - k*(x - s) - c*der(x);
        output wall [N] = k*(x - s) + c*der(x);
        output acceleration [m/s^2] = der(der(x));
    }
}

mechanism! {
    /// A cart on a spring, and a uniform rod on it.
    pub CartRod {
        dof = 2;
        param m = 3 [kg];
        param l = 0.5 [m];
        input push [N];
        gravity = (0, -9.81) [m/s^2];
        body cart (x) { mass = m; }
        body rod (xr, yr, phi) { mass = 1 [kg]; inertia = 1/12*1 [kg]*l^2; }
        point hinge on rod = (0, l/2);
        revolute pin (cart, rod.hinge);
        force spring on x = push - 40 [N/m]*x - 0.3 [N*s/m]*der(x);
        start { phi = 0; guess yr = -0.25 [m]; }
    }
}

mechanism! {
    /// Its motion is prescribed.
    pub Driven {
        dof = 0;
        body wheel (angle = phi) { inertia = 1 [kg*m^2]; }
        drive motor: phi = 3 [rad/s]*t;
    }
}

mechanism! {
    /// A force with an infinite slope at x = 0, and an output with one at x = 1 m.
    pub Bead {
        dof = 1;
        input push [N];
        body bead (x) { mass = 1 [kg]; }
        force drag on x = push - 3 [N]*sqrt(x/1 [m]);
        output left = sqrt(1 - x/1 [m]);
    }
}

mechanism! {
    /// A bumper that is touched, and not yet pressed.
    pub Bumper {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        force wall on x = -50 [N/m]*(x + abs(x));
    }
}

fn near(found: &DMatrix<f64>, expected: &[&[f64]], tolerance: f64) {
    assert_eq!(found.nrows(), expected.len());
    for (row, numbers) in expected.iter().enumerate() {
        assert_eq!(found.ncols(), numbers.len());
        for (column, number) in numbers.iter().enumerate() {
            let difference = (found[(row, column)] - number).abs();
            assert!(difference <= tolerance * (1.0 + number.abs()), "{row} {column}: {found} {number}");
        }
    }
}

fn names(list: &[mbs_analysis::Signal]) -> Vec<&str> {
    list.iter().map(|signal| signal.name.as_str()).collect()
}

/// Outputs that feed the input through, and a parameter as an input: x̄ moves by s.
#[test]
fn an_oscillator_has_the_matrices_of_the_textbook() -> Result<(), Error> {
    let family = of_type::<Oscillator>();
    let ports = Ports { parameters: vec!["s".into(), "k".into()], family: Some(&family), ..Ports::default() };
    let point = OperatingPoint::at_rest(0.0, &[0.03], &[4.0]);
    let linear = linearize(&Oscillator::declared(), &point, &ports)?;
    assert_eq!(names(&linear.states), ["x", "der(x)"]);
    assert_eq!(names(&linear.inputs), ["push", "s", "k"]);
    assert_eq!(names(&linear.outputs), ["wall", "acceleration"]);
    near(&linear.a, &[&[0.0, 1.0], &[-100.0, -2.0]], 1e-10);
    // ∂ẍ/∂k = −(x − s)/m, with x held
    near(&linear.b, &[&[0.0, 0.0, 0.0], &[0.5, 100.0, -0.01]], 1e-10);
    near(&linear.c, &[&[200.0, 4.0], &[-100.0, -2.0]], 1e-10);
    near(&linear.d, &[&[0.0, -200.0, 0.02], &[0.5, 100.0, -0.01]], 1e-10);
    // at k (x − s) = push nothing accelerates
    assert!(linear.rate.amax() < 1e-12 && (linear.values[0] - 4.0).abs() < 1e-12);
    assert!(linear.uncertainty < 1e-11, "{}", linear.uncertainty);
    Ok(())
}

/// (m + M) ẍ + m a φ̈ = push − k x − c ẋ and m a ẍ + (J + m a²) φ̈ = −m g a φ, with a = l/2.
#[test]
fn a_cart_and_a_rod_are_coupled() -> Result<(), Error> {
    let found = equilibrium(&CartRod::declared(), &Search::default())?;
    let linear = linearize(&CartRod::declared(), &OperatingPoint::from(&found), &Ports::default())?;
    // the angle of the rod comes before its places, which move as far
    assert_eq!(names(&linear.states), ["x", "phi", "der(x)", "der(phi)"]);
    let (l, a, g, m) = (0.5, 0.25, 9.81, 3.0);
    let mass = DMatrix::from_row_slice(2, 2, &[m + 1.0, a, a, l * l / 3.0]);
    let forces = DMatrix::from_row_slice(2, 5, &[-40.0, 0.0, -0.3, 0.0, 1.0, 0.0, -g * a, 0.0, 0.0, 0.0]);
    let accelerations = mass.clone().lu().solve(&forces).expect("regular");
    let lower = linear.a.rows(2, 2).clone_owned();
    near(
        &lower,
        &[0, 1]
            .map(|row| accelerations.row(row).columns(0, 4).iter().copied().collect::<Vec<_>>())
            .each_ref()
            .map(Vec::as_slice),
        1e-9,
    );
    near(&linear.b.rows(2, 2).clone_owned(), &[&[accelerations[(0, 4)]], &[accelerations[(1, 4)]]], 1e-9);
    near(&linear.mass, &[&[m + 1.0, a], &[a, l * l / 3.0]], 1e-12);
    // outputs are coordinates where none are declared: the rod's centre hangs a below, moved by x + a φ
    let at = linear.outputs.iter().position(|y| y.name == "xr").expect("a coordinate");
    near(&linear.c.rows(at, 1).clone_owned(), &[&[1.0, a, 0.0, 0.0]], 1e-9);
    Ok(())
}

/// The same numbers, to the last bit, of the type and of its text.
#[test]
fn a_text_is_linearized_as_its_type() -> Result<(), Error> {
    let live = Text::rust(file!(), include_str!("linearization.rs"))
        .named("CartRod")
        .compile()
        .expect("it compiles");
    let point = OperatingPoint::in_motion(
        0.0,
        &[0.1, 0.1 + 0.25 * 0.4_f64.sin(), -0.25 * 0.4_f64.cos(), 0.4],
        &[0.2, 0.2 + 0.25 * 3.0 * 0.4_f64.cos(), 0.25 * 3.0 * 0.4_f64.sin(), 3.0],
        &[1.5],
    );
    let of_a_text = |p: &[f64]| live.with_parameters(|parameters| parameters.copy_from_slice(p));
    let of_a_type = of_type::<CartRod>();
    let ports = Ports { parameters: vec!["l".into(), "m".into()], ..Ports::default() };
    let typed = Ports { family: Some(&of_a_type), ..ports.clone() };
    let live_ports = Ports { family: Some(&of_a_text), ..ports };
    let exact = linearize(&Differentiated(CartRod::declared()), &point, &typed)?;
    assert_eq!(exact, linearize(&live, &point, &live_ports)?);
    // a type without equations over duals is differenced, as exactly as it says
    let differenced = linearize(&CartRod::declared(), &point, &typed)?;
    assert!(exact.uncertainty < 1e-13 && differenced.uncertainty < 1e-11);
    let allowed = 10.0 * differenced.uncertainty;
    for (exact, differenced) in [(&exact.a, &differenced.a), (&exact.b, &differenced.b)] {
        assert!((exact - differenced).amax() <= allowed * exact.amax());
    }
    Ok(())
}

/// The states can be chosen; what does not determine the position is refused.
#[test]
fn states_are_chosen_among_coordinates_that_move() -> Result<(), Error> {
    let found = equilibrium(&CartRod::declared(), &Search::default())?;
    let point = OperatingPoint::from(&found);
    let with = |names: &[&str]| {
        let states = Some(names.iter().map(|name| (*name).to_owned()).collect());
        linearize(&CartRod::declared(), &point, &Ports { states, ..Ports::default() })
    };
    // x_r = x + a φ at rest, so that eigenvalues stay what they are
    let linear = with(&["x", "xr"])?;
    assert_eq!(names(&linear.states), ["x", "xr", "der(x)", "der(xr)"]);
    let other = linearize(&CartRod::declared(), &point, &Ports::default())?;
    for (a, b) in linear.modes()?.iter().zip(other.modes()?) {
        assert!((a.eigenvalue - b.eigenvalue).norm() < 1e-9);
    }
    // where the rod hangs, its height does not move
    for choice in [&["x", "yr"][..], &["x"], &["x", "xr", "phi"]] {
        let error = with(choice).expect_err("they do not determine it");
        assert!(matches!(error, Error::Dependent { dof: 2, .. }), "{error}");
        assert!(
            error.to_string().contains(&format!("`{}` cannot be the states", choice.join("`, `"))),
            "{error}"
        );
    }
    Ok(())
}

#[test]
fn what_cannot_be_linearized_says_why() {
    let point = OperatingPoint::at_rest(0.0, &[0.0], &[0.0]);
    let refused = |point: &OperatingPoint, ports: &Ports<'_>, parts: &[&str]| {
        let error = linearize(&Oscillator::declared(), point, ports).expect_err("it is refused").to_string();
        parts.iter().for_each(|part| assert!(error.contains(part), "{error}"));
    };
    let named = || Some(vec!["pull".to_owned()]);
    refused(&point, &Ports { inputs: named(), ..Ports::default() }, &["unknown input `pull`", "`push`"]);
    refused(&point, &Ports { outputs: named(), ..Ports::default() }, &["unknown output `pull`", "`der(x)`"]);
    refused(&point, &Ports { states: named(), ..Ports::default() }, &["unknown coordinate `pull`"]);
    let parameters = |name: &str| Ports { parameters: vec![name.to_owned()], ..Ports::default() };
    refused(&point, &parameters("pull"), &["unknown parameter `pull`", "`k`"]);
    refused(&point, &parameters("k"), &["`k` can be an input", "of_type"]);
    let short = OperatingPoint { v: Vec::new(), ..point.clone() };
    refused(&short, &Ports::default(), &["velocities are 0 numbers", "1"]);

    let wheel = OperatingPoint::at_rest(0.0, &[0.0], &[]);
    let error = linearize(&Driven::declared(), &wheel, &Ports::default()).expect_err("driven");
    assert!(matches!(error, Error::NoFreedom { mechanism: "Driven" }), "{error}");

    let far = OperatingPoint::at_rest(0.0, &[0.0, 0.1, -0.25, 0.0], &[0.0]);
    let error =
        linearize(&CartRod::declared(), &far, &Ports::default()).expect_err("it is apart").to_string();
    assert!(error.contains("`pin_x` is violated by 1.000e-1"), "{error}");
    let skew = OperatingPoint::in_motion(0.0, &[0.0, 0.0, -0.25, 0.0], &[1.0, 0.0, 0.0, 0.0], &[0.0]);
    let error = linearize(&CartRod::declared(), &skew, &Ports::default()).expect_err("it parts").to_string();
    assert!(error.contains("the rate of `pin_x`"), "{error}");
}

/// An infinite slope was a panic of the modes.
#[test]
fn what_has_no_derivative_is_named() {
    let bead = Differentiated(Bead::declared());
    let at = |x: f64| OperatingPoint::at_rest(0.0, &[x], &[0.0]);
    let refused = |point, ports| linearize(&bead, &point, &ports).expect_err("it is refused").to_string();
    let error = refused(at(0.0), Ports::default());
    assert!(error.starts_with("the acceleration of `x` has no derivative at this position"), "{error}");
    let error = refused(at(1.0), Ports { outputs: Some(vec!["left".into()]), ..Ports::default() });
    assert!(error.starts_with("the output `left` has no derivative at this position"), "{error}");
    // one that nobody asked for is left out
    let linear = linearize(&bead, &at(1.0), &Ports::default()).expect("a linear system");
    let names = |signals: &[mbs_analysis::Signal]| signals.iter().map(|y| y.name.clone()).collect::<Vec<_>>();
    assert!(names(&linear.left_out).contains(&"left".to_owned()), "{:?}", linear.left_out);
    assert!(!names(&linear.outputs).contains(&"left".to_owned()), "{:?}", linear.outputs);
    assert_eq!(linear.c.nrows(), linear.outputs.len());
    assert!(linear.modes().is_ok());
    let error = refused(at(-1.0), Ports::default());
    assert!(error.starts_with("the acceleration of `x` is no number at this position"), "{error}");
    assert!(linearize(&bead, &at(0.5), &Ports::default()).is_ok());
}

/// Where a mechanism rests at the origin but for rounding, that is not its size.
#[test]
fn the_origin_is_a_position_as_others() -> Result<(), Error> {
    for x in [0.0, 1e-17, -1e-12] {
        let point = OperatingPoint::at_rest(0.0, &[x], &[0.0]);
        let linear = linearize(&Oscillator::declared(), &point, &Ports::default())?;
        near(&linear.a, &[&[0.0, 1.0], &[-100.0, -2.0]], 1e-10);
    }
    Ok(())
}

/// At a corner there is no derivative, and the result says so.
#[test]
fn a_corner_shows_in_the_uncertainty() -> Result<(), Error> {
    let at =
        |x: f64| linearize(&Bumper::declared(), &OperatingPoint::at_rest(0.0, &[x], &[]), &Ports::default());
    assert!(at(0.0)?.uncertainty > 0.1);
    assert!(at(0.05)?.uncertainty < 1e-11 && at(-0.05)?.uncertainty < 1e-11);
    assert!((at(0.05)?.a[(1, 0)] + 100.0).abs() < 1e-9);
    Ok(())
}

/// The state of a run, which feedback keeps near the constraints, is good enough.
#[test]
fn a_run_is_linearized_where_it_is() -> Result<(), Error> {
    let mut run = Simulation::new(CartRod::declared(), 1e-3)?;
    run.advance_to(0.2)?;
    let linear = linearize(run.mechanism(), &OperatingPoint::of_run(&run as &dyn System), &Ports::default())?;
    assert!((linear.point.t - 0.2).abs() < 1e-12 && linear.rate.len() == 4);
    Ok(())
}
