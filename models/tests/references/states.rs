//! Mechanisms with states of their own beside their motion.

use std::f64::consts::{PI, TAU};

use mbs_runtime::{Direction, Error, Mechanism, Simulation, State};
use models::{BoomCylinder, BoomCylinderParameters, Brake, BrakeParameters};
use paths::through_fused_path;

use super::{EXACT, found, near, to_tolerance};

const G: f64 = 9.81;

/// Without fade. The heating M ω falls at the rate M b, and a step h of Heun's method is off by h³ M b/(6 C τ) by way
/// of the cooling, whose time constant is τ; a quarter more for the temperature's own share. 9000 steps round.
#[test]
fn brake_heats_its_disc() -> Result<(), Error> {
    let p = BrakeParameters::<f64> { fade: 0.0, ..Default::default() };
    let slowing = 2.0 * p.press * p.radius * p.cold / p.inertia;
    let tau = p.capacity / p.cooling;
    let falling = p.inertia * slowing * slowing / p.capacity;
    let step = 1e-3;
    let start = |step| Simulation::new(Brake::new(p)?, step);
    through_fused_path("brake without fade", step, start, |case, run| {
        for t in [1.0, 3.0, 5.0, 7.0, 9.0] {
            run.advance_to(t)?;
            let (now, left) = (run.now()?, (-t / tau).exp());
            let rounding = t / step * f64::EPSILON;
            let truncation = 1.25 * step * step * t * falling / (6.0 * tau);
            let speed = p.speed - slowing * t;
            case.near_within("speed", now.v.theta, speed, 0.0, rounding * p.speed);
            let heated = (p.speed + slowing * tau) * (1.0 - left) - slowing * t;
            let temperature = p.air + (p.warm - p.air) * left + p.inertia * slowing / p.cooling * heated;
            case.near_within(
                "temperature",
                now.v.temperature,
                temperature,
                truncation,
                rounding * temperature,
            );
            let lost = 0.5 * p.inertia * (p.speed * p.speed - speed * speed);
            let taken = lost - p.capacity * (temperature - p.warm);
            case.near_within(
                "taken by the air",
                now.v.taken,
                taken,
                truncation * p.capacity,
                rounding * lost,
            );
        }
        Ok(())
    })
}

/// With fade against the method of Runge and Kutta with 2·10⁻⁵ s, written out here. The law bends at the points of
/// the table, where a step of it is off by h² times the jump of the acceleration's rate, 1 rad/s³: 4e-10 rad/s. The
/// run's steps are some hundred, each to 1e-12 of 157 rad/s and of 700 K. And the energy that is gone is stored or taken
/// by the air, to 1e-12 of 740 kJ.
#[test]
fn brake_fades() -> Result<(), Error> {
    const STEP: f64 = 2e-5;
    let p: BrakeParameters<f64> = BrakeParameters::default();
    let points = [(420.0, 0.0), (520.0, 0.08), (620.0, 0.3), (720.0, 0.5)];
    let coefficient = |temperature: f64| {
        let piece = points.windows(2).rfind(|pair| pair[0].0 <= temperature).unwrap_or(&points[..2]);
        let [(x0, y0), (x1, y1)] = [piece[0], piece[1]];
        let lost = y0 + (y1 - y0) / (x1 - x0) * (temperature - x0);
        p.cold * (1.0 - lost.clamp(0.0, 0.5))
    };
    let rates = |[speed, temperature]: [f64; 2]| {
        let grip = 2.0 * p.press * p.radius * coefficient(temperature) * (speed / p.transition).tanh();
        [-grip / p.inertia, (grip * speed - p.cooling * (temperature - p.air)) / p.capacity]
    };
    let after = |at: [f64; 2], rate: [f64; 2], h: f64| [at[0] + h * rate[0], at[1] + h * rate[1]];
    let mut by_hand = [p.speed, p.warm];
    let mut steps = 0_u32;

    let mut run = to_tolerance(Brake::declared(), 1e-12).build()?;
    let energy = 0.5 * p.inertia * p.speed * p.speed;
    for t in [1.0, 3.0, 5.0, 8.0, 11.0, 13.0] {
        while f64::from(steps) * STEP < t - 0.5 * STEP {
            let k1 = rates(by_hand);
            let k2 = rates(after(by_hand, k1, STEP / 2.0));
            let k3 = rates(after(by_hand, k2, STEP / 2.0));
            let k4 = rates(after(by_hand, k3, STEP));
            for (rate, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                by_hand = after(by_hand, rate, weight * STEP / 6.0);
            }
            steps += 1;
        }
        run.advance_to(t)?;
        let at = run.state();
        near("speed", at.v.theta, by_hand[0], 1e-8);
        near("temperature", at.v.temperature, by_hand[1], 3e-8);
        let (_, outputs) = found(run.mechanism(), &at, run.inputs());
        near("friction", outputs.friction, coefficient(by_hand[1]), 1e-10);
        let gone = energy - 0.5 * p.inertia * at.v.theta * at.v.theta;
        near("heat", outputs.stored + at.v.taken, gone, 1e-12 * energy);
    }
    Ok(())
}

/// Length of the cylinder over the boom's angle, s, s′ and s″, and the moment G of the weights with G′.
struct Boom {
    length: [f64; 3],
    moment: [f64; 2],
    inertia: f64,
    /// Areas of the piston, A_a and A_b.
    areas: [f64; 2],
    /// Volumes of the chambers.
    volumes: [f64; 2],
}

fn boom(p: &BoomCylinderParameters<f64>, phi: f64) -> Boom {
    let (a, b) = (0.4 * p.boom_length, 0.15_f64.hypot(0.225) * p.boom_length);
    let (sin, cos) = (phi + 0.225_f64.atan2(0.15)).sin_cos();
    let s = (a * a + b * b - 2.0 * a * b * cos).sqrt();
    let s1 = a * b * sin / s;
    let weight = G * p.boom_length * (p.boom_mass / 2.0 + p.load_mass);
    let areas = [p.bore * p.bore, p.bore * p.bore - p.rod * p.rod].map(|square| PI / 4.0 * square);
    Boom {
        length: [s, s1, (a * b * cos - s1 * s1) / s],
        moment: [weight * phi.cos(), -weight * phi.sin()],
        inertia: p.boom_length.powi(2) * (p.boom_mass / 3.0 + p.load_mass),
        areas,
        volumes: [p.dead + areas[0] * (s - p.shortest), p.dead + areas[1] * (p.longest - s)],
    }
}

type BoomState = State<<BoomCylinder<f64> as Mechanism>::Coordinates>;

/// Positions and velocities of the boom and its load, for an angle and its rate.
fn turning(mechanism: &BoomCylinder<f64>, rate: f64) -> BoomState {
    let p = mechanism.parameters();
    let mut at = mechanism.declared_start();
    let (sin, cos) = p.phi0.sin_cos();
    (at.q.x_l, at.q.y_l) = (p.boom_length * cos, p.boom_length * sin);
    (at.v.x_l, at.v.y_l) = (-p.boom_length * sin * rate, p.boom_length * cos * rate);
    (at.q.x_b, at.q.y_b) = (0.5 * at.q.x_l, 0.5 * at.q.y_l);
    (at.v.x_b, at.v.y_b) = (0.5 * at.v.x_l, 0.5 * at.v.y_l);
    at.v.phi = rate;
    at
}

/// Its pressures bear the weights from the start on, so that nothing moves but by rounding.
#[test]
fn boom_rests_on_its_oil() -> Result<(), Error> {
    for (load_mass, phi0) in [(800.0, 0.26), (2000.0, 0.6)] {
        let p = BoomCylinderParameters { plan: 0.0, load_mass, phi0, ..Default::default() };
        let at_start = boom(&p, phi0);
        let start = |step| Simulation::new(BoomCylinder::new(p)?, step);
        through_fused_path("boom at rest", 0.5e-3, start, |case, run| {
            run.advance_to(1.0)?;
            let now = run.now()?;
            case.near("angle", now.q.phi, phi0, EXACT);
            let moment = now.outputs.piston_force * at_start.length[1];
            case.near("moment", moment, at_start.moment[0], EXACT * at_start.moment[0]);
            let [below, above] = [now.v.p_a, now.v.p_b];
            let push = at_start.areas[0] * below - at_start.areas[1] * above;
            case.near("push", push, now.outputs.piston_force, EXACT * push);
            case.near("above", above, p.above, p.above * EXACT);
            Ok(())
        })?;
    }
    Ok(())
}

/// A push of 10⁻⁴ rad/s makes 2·10⁻⁶ rad, of which the law bends 10⁻¹⁰ away. Rounding of an angle moves a moment by
/// 10⁻¹² s.
#[test]
fn boom_bounces_with_its_hydraulic_frequency() -> Result<(), Error> {
    let p = BoomCylinderParameters { plan: 0.0, viscous: 0.0, ..Default::default() };
    let Boom { length: [_, s1, s2], moment: [g0, g1], inertia, areas, volumes } = boom(&p, p.phi0);
    let oil = p.modulus * (areas[0].powi(2) / volumes[0] + areas[1].powi(2) / volumes[1]);
    let omega = ((oil * s1 * s1 - g0 / s1 * s2 + g1) / inertia).sqrt();
    near("frequency in Hz", omega / TAU, 8.9916, 1e-4);
    let mechanism = BoomCylinder::new(p)?;
    let mut run = to_tolerance(mechanism, 1e-12).from_state(turning(&mechanism, 1e-4)).build()?;
    for period in 1..=5 {
        let event = run.advance_until(1.0, [Direction::Rising], |at| [at.q.phi - p.phi0])?.unwrap();
        near("period", event.t / f64::from(period), TAU / omega, 1e-10 * TAU / omega);
    }
    Ok(())
}

/// With the valve shut p + E ln V of each chamber stays what it is, however far the boom swings: pressures of 100 bar to
/// rounding of E ln V and to the error of 300 steps.
#[test]
fn boom_keeps_its_oil() -> Result<(), Error> {
    let p = BoomCylinderParameters { plan: 0.0, ..Default::default() };
    let mechanism = BoomCylinder::new(p)?;
    let kept = |at: &BoomState| {
        let volumes = boom(&p, at.q.phi).volumes.map(f64::ln);
        [at.v.p_a + p.modulus * volumes[0], at.v.p_b + p.modulus * volumes[1]]
    };
    let mut run = to_tolerance(mechanism, 1e-12).from_state(turning(&mechanism, 0.05)).build()?;
    let (from, mut highest) = (kept(&run.state()), 0.0_f64);
    for k in 1..=100 {
        run.advance_to(0.01 * f64::from(k))?;
        let at = run.state();
        kept(&at).into_iter().zip(from).for_each(|(now, from)| near("oil", now, from, 1e-2));
        highest = highest.max(at.v.p_a);
    }
    assert!((80e5..100e5).contains(&highest), "{highest}");
    Ok(())
}

/// The motion by hand at instants, to the roundings of forces of 50 kN and of pressures times the oil's stiffness. While it lifts, the pressures balance
/// the flows of the open valve and so give its speed: to 0.1 %, since the load still changes, and the flow is
/// laminar in part.
#[test]
fn boom_is_lifted_by_its_valve() -> Result<(), Error> {
    const NOMINAL: f64 = 35e5;
    let p: BoomCylinderParameters<f64> = BoomCylinderParameters::default();
    let root = |over: f64| over / (over * over + (2.0_f64 / 35.0).powi(2)).powf(0.25);
    let plan =
        [(0.0, 0.0), (0.2, 0.0), (0.5, 0.6), (2.5, 0.6), (2.7, 0.0), (3.5, 0.0), (3.8, -0.4), (6.0, -0.4)];
    let mut run = to_tolerance(BoomCylinder::declared(), 1e-12).build()?;
    for t in [0.1, 0.3, 0.45, 0.7, 1.5, 2.3, 2.6, 3.0, 3.6, 3.9, 5.0] {
        run.advance_to(t)?;
        let at = run.state();
        let (a, outputs) = found(run.mechanism(), &at, run.inputs());
        let Boom { length: [_, s1, _], moment: [weight, _], inertia, areas, volumes } = boom(&p, at.q.phi);
        let piece = plan.windows(2).rfind(|pair| pair[0].0 <= at.t).unwrap();
        let [(from, low), (to, high)] = [piece[0], piece[1]];
        let u = low + (high - low) * (at.t - from) / (to - from);
        let [below, above] = [at.v.p_a, at.v.p_b];
        let over =
            if u > 0.0 { [p.supply - below, above - p.tank] } else { [below - p.tank, p.supply - above] };
        let flows = over.map(|over| p.nominal_flow * u * root(over / NOMINAL));
        let speed = s1 * at.v.phi;
        near("ṗ below", a.p_a, p.modulus / volumes[0] * (flows[0] - areas[0] * speed), 1e-5);
        near("ṗ above", a.p_b, p.modulus / volumes[1] * (areas[1] * speed - flows[1]), 1e-5);
        let push = areas[0] * below - areas[1] * above;
        near("φ̈", a.phi, ((push - p.viscous * speed) * s1 - weight) / inertia, EXACT);
        near("force", outputs.piston_force, push - p.viscous * speed, 1e-9);
        if (1.0..2.4).contains(&t) {
            let cubes = areas[0].powi(3) + areas[1].powi(3);
            let left = areas[0] * p.supply - areas[1] * p.tank - push;
            near("lifting", outputs.piston_speed, u * p.nominal_flow * (left / NOMINAL / cubes).sqrt(), 2e-4);
        }
    }
    Ok(())
}
