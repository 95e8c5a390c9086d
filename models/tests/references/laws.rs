//! Mechanisms with laws of pieces, conditions and tables.

use std::f64::consts::{PI, TAU};

use mbs_runtime::{Direction, Error, Mechanism, Simulation};
use models::{CraneRope, CraneRopeParameters, Engine, EngineParameters};
use paths::bisect;

use super::{EXACT, found, near, to_tolerance};

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
    let mut run = to_tolerance(CraneRope::declared(), 1e-12).build()?;
    for (name, (begin, _)) in ["taut", "lifted", "slack", "taut"].into_iter().zip(&parts) {
        let event = run.advance_to_event(1.5)?.unwrap();
        assert_eq!(CraneRope::<f64>::INFO.events[event.index].name, name);
        near(name, event.t, *begin, 1e-11);
    }
    assert!(run.advance_to_event(1.5)?.is_none());

    let mut run = to_tolerance(CraneRope::declared(), 1e-12).build()?;
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

/// The indicator diagram in degrees and bar, as it stands in the file.
#[rustfmt::skip]
const DIAGRAM: [(f64, f64); 26] = [
    (0.0, 1.1), (30.0, 0.9), (180.0, 0.9), (210.0, 0.95), (240.0, 1.16), (270.0, 1.7), (290.0, 2.45),
    (310.0, 4.1), (325.0, 6.5), (340.0, 10.3), (350.0, 13.5), (360.0, 22.0), (367.0, 32.0), (375.0, 36.0),
    (385.0, 31.0), (400.0, 19.5), (420.0, 11.1), (440.0, 7.2), (460.0, 5.2), (480.0, 4.2), (500.0, 3.6),
    (520.0, 2.6), (540.0, 1.7), (570.0, 1.2), (600.0, 1.1), (720.0, 1.1),
];

/// ds/dθ of a piston.
fn slope_of_piston(p: &EngineParameters<f64>, theta: f64) -> f64 {
    let (sin, cos) = theta.sin_cos();
    let (r, across) = (p.crank_length, (p.rod_length.powi(2) - (p.crank_length * sin).powi(2)).sqrt());
    -r * sin * (1.0 + r * cos / across)
}

/// At single states: the coordinates that belong to θ, Lagrange's equation in θ and the virtual work of the gas,
/// with accelerations of the size of 1000 rad/s² and torques of 100 N·m.
#[test]
fn engine_turns_by_the_virtual_work_of_its_gas() {
    let mechanism = Engine::declared();
    let p = *mechanism.parameters();
    let (r, l) = (p.crank_length, p.rod_length);
    let (area, rod_inertia) = (PI / 4.0 * p.bore * p.bore, p.rod_mass * l * l / 12.0);
    for (theta, omega) in [(0.3, 10.0), (3.0, 0.0), (6.5, 150.0), (7.2, 50.0), (10.4, 200.0_f64)] {
        let (sin, cos) = f64::sin_cos(theta);
        let q = (l * l - r * r * sin * sin).sqrt();
        // first and second derivatives by θ of the piston's place, the rod's middle and its angle
        let s1 = slope_of_piston(&p, theta);
        let s2 = -r * cos - r * r * (cos * cos - sin * sin) / q - (r * r * sin * cos).powi(2) / q.powi(3);
        let [x1, x2] = [-0.5 * r * cos, 0.5 * r * sin];
        let [y1, y2] = [0.5 * (s1 - r * sin), 0.5 * (s2 - r * cos)];
        let [phi1, phi2] = [-r * cos / q, r * sin / q - r.powi(3) * sin * cos * cos / q.powi(3)];

        let mut at = mechanism.declared_start();
        (at.q.theta, at.q.phi, at.q.y_p) = (theta, -(r * sin / l).asin(), r * cos + q);
        (at.q.x, at.q.y) = (-0.5 * r * sin, r * cos + 0.5 * q);
        (at.v.theta, at.v.phi, at.v.y_p) = (omega, phi1 * omega, s1 * omega);
        (at.v.x, at.v.y) = (x1 * omega, y1 * omega);

        let degrees = theta.to_degrees() % 720.0;
        let piece = DIAGRAM.windows(2).rfind(|pair| pair[0].0 <= degrees).unwrap();
        let [(from, low), (to, high)] = [piece[0], piece[1]];
        let pressure = 1e5 * (low + (high - low) * (degrees - from) / (to - from));
        let gas = -(pressure - 1e5) * area * s1;
        let starter = p.starter * (1.0 - omega / p.starter_speed).max(0.0);
        let taken = p.viscous * omega + p.load * omega * omega;
        let weight = G * (p.piston_mass * s1 + p.rod_mass * y1);
        let inertia = p.inertia
            + p.piston_mass * s1 * s1
            + p.rod_mass * (x1 * x1 + y1 * y1)
            + rod_inertia * phi1 * phi1;
        let changing = p.piston_mass * s1 * s2 + p.rod_mass * (x1 * x2 + y1 * y2) + rod_inertia * phi1 * phi2;
        let torque = gas + starter - taken - weight - changing * omega * omega;

        let (a, outputs) = found(&mechanism, &at, &Default::default());
        near("pressure", outputs.cylinder, pressure, 1e6 * EXACT);
        near("torque of the gas", outputs.gas_torque, gas, 1e2 * EXACT);
        near("θ̈", a.theta, torque / inertia, 1e3 * EXACT);
        near("power of the gas", a.gas_work, gas * omega, 1e4 * EXACT);
    }
}

/// The area of the diagram over the volume, by Simpson's rule in 200 parts of each of its pieces: to 1e-12 of it. A
/// cycle of the run takes some 200 steps, which end at 26 points of the diagram, each to 1e-12 of 170 J.
#[test]
fn engine_works_by_the_area_of_its_diagram() -> Result<(), Error> {
    const PARTS: u32 = 200;
    let mechanism = Engine::declared();
    let p = *mechanism.parameters();
    let area = PI / 4.0 * p.bore * p.bore;
    let mut work = 0.0;
    for piece in DIAGRAM.windows(2) {
        let [(from, low), (to, high)] = [piece[0], piece[1]];
        let h = (to - from).to_radians() / f64::from(PARTS);
        for at in 0..=PARTS {
            let weight = if at == 0 || at == PARTS { 1.0 } else { 2.0 + 2.0 * f64::from(at % 2) };
            let pressure = 1e5 * (low + (high - low) * f64::from(at) / f64::from(PARTS) - 1.0);
            let slope = slope_of_piston(&p, from.to_radians() + h * f64::from(at));
            work -= weight * h / 3.0 * pressure * area * slope;
        }
    }
    // 231 mL and a mean pressure of 7.2 bar
    assert!((166.0..168.0).contains(&work), "{work}");

    let mut run = to_tolerance(mechanism, 1e-12).build()?;
    let start = run.state().q.theta;
    for cycle in 1..=5 {
        let end = start + 4.0 * PI * f64::from(cycle);
        let event = run.advance_until(3.0, [Direction::Rising], |at| [at.q.theta - end])?;
        assert!(event.is_some());
        near("work of the gas", run.state().v.gas_work, f64::from(cycle) * work, 3e-8 * f64::from(cycle));
    }
    Ok(())
}
