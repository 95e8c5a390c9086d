//! Mechanisms with laws of pieces, conditions and tables.

use std::f64::consts::TAU;

use mbs_runtime::{Error, Mechanism, Simulation};
use models::{CraneRope, CraneRopeParameters};
use paths::bisect;

use super::{found, near, to_tolerance};

const G: f64 = 9.81;

/// A part of a motion: when it begins, and place and velocity so long after that.
type Part = (f64, Box<dyn Fn(f64) -> [f64; 2]>);

/// ẍ + 2δ ẋ + ω² x = 0 from x₀ and v₀.
fn ringing(omega_squared: f64, delta: f64, x0: f64, v0: f64) -> impl Fn(f64) -> [f64; 2] {
    let nu = (omega_squared - delta * delta).sqrt();
    let share = (v0 + delta * x0) / nu;
    move |t| {
        let ((sin, cos), decay) = ((nu * t).sin_cos(), (-delta * t).exp());
        let x = decay * (x0 * cos + share * sin);
        [x, decay * nu * (share * cos - x0 * sin) - delta * x]
    }
}

/// The stretch of the rope below a hook of constant speed: wound up against the floor, in the air, in flight, and
/// caught again. The parts begin where the rope gets taut, where the load leaves the floor, and so on.
fn lift(p: &CraneRopeParameters<f64>) -> Result<[Part; 4], Error> {
    let (m, k, c) = (p.load_mass, p.stiffness, p.damping);
    let (sag, v) = (m * G / p.floor_stiffness, hoisting(p));
    let (omega_squared, delta, hanging) = (k / m, c / (2.0 * m), m * G / k);

    // m s̈ + c ṡ + (k + k_f) s = k_f v t
    let stiff = (k + p.floor_stiffness) / m;
    let rate = p.floor_stiffness * v / (m * stiff);
    let lag = 2.0 * delta * rate / stiff;
    let apart = ringing(stiff, delta, lag, v - rate);
    let wound = move |t: f64| {
        let [x, speed] = apart(t);
        [rate * t - lag + x, rate + speed]
    };
    let taut = 0.1 * p.hoist_time + (p.slack - sag) / v;
    let lifted = bisect(1e-3, 0.08, |t| Ok(wound(t)[0] - (v * t - sag)))?;

    let about_hanging = move |[s, speed]: [f64; 2]| {
        let apart = ringing(omega_squared, delta, s - hanging, speed);
        move |t: f64| {
            let [x, speed] = apart(t);
            [hanging + x, speed]
        }
    };
    let in_air = about_hanging(wound(lifted));
    let slack = bisect(0.1, 0.28, |t| {
        let [s, speed] = in_air(t);
        Ok(k * s + c * speed)
    })?;
    let [s, speed] = in_air(slack);
    let flight = move |t: f64| [s + (speed + 0.5 * G * t) * t, speed + G * t];
    let back = (-speed + (speed * speed - 2.0 * G * s).sqrt()) / G;
    let caught = about_hanging(flight(back));

    let flown = taut + lifted + slack;
    let parts: [Part; 4] = [
        (taut, Box::new(wound)),
        (taut + lifted, Box::new(in_air)),
        (flown, Box::new(flight)),
        (flown + back, Box::new(caught)),
    ];
    Ok(parts)
}

/// Speed of the hook in the middle of its trapezoid, whose sides are a fifth of the time each.
fn hoisting(p: &CraneRopeParameters<f64>) -> f64 {
    p.hoist / (0.8 * p.hoist_time)
}

/// The moments to 1e-11 s, and the place to 1e-11 m, some ten times what 300 steps to 1e-12 of 5 m of height leave;
/// the tension is off by the stiffness times that.
#[test]
fn crane_rope_goes_slack_and_is_caught() -> Result<(), Error> {
    let p: CraneRopeParameters<f64> = CraneRopeParameters::default();
    let parts = lift(&p)?;
    let mut run = to_tolerance(CraneRope::declared()).build()?;
    for (name, (begin, _)) in ["taut", "lifted", "slack", "taut"].into_iter().zip(&parts) {
        let event = run.advance_to_event(1.5)?.unwrap();
        assert_eq!(CraneRope::<f64>::INFO.events[event.index].name, name);
        near(name, event.t, *begin, 1e-11);
    }
    assert!(run.advance_to_event(1.5)?.is_none());

    let mut run = to_tolerance(CraneRope::declared()).build()?;
    for t in [0.53, 0.56, 0.6, 0.7, 0.82, 0.85, 0.88, 0.9, 1.0, 1.2, 1.5] {
        run.advance_to(t)?;
        let (begin, part) = parts.iter().rfind(|(begin, _)| *begin < t).unwrap();
        let [s, speed] = part(t - begin);
        let hook = p.rope_length - p.slack - p.height + hoisting(&p) * (t - 0.1 * p.hoist_time);
        near("height", run.state().q.y, hook - p.rope_length - s, 1e-11);
        let pull = if s > 0.0 { (p.stiffness * s + p.damping * speed).max(0.0) } else { 0.0 };
        let (_, outputs) = found(run.mechanism(), &run.state(), run.inputs());
        near("tension", outputs.tension, pull, 1e-11 * p.stiffness);
    }
    Ok(())
}

/// At instants while the trolley travels: forces to the rounding of a stretch, which is the difference of lengths of
/// 1.5 m, times the stiffness. The way takes two periods of the swing, which leave 0.2° of 8°: the period of a swing so
/// wide is longer by a thousandth, and the load still bounces.
#[test]
fn crane_carries_its_load() -> Result<(), Error> {
    let p: CraneRopeParameters<f64> = CraneRopeParameters::default();
    let mut run = Simulation::new(CraneRope::declared(), 0.5e-3)?;
    let mut widest = 0.0_f64;
    for k in 0..=60 {
        run.advance_to(2.0 + 0.1 * f64::from(k))?;
        let (at, outputs) = (run.state(), run.outputs()?);
        let (q, v) = (at.q, at.v);
        let (dx, dy) = (q.x - q.x_h, q.y - q.y_h);
        let d = dx.hypot(dy);
        let (s, rate) = (d - p.rope_length, (dx * (v.x - v.x_h) + dy * (v.y - v.y_h)) / d);
        let pull = if s > 0.0 { (p.stiffness * s + p.damping * rate).max(0.0) } else { 0.0 };
        near("tension", outputs.tension, pull, 1e-9);
        let a = run.reactions()?.acceleration;
        near("ẍ", a.x, -pull * dx / d / p.load_mass, 1e-11);
        near("ÿ", a.y, -pull * dy / d / p.load_mass - G, 1e-11);
        let (u, unit) = ((at.t - p.hoist_time - 0.2) / p.travel_time, TAU / p.travel_time);
        let driven =
            if (0.0..1.0).contains(&u) { p.travel * unit / p.travel_time * (TAU * u).sin() } else { 0.0 };
        near("trolley", a.x_t, driven, 1e-12);
        let force = (p.trolley_mass + p.hook_mass) * driven - pull * dx / d;
        near("drive", outputs.drive_force, force, 1e-9);
        widest = widest.max(outputs.swing.abs());
    }
    assert!((0.12..0.16).contains(&widest), "{widest}");
    assert!(run.outputs()?.swing.abs() < 0.004);
    Ok(())
}
