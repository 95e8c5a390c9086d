//! A rod on random parallel cranks, three to five, whose joints are declared in a random order: held more often than it
//! needs, each time by other rows.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::f64::consts::PI;
use std::fmt::Write as _;

use mbs_live::{Prepared, Text};
use mbs_runtime::{Adaptive, Error, Sampled, System, Tolerances};
use tests::random::Random;

const MECHANISMS: u64 = 8;
const TOLERANCES: Tolerances =
    Tolerances { rtol: 1e-9, atol: 1e-10, max_step: f64::INFINITY, first_step: None };

/// A declaration, and where its first crank is, with which rate, and how fast that is at the angle a: ω²(a).
struct Cranks {
    text: String,
    rate: f64,
    squared: Box<dyn Fn(f64) -> f64>,
}

fn cranks(number: u64) -> Cranks {
    let mut random = Random::new(number);
    let (count, r) = (3 + random.below(3), random.between(0.1, 0.6));
    // the first three far from one line, where no position is singular
    let mut pivots = vec![[0.0, 0.0], [random.between(0.8, 1.5), 0.0], [random.between(-0.5, 1.5), 0.9]];
    pivots.resize_with(count, || [random.between(-1.0, 1.0), random.between(-1.0, 1.0)]);
    let (start, mass) = (random.between(-3.0, 3.0), random.between(0.3, 3.0));
    let rate = (5.0 * 9.81 / r).sqrt() + random.between(0.0, 3.0);
    let (mut inertia, mut joints, mut text) = (mass * r * r, Vec::new(), String::new());
    let mut guesses = String::new();
    for (at, [x, y]) in pivots.into_iter().enumerate() {
        let own = random.between(0.001, 0.1);
        inertia += own;
        let _ = writeln!(
            text,
            "body c{at} (x{at}, y{at}, a{at}) {{ mass = 0.5 [kg]; inertia = {own} [kg*m^2]; }}
             point o{at} on ground = ({x}, {y}) [m]; point e{at} on c{at} = ({r}, 0) [m]; point p{at} on rod = ({x}, {y}) [m];"
        );
        joints.push(format!("revolute j{at} (c{at}, ground.o{at});"));
        joints.push(format!("revolute k{at} (rod.p{at}, c{at}.e{at});"));
        let _ = write!(guesses, "guess x{at} = {x} [m]; guess y{at} = {y} [m]; ");
        let _ = if at == 0 { Ok(()) } else { write!(guesses, "guess a{at} = {start}; ") };
    }
    while !joints.is_empty() {
        text += &joints.swap_remove(random.below(joints.len()));
    }
    let states = random.of(&["all", "reduced"]);
    let [x, y] = [r * start.cos(), r * start.sin()];
    let text = format!(
        "Cranks {{ dof = 1; states = {states}; redundant = minimum_norm; gravity = (0, -9.81) [m/s^2];
            body rod (x, y, b) {{ mass = {mass} [kg]; inertia = 0.1 [kg*m^2]; }} {text}
            start {{ a0 = {start}; der(a0) = {rate} [rad/s]; guess x = {x} [m]; guess y = {y} [m]; {guesses} }} }}"
    );
    let weight = mass * 9.81 * r;
    let squared = Box::new(move |a: f64| rate * rate - 2.0 * weight * (a.sin() - start.sin()) / inertia);
    Cranks { text, rate, squared }
}

/// For two turns and more they turn as a pendulum does that has all their inertia. A run used to end where the rows that were
/// left out would have been needed.
#[test]
fn random_cranks_turn_on_and_on() -> Result<(), Error> {
    for number in 0..MECHANISMS {
        let Cranks { text, rate, squared } = cranks(number);
        let live = Text::declaration("cranks.mbs", text.as_str()).compile().expect("cranks");
        let run = Adaptive::builder(Prepared::new(&live)).tolerances(TOLERANCES).build()?;
        let mut run = Sampled::new(run, 6.0 * PI / rate)?;
        run.advance(1).inspect_err(|_| {
            println!("{number}: {text}");
        })?;
        let info = live.declared_info();
        let (mut q, mut v) = (vec![0.0; info.coordinates.len()], vec![0.0; info.coordinates.len()]);
        run.state(&mut q, &mut v);
        let first = info.coordinates.iter().position(|coordinate| coordinate.name == "a0").expect("a crank");
        let (found, expected) = (v[first].powi(2), squared(q[first]));
        // some hundred steps, each to 1e-9 of the rate
        assert!((found - expected).abs() < 1e-6 * expected, "{number}: {found} and {expected}\n{text}");
    }
    Ok(())
}
