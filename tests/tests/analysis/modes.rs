//! Frequencies, damping ratios and shapes against closed forms and against an eigenproblem of
//! accelerations that are differenced here; rigid bodies, equal frequencies, overdamped and unstable
//! modes.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_analysis::nalgebra::{Complex, DMatrix};
use mbs_analysis::{
    Behaviour, Error, Linearization, Mode, OperatingPoint, Ports, Search, equilibrium, linearize,
};
use mbs_live::Text;
use mbs_runtime::equations::{At, Equations, Room, project};
use mbs_runtime::mechanism;

mechanism! {
    /// A rod on a hinge.
    pub Pendulum {
        dof = 1;
        param l = 0.8 [m];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, phi) { mass = 2 [kg]; inertia = 1/12*2 [kg]*l^2; }
        point hinge on rod = (-l/2, 0);
        revolute pivot (rod.hinge, ground);
        start { phi = -1; guess x = 0.2 [m]; guess y = -0.3 [m]; }
    }
}

mechanism! {
    /// Two equal rods.
    pub Double {
        dof = 2;
        param l = 0.5 [m];
        gravity = (0, -9.81) [m/s^2];
        body upper (x1, y1, a1) { mass = 1 [kg]; inertia = 1/12*1 [kg]*l^2; }
        body lower (x2, y2, a2) { mass = 1 [kg]; inertia = 1/12*1 [kg]*l^2; }
        point base on upper = (0, l/2);
        point end on upper = (0, -l/2);
        point base on lower = (0, l/2);
        revolute hinge (upper.base, ground);
        revolute knee (upper.end, lower.base);
        start { a1 = 0.1; a2 = 0.2; guess y1 = -0.25 [m]; guess y2 = -0.75 [m]; }
    }
}

mechanism! {
    /// A cart without a spring, and a weight that hangs from it.
    pub Cart {
        dof = 2;
        param drag = 0 [N*s/m];
        gravity = (0, -9.81) [m/s^2];
        body cart (x) { mass = 3 [kg]; }
        body bob (xb, yb) { mass = 1 [kg]; }
        constraint rod: (xb - x)^2 + yb^2 = 0.25 [m^2];
        force tyres on x = -drag*der(x);
        start { x = 0; xb = 0.1 [m]; guess yb = -0.4 [m]; }
    }
}

mechanism! {
    /// m ẍ + c ẋ + k x = 0.
    pub Oscillator {
        dof = 1;
        param k = 200 [N/m];
        param c = 4 [N*s/m];
        body block (x) { mass = 2 [kg]; }
        force all on x = -k*x - c*der(x);
    }
}

mechanism! {
    /// A quarter of a car: a wheel on a trailing arm, held by a spring and a damper at a point of the arm.
    pub Suspension {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body car (y) { mass = 300 [kg]; }
        body arm (xa, ya, phi) { mass = 30 [kg]; inertia = 1.5 [kg*m^2]; }
        point pivot on arm = (-0.3, 0) [m];
        point seat on arm = (0.05, 0.02) [m];
        point wheel on arm = (0.2, 0) [m];
        point mount on car = (0.3, 0.45) [m];
        revolute hinge (arm.pivot, car);
        spring strut (arm.seat, car.mount) { stiffness = 6e4 [N/m]; length = 0.48 [m]; damping = 3000 [N*s/m]; }
        force tyre on arm.wheel = (0, -2e5 [N/m]*(arm.wheel.y + 0.05 [m]) - 100 [N*s/m]*der(arm.wheel.y));
        start { y = 0; phi = -0.1; guess xa = 0.3 [m]; guess ya = -0.03 [m]; }
    }
}

mechanism! {
    /// Equal masses between equal springs.
    pub Chain {
        dof = 20;
        param m = 0.5 [kg];
        param k = 800 [N/m];
        for i in 1..=20 { body mass[i] (x[i]) { mass = m; } }
        for i in 1..=20 {
            if i == 1 { force left[i] on x[i] = -k*x[i]; } else { force left[i] on x[i] = -k*(x[i] - x[i-1]); }
            if i == 20 { force right[i] on x[i] = -k*x[i]; } else { force right[i] on x[i] = -k*(x[i] - x[i+1]); }
        }
    }
}

mechanism! {
    /// A point on springs that are as stiff in all directions, and a free one beside it.
    pub Degenerate {
        dof = 4;
        param k = 50 [N/m];
        param c = 0.8 [N*s/m];
        body held (x, y) { mass = 2 [kg]; }
        body free (x = u, y = w) { mass = 1 [kg]; }
        force fx on x = -k*x - c*der(x);
        force fy on y = -k*y - c*der(y);
    }
}

mechanism! {
    /// A force that follows the motion feeds one direction from the other.
    pub Fluttering {
        dof = 2;
        param s = 30 [N/m];
        body point (x, y) { mass = 1 [kg]; }
        force fx on x = -100 [N/m]*x - s*y;
        force fy on y = -100 [N/m]*y + s*x;
    }
}

const G: f64 = 9.81;

fn linear(mechanism: &dyn Equations<f64>) -> Result<Linearization, Error> {
    let found = equilibrium(mechanism, &Search::default())?;
    linearize(mechanism, &OperatingPoint::from(&found), &Ports::default())
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * (1.0 + expected.abs()), "{found} and not {expected}");
}

/// ω² = (3/2) g/l, undamped; upside down it falls away with that rate.
#[test]
fn a_pendulum_swings_and_falls() -> Result<(), Error> {
    let omega = (1.5 * G / 0.8_f64).sqrt();
    let modes = linear(&Pendulum::declared())?.modes()?;
    assert_eq!(modes.len(), 1);
    near(modes[0].natural_frequency(), omega, 1e-11);
    assert_eq!((modes[0].damping_ratio(), modes[0].behaviour), (Some(0.0), Behaviour::Undamped));
    // an angle of 1 rad moves the centre by l/2, to the side
    let shape = &modes[0].shape;
    assert_eq!(shape[2], Complex::from(1.0));
    near(shape[0].re, 0.4, 1e-12);
    near(shape[1].norm(), 0.0, 1e-9);

    let above = Search { from: Some(vec![0.0, 0.4, 1.5]), ..Search::default() };
    let standing = OperatingPoint::from(&equilibrium(&Pendulum::declared(), &above)?);
    let modes = linearize(&Pendulum::declared(), &standing, &Ports::default())?.modes()?;
    let behaviours: Vec<_> = modes.iter().map(|mode| mode.behaviour).collect();
    assert!(behaviours.contains(&Behaviour::Divergence) && behaviours.contains(&Behaviour::Overdamped));
    for mode in &modes {
        near(mode.natural_frequency(), omega, 1e-11);
        near(mode.time_constant(), 1.0 / omega, 1e-11);
        assert_eq!(mode.damping_ratio(), Some(if mode.behaviour.is_unstable() { -1.0 } else { 1.0 }));
    }
    Ok(())
}

/// ω² = (3 ∓ 6/√7) g/l, φ₂/φ₁ = 3g/(lω²) − 8/3.
#[test]
fn a_double_pendulum_has_two_modes() -> Result<(), Error> {
    let modes = linear(&Double::declared())?.modes()?;
    for (mode, sign) in modes.iter().zip([-1.0, 1.0]) {
        let square = (3.0 + sign * 6.0 / 7.0_f64.sqrt()) * G / 0.5;
        near(mode.natural_frequency(), square.sqrt(), 1e-11);
        let ratio = mode.shape[5] / mode.shape[2];
        near(ratio.re, 3.0 * G / (0.5 * square) - 8.0 / 3.0, 1e-9);
        near(ratio.im, 0.0, 1e-12);
        // the largest component is 1
        near(mode.shape.iter().map(|x| x.norm()).fold(0.0, f64::max), 1.0, 1e-12);
    }
    Ok(())
}

/// ω² = (1 + m/M) g/l, in which the common centre stands still; and the cart rolls.
/// Regression: differences over 5 mm know little of a link of 1 mm, and its mode was none. With the link l, the distance a from its
/// end to the centre of mass and k² = J/m: ω⁴ − ω² g (a² + k² + l a)/(l k²) + g² a/(l k²) = 0.
#[test]
fn a_rod_on_a_short_link() -> Result<(), Error> {
    let (a, squared) = (0.25_f64, 0.02_f64);
    for l in [3e-3, 1e-3, 1e-4, 1e-5] {
        let text = format!(
            "Rod {{ dof = 2; gravity = (0, -9.81) [m/s^2]; body rod (x, y, phi) {{ mass = 1 [kg]; inertia = {squared} [kg*m^2]; }}
                point end on rod = (0, {a} [m]); distance link (rod.end, ground) = {l} [m];
                start {{ phi = 0; x = 0; guess y = -{a} [m] - {l} [m]; }} }}"
        );
        let live = Text::declaration("rod.mbs", text).compile().expect("a rod");
        let modes = linear(&live)?.modes()?;
        let [sum, product] = [G * (a * a + squared + l * a), G * G * a].map(|it| it / (l * squared));
        let fast = 0.5 * (sum + (sum * sum - 4.0 * product).sqrt());
        for (mode, expected) in modes.iter().zip([product / fast, fast]) {
            near(mode.natural_frequency().powi(2) / expected, 1.0, 1e-9);
        }
        assert_eq!(modes.len(), 2);
    }
    Ok(())
}

#[test]
fn a_cart_rolls_and_its_pendulum_swings() -> Result<(), Error> {
    let modes = linear(&Cart::declared())?.modes()?;
    assert_eq!(
        modes.iter().map(|mode| mode.behaviour).collect::<Vec<_>>(),
        [Behaviour::RigidBody, Behaviour::Undamped]
    );
    assert_eq!((modes[0].natural_frequency(), modes[0].damping_ratio()), (0.0, None));
    // weight and cart roll together
    near((modes[0].shape[1] / modes[0].shape[0]).re, 1.0, 1e-10);
    near(modes[1].natural_frequency(), (4.0 / 3.0 * G / 0.5_f64).sqrt(), 1e-11);
    near((modes[1].shape[0] / modes[1].shape[1]).re, -1.0 / 3.0, 1e-9);

    // drag takes the velocity, and leaves the position free
    let rolling = Cart::new(CartParameters { drag: 0.01 })?;
    let modes = linear(&rolling)?.modes()?;
    let behaviours: Vec<_> = modes.iter().map(|mode| mode.behaviour).collect();
    assert_eq!(behaviours, [Behaviour::RigidBody, Behaviour::Overdamped, Behaviour::Underdamped]);
    // of all four kilograms, but for the share drag²
    near(modes[1].eigenvalue.re, -0.01 / 4.0, 1e-6);
    Ok(())
}

/// ω = √(k/m), ζ = c/(2√(km)); more than critical damping decays in two ways, critical in one twice.
#[test]
fn an_oscillator_of_every_damping() -> Result<(), Error> {
    let of = |c: f64| {
        linear(&Oscillator::new(OscillatorParameters { c, ..OscillatorParameters::default() })?)?.modes()
    };
    let [damped] = &of(4.0)?[..] else { panic!("one mode") };
    near(damped.natural_frequency(), 10.0, 1e-12);
    near(damped.damping_ratio().expect("a ratio"), 0.1, 1e-12);
    near(damped.damped_frequency(), 10.0 * (1.0 - 0.01_f64).sqrt(), 1e-12);
    near(damped.time_constant(), 1.0, 1e-11);
    assert_eq!(damped.behaviour, Behaviour::Underdamped);

    let [slow, fast] = &of(50.0)?[..] else { panic!("two modes") };
    // λ² + 25 λ + 100 = 0
    near(slow.eigenvalue.re, -5.0, 1e-11);
    near(fast.eigenvalue.re, -20.0, 1e-11);
    for mode in [slow, fast] {
        assert_eq!((mode.damping_ratio(), mode.behaviour), (Some(1.0), Behaviour::Overdamped));
        assert!(mode.behaviour.words().contains("overdamped"));
    }
    let critical = of(40.0)?;
    assert_eq!(critical.len(), 2);
    for mode in &critical {
        // a double root is known to half of the digits
        near(mode.eigenvalue.re, -10.0, 1e-6);
        assert_eq!((mode.eigenvalue.im, mode.behaviour), (0.0, Behaviour::Overdamped));
    }
    let [growing] = &of(-4.0)?[..] else { panic!("one mode") };
    assert_eq!(growing.behaviour, Behaviour::Flutter);
    near(growing.damping_ratio().expect("a ratio"), -0.1, 1e-12);
    Ok(())
}

/// λ² = −100 ± 30i: forces that follow the motion feed one mode and damp the other.
#[test]
fn a_following_force_makes_flutter() -> Result<(), Error> {
    let modes = linear(&Fluttering::declared())?.modes()?;
    let root = Complex::new(-100.0, 30.0).sqrt();
    for (mode, expected) in modes.iter().zip([root, -root.conj()]) {
        near(mode.natural_frequency(), root.norm(), 1e-12);
        near(mode.eigenvalue.re.abs(), expected.re.abs(), 1e-11);
        // it goes round: y is a quarter of a turn ahead or behind
        near((mode.shape[1] / mode.shape[0]).im.abs(), 1.0, 1e-10);
    }
    assert_eq!(modes.iter().filter(|mode| mode.behaviour == Behaviour::Flutter).count(), 1);
    Ok(())
}

/// Two modes have one frequency, with shapes that are independent; two bodies move freely.
#[test]
fn equal_frequencies_have_shapes_of_their_own() -> Result<(), Error> {
    let modes = linear(&Degenerate::declared())?.modes()?;
    let behaviours: Vec<_> = modes.iter().map(|mode| mode.behaviour).collect();
    use Behaviour::{RigidBody, Underdamped};
    assert_eq!(behaviours, [RigidBody, RigidBody, Underdamped, Underdamped]);
    for pair in modes.chunks(2) {
        near(pair[0].natural_frequency(), pair[1].natural_frequency(), 1e-12);
        let place = |mode: &Mode| mode.shape.iter().copied().collect::<Vec<_>>();
        let (a, b) = (place(&pair[0]), place(&pair[1]));
        let dot: Complex<f64> = a.iter().zip(&b).map(|(a, b)| a.conj() * b).sum();
        assert!(dot.norm() < 0.99 * 2.0, "{a:?} {b:?}");
        let planes = if pair[0].behaviour == RigidBody { [2, 3] } else { [0, 1] };
        let minor = a[planes[0]] * b[planes[1]] - a[planes[1]] * b[planes[0]];
        assert!(minor.norm() > 0.1, "{a:?} {b:?}");
    }
    Ok(())
}

/// ω_k = 2 √(k/m) sin(kπ/(2(n + 1))), x_j ~ sin(jkπ/(n + 1)).
#[test]
fn a_chain_of_twenty() -> Result<(), Error> {
    let modes = linear(&Chain::declared())?.modes()?;
    assert_eq!(modes.len(), 20);
    for (k, mode) in (1..=20).zip(&modes) {
        let turn = f64::from(k) * std::f64::consts::PI / 21.0;
        near(mode.natural_frequency(), 2.0 * (800.0 / 0.5_f64).sqrt() * (0.5 * turn).sin(), 1e-11);
        let expected: Vec<f64> = (1..=20).map(|j| (f64::from(j) * turn).sin()).collect();
        let dot: f64 = mode.shape.iter().zip(&expected).map(|(x, y)| x.re * y).sum();
        let sizes = mode.shape.norm() * expected.iter().map(|x| x * x).sum::<f64>().sqrt();
        near(dot.abs() / sizes, 1.0, 1e-12);
    }
    Ok(())
}

/// The accelerations of a suspension at states that are projected onto the nonlinear constraints, with the
/// height of the car and the angle of the arm given, differenced; the eigenvalues by the companion
/// matrix of their characteristic polynomial, whose roots Newton's method has.
#[test]
fn a_suspension_has_the_modes_of_its_differenced_accelerations() -> Result<(), Error> {
    let suspension = Suspension::declared();
    let found = equilibrium(&suspension, &Search::default())?;
    let states = Some(vec!["y".to_owned(), "phi".to_owned()]);
    let point = OperatingPoint::from(&found);
    let modes = linearize(&suspension, &point, &Ports { states, ..Ports::default() })?.modes()?;

    let accelerations = |change: [f64; 4]| {
        let mechanism: &dyn Equations<f64> = &suspension;
        let (mut q, mut v) = (found.q.clone(), vec![0.0; 4]);
        q[0] += change[0];
        q[3] += change[1];
        v[0] += change[2];
        v[3] += change[3];
        let rows = mechanism.info().constraints.len();
        let mut numbers = vec![0.0; Room::<f64>::len(mechanism.info(), 0)];
        let keep: &[&str] = &["y", "phi"];
        let mut room = Room::within(&mut numbers, mechanism.info());
        project(mechanism, 0.0, &mut q, &mut v, [keep, keep], &mut room).expect("near");
        let (mut a, mut lambda) = (vec![0.0; 4], vec![0.0; rows]);
        mechanism.reactions(At { t: 0.0, q: &q, v: &v }, &[], &mut a, &mut lambda);
        [a[0], a[3]]
    };
    let mut a = DMatrix::<f64>::zeros(4, 4);
    (a[(0, 2)], a[(1, 3)]) = (1.0, 1.0);
    for column in 0..4 {
        let step = 1e-4;
        let at =
            |share: f64| accelerations(std::array::from_fn(|k| if k == column { share * step } else { 0.0 }));
        let (p, m, pp, mm) = (at(1.0), at(-1.0), at(2.0), at(-2.0));
        for row in 0..2 {
            a[(2 + row, column)] = (8.0 * (p[row] - m[row]) - (pp[row] - mm[row])) / (12.0 * step);
        }
    }
    // det(λ − A) by the traces of powers (Newton's identities)
    let powers = [&a * 1.0, &a * &a, &a * &a * &a, &a * &a * &a * &a].map(|power| power.trace());
    let mut coefficients = [1.0, 0.0, 0.0, 0.0, 0.0];
    for k in 1..=4 {
        let sum: f64 = (1..=k).map(|i| coefficients[k - i] * powers[i - 1]).sum();
        coefficients[k] = -sum / k as f64;
    }
    assert_eq!(modes.len(), 2);
    for mode in &modes {
        assert_eq!(mode.behaviour, Behaviour::Underdamped);
        let mut root = mode.eigenvalue * Complex::new(1.01, 0.01);
        for _ in 0..50 {
            let (mut value, mut slope) = (Complex::from(0.0), Complex::from(0.0));
            for coefficient in coefficients {
                slope = slope * root + value;
                value = value * root + coefficient;
            }
            root -= value / slope;
        }
        near(mode.natural_frequency(), root.norm(), 1e-8);
        near(mode.damping_ratio().expect("a ratio"), -root.re / root.norm(), 1e-8);
    }
    Ok(())
}
