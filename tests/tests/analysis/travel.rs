//! Efforts over travel against closed forms: a pendulum, a press by virtual work, the advantage of a
//! four-bar linkage, a toggle with its drive, springs behind one another; that they are derivatives of the
//! potential energy; dead centres, snapping through, and what is refused.

#![allow(clippy::expect_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_analysis::{Along, Error, Position, Travel, travel};
use mbs_runtime::equations::{At, Equations};
use mbs_runtime::mechanism;

mechanism! {
    /// A press: a crank turns, a slider pushes.
    pub Press {
        dof = 1;
        param r = 60 [mm];
        param l = 180 [mm];
        input load [kN];
        body crank (x1, y1, theta) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body rod (x2, y2, beta) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body slider (x) { mass = 2 [kg]; }
        point base on crank = (-r/2, 0);    point tip on crank = (r/2, 0);
        point base on rod = (-l/2, 0);      point tip on rod = (l/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        force work on slider = (-load, 0);
        start { theta = 60 [deg]; guess beta = -15 [deg]; guess x = 0.2 [m]; guess x1 = 15 [mm];
                guess y1 = 25 [mm]; guess x2 = 0.1 [m]; guess y2 = 25 [mm]; }
        output tension [N] = lambda(wrist_x);
    }
}

four_bar! { FourBar;
    dof = 1;
    point bearing on ground = (0.5, 0) [m];
    point post on ground = (0.2, 0.9) [m];
    spring s1 (coupler, ground.post) { stiffness = 800 [N/m]; length = 0.3 [m]; damping = 30 [N*s/m]; }
}

mechanism! {
    /// Two links that a drive pushes straight, quickly.
    pub Toggle {
        dof = 0;
        param l = 0.3 [m];
        input work [N];
        body upper (x1, y1, a) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body lower (x2, y2, b) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body ram (y) { mass = 2 [kg]; }
        point top on upper = (0, l/2);  point knee on upper = (0, -l/2);
        point knee on lower = (0, l/2); point foot on lower = (0, -l/2);
        revolute bearing (ground, upper.top);
        revolute knee (upper.knee, lower.knee);
        revolute foot (lower.foot, ram);
        drive push: upper.knee.x = 100 [mm] + 50 [mm]*cos(40 [rad/s]*t);
        force work on ram = (0, work);
        start { guess x1 = 75 [mm]; guess y1 = -0.13 [m]; guess a = 30 [deg]; guess x2 = 75 [mm];
                guess y2 = -0.39 [m]; guess b = -30 [deg]; guess y = -0.52 [m]; }
        output hand [N] = effort(push);
    }
}

mechanism! {
    /// A hand, a spring, a block, a spring, a wall.
    pub Springs {
        dof = 2;
        body hand (x) { mass = 1 [kg]; }
        body block (x = z) { mass = 1 [kg]; }
        force near on x = -300 [N/m]*(x - z);
        force on_block on z = 300 [N/m]*(x - z) - 700 [N/m]*z - 5 [N*s/m]*der(z);
    }
}

mechanism! {
    /// A spring that pushes a link through its flat position: V = k₁(x − z)²/2 + k (√(a² + z²) − l)².
    pub Snapping {
        dof = 2;
        body hand (x) { mass = 1 [kg]; }
        body link (x = z) { mass = 1 [kg]; }
        force near on x = -50 [N/m]*(x - z);
        force on_link on z = 50 [N/m]*(x - z) - 1000 [N/m]*z*(1 - 0.5 [m]/sqrt(0.16 [m^2] + z^2));
        start { x = -0.3 [m]; z = -0.3 [m]; }
    }
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} and not {expected}");
}

fn between(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|at| from + (to - from) * f64::from(at) / f64::from(count)).collect()
}

fn along(name: &str, samples: Vec<f64>) -> Travel {
    Travel { along: Along::Coordinate(name.into()), samples, inputs: None, from: None, t: 0.0 }
}

fn potential(mechanism: &dyn Equations<f64>, position: &Position) -> f64 {
    let still = vec![0.0; position.q.len()];
    mechanism.potential_energy(At { t: position.t, q: &position.q, v: &still })
}

/// x = r cos θ + √(l² − r² sin²θ), and the torque is load · (−dx/dθ)⁻… by virtual work: M dθ = P dx.
#[test]
fn a_press_by_virtual_work() {
    let (r, l, load) = (0.06_f64, 0.18_f64, 5e3);
    let request = Travel { inputs: Some(vec![load]), ..along("theta", between(-4.0, 4.0, 80)) };
    for position in travel(&Press::declared(), &request).expect("it turns") {
        let theta = position.travel;
        let root = (l * l - (r * theta.sin()).powi(2)).sqrt();
        near(position.q[6], r * theta.cos() + root, 1e-14);
        let ratio = -r * theta.sin() - r * r * theta.sin() * theta.cos() / root;
        let ratios = position.ratios.as_ref().expect("one degree of freedom");
        near(ratios[6], ratio, 1e-14);
        near(position.effort, load * ratio, 1e-10 * load);
        // torque in and force out: M = F dx/dθ
        near(position.advantage(6).expect("one degree of freedom"), 1.0 / ratio, 1e-10 * (1.0 / ratio).abs());
        near(position.outputs[0].abs(), load, 1e-9 * load);
    }
    // at the dead centres of the crank no torque holds any load
    let request = Travel { inputs: Some(vec![load]), ..along("theta", vec![0.0, std::f64::consts::PI]) };
    for position in travel(&Press::declared(), &request).expect("it turns") {
        near(position.effort, 0.0, 1e-12 * load);
        assert_eq!(position.advantage(6).map(f64::abs), Some(f64::INFINITY));
    }
}

/// By the law of sines of velocities: ω₄/ω₂ = a sin(θ₂ − θ₃) / (c sin(θ₄ − θ₃)).
#[test]
fn the_advantage_of_a_four_bar() {
    for position in travel(&FourBar::declared(), &along("t1", between(0.2, 2.8, 50))).expect("it turns") {
        let [t1, t2, t3] = [position.q[2], position.q[5], position.q[8]];
        let expected = 0.3 * (t3 - t2).sin() / (0.2 * (t1 - t2).sin());
        near(position.advantage(8).expect("one degree of freedom"), expected, 1e-10 * expected.abs());
    }
}

/// F = dV/dx of gravity and springs, whatever the damper is.
#[test]
fn the_effort_is_the_slope_of_the_potential_energy() {
    let four_bar = FourBar::declared();
    let h = 1e-3;
    for t1 in between(0.3, 2.5, 11) {
        let around = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|step| t1 + step * h).to_vec();
        let found = travel(&four_bar, &along("t1", around)).expect("it turns");
        let v: Vec<f64> = found.iter().map(|position| potential(&four_bar, position)).collect();
        let slope = (8.0 * (v[3] - v[1]) - (v[4] - v[0])) / (12.0 * h);
        // truncation h⁴ and rounding ε V/h
        near(found[2].effort, slope, 1e-9);
    }
}

/// y = −2 l cos α with sin α = x/l: the push is work · dy/dx = work · 2 tan α, whatever speed and
/// acceleration the law of the drive has.
#[test]
fn a_toggle_and_its_drive() {
    let request = Travel {
        along: Along::Drive("push".into()),
        samples: between(0.0, 0.07, 20),
        inputs: Some(vec![400.0]),
        from: None,
        t: 0.0,
    };
    for position in travel(&Toggle::declared(), &request).expect("it is driven") {
        let x = 0.1 + 0.05 * (40.0 * position.t).cos();
        let tan = (x / 0.3).asin().tan();
        near(position.travel, x - 0.15, 1e-13);
        near(position.effort, -400.0 * 2.0 * tan, 1e-9);
        near(position.outputs[0], position.effort, 1e-12);
        // the drive pushes by 1 N, the ram by that
        near(position.advantage(6).expect("driven"), 1.0 / (2.0 * tan), 1e-10);
    }
}

#[test]
fn springs_behind_one_another() {
    for position in travel(&Springs::declared(), &along("x", between(-0.2, 0.2, 8))).expect("it stretches") {
        near(position.effort, 300.0 * 700.0 / 1000.0 * position.travel, 1e-10);
        near(position.q[1], 0.3 * position.travel, 1e-12);
        assert_eq!(position.ratios, None);
    }
}

#[test]
fn a_link_snaps_through() {
    let error = travel(&Snapping::declared(), &along("x", between(-0.3, 3.0, 100))).expect_err("it snaps");
    let Error::Snap { sample, coordinates, .. } = &error else { panic!("{error}") };
    assert_eq!(coordinates, &["z"]);
    // where 50 − 1000 + 500·0.16/(0.16 + z²)^1.5 … vanishes: ∂²V/∂z² = 0
    let z = -((500.0 * 0.16 / 1050.0_f64).powf(2.0 / 3.0) - 0.16).sqrt();
    let x = z + 20.0 * z * (1.0 - 0.5 / (0.16 + z * z).sqrt());
    let expected = ((x + 0.3) / 0.033).floor() as usize + 2;
    assert_eq!(*sample, expected, "{error}");
}

#[test]
fn what_is_refused() {
    let refused = |mechanism: &dyn Equations<f64>, request: &Travel| {
        travel(mechanism, request).expect_err("it is wrong")
    };
    let press = Press::declared();
    assert!(matches!(refused(&press, &along("phi", vec![0.0])), Error::Unknown { kind: "coordinate", .. }));
    let endless = along("theta", vec![f64::NAN]);
    assert!(matches!(refused(&press, &endless), Error::Samples { .. }));
    let short = Travel { inputs: Some(vec![]), ..along("theta", vec![0.0]) };
    assert!(matches!(refused(&press, &short), Error::Length { what: "inputs", .. }));
    let drive = Travel { along: Along::Drive("pin_x".into()), ..along("theta", vec![0.0]) };
    assert!(refused(&press, &drive).to_string().contains("`pin_x` is not a drive"));
    assert!(matches!(refused(&Toggle::declared(), &along("y", vec![0.0])), Error::Prescribed { dof: 0, .. }));

    // the slider is led outwards past r + l, where the crank is at its dead centre
    let error = refused(&press, &along("x", between(0.2, 0.25, 10)));
    let Error::Unreachable { sample: 9, coordinate: "theta", place, .. } = &error else { panic!("{error}") };
    assert!(place.contains("`x` = 0.24000") || place.contains("`x` = 0.23999"), "{place}");
}
