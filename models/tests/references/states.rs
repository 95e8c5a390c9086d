//! Mechanisms with states of their own beside their motion.

use mbs_runtime::{Error, Simulation};
use models::{Brake, BrakeParameters};
use paths::through_double_paths;

use super::{found, near, to_tolerance};

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
    through_double_paths("brake without fade", step, start, |case, run| {
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
/// the table, where a step of it is off by h² times the jump of the acceleration's rate, 1 rad/s³: 4e-10 rad/s. And
/// the energy that is gone is stored or taken by the air, to 1e-12 of 740 kJ.
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

    let mut run = to_tolerance(Brake::declared()).build()?;
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
        near("speed", at.v.theta, by_hand[0], 1e-9);
        near("temperature", at.v.temperature, by_hand[1], 1e-8);
        let (_, outputs) = found(run.mechanism(), &at, run.inputs());
        near("friction", outputs.friction, coefficient(by_hand[1]), 1e-10);
        let gone = energy - 0.5 * p.inertia * at.v.theta * at.v.theta;
        near("heat", outputs.stored + at.v.taken, gone, 1e-12 * energy);
    }
    Ok(())
}
