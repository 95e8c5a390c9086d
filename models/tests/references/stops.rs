//! Impacts and modes: Newton's cradle, a drop hammer.

use mbs_runtime::{Error, Simulation};
use models::{DropHammer, DropHammerParameters, NewtonsCradle, NewtonsCradleInputs, NewtonsCradleParameters};

use super::{near, to_tolerance};

/// Half a swing to an angle, by the mean of Gauss.
fn half_swing(p: &NewtonsCradleParameters<f64>) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * p.lifted).cos());
    while a - b > 1e-15 {
        (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
    }
    let length = (p.length * p.length + 0.4 * p.radius * p.radius) / p.length;
    std::f64::consts::PI * (length / 9.81).sqrt() / a
}

/// The sums of the impulses between balls.
fn impulses(inputs: &NewtonsCradleInputs<f64>) -> [f64; 4] {
    [inputs.contact_2_impulse, inputs.contact_3_impulse, inputs.contact_4_impulse, inputs.contact_5_impulse]
}

/// The last ball is hit every second half swing, and gives all back. An impact of equal masses without loss has the
/// impulse m v of the reduced motion about the nails.
#[test]
fn newtons_cradle_passes_its_energy_on() -> Result<(), Error> {
    let p = NewtonsCradleParameters::default();
    let mut run = to_tolerance(NewtonsCradle::declared(), 1e-12).build()?;
    let energy = |run: &mbs_runtime::Adaptive<NewtonsCradle<f64>, mbs_runtime::Dop853>| {
        let state = run.state();
        run.mechanism().kinetic_energy(&state) + run.mechanism().potential_energy(&state)
    };
    let (begin, half) = (energy(&run), half_swing(&p));
    let (mut hits, mut last) = (Vec::new(), 0.0);
    while hits.len() < 6 {
        run.step()?;
        let [.., impulse] = impulses(run.inputs());
        if impulse > last {
            hits.push(run.time());
            last = impulse;
        }
    }
    // the play is passed at this speed, four times on the way there and four times on the way back, by balls that swing by
    // the play meanwhile
    let speed = p.length * (2.0 * 9.81 * (1.0 - p.lifted.cos()) / p.length).sqrt();
    let passing = 4.0 * p.play / speed;
    for pair in hits.windows(2) {
        near("half a swing", pair[1] - pair[0], half + passing, 1.5 * passing);
    }
    // of some 10⁵ roundings of 1 J
    near("energy", energy(&run), begin, 1e-11);
    // m v, with the part of a ball's own inertia
    let momentum = p.mass * speed * (1.0 + 0.4 * (p.radius / p.length).powi(2)).sqrt();
    near("impulse", last / 6.0, momentum, 0.01 * momentum);
    Ok(())
}

/// With a loss the balls come to swing together, so that no impact is left that is not of rounding.
#[test]
fn newtons_cradle_with_a_loss_swings_as_one() -> Result<(), Error> {
    let p = NewtonsCradleParameters { restitution: 0.7, ..NewtonsCradleParameters::default() };
    let mut run = Simulation::new(NewtonsCradle::new(p)?, 5e-4)?;
    run.advance_to(60.0)?;
    let state = run.state();
    let angles: [f64; 5] = [state.q.phi_1, state.q.phi_2, state.q.phi_3, state.q.phi_4, state.q.phi_5];
    let spread = angles.iter().fold(0.0_f64, |spread, angle| spread.max((angle - angles[0]).abs()));
    // all five within their plays, two in each pair, and a tenth of the swing of all
    assert!(spread < 8.0 * p.play / p.length, "{angles:?}");
    Ok(())
}

/// When the ram is let go after the rolls have gripped at their full speed, how high it comes and how hard it hits.
fn blow(p: &DropHammerParameters<f64>) -> [f64; 3] {
    let all = p.inertia + p.mass * p.radius * p.radius;
    let (gripped, carried) =
        (p.inertia / all * p.no_load, p.no_load * (1.0 - p.mass * 9.81 * p.radius / p.stall));
    let time = all * p.no_load / p.stall;
    let rate = |t: f64| carried + (gripped - carried) * (-t / time).exp();
    let lifted = |t: f64| p.radius * (carried * t + (gripped - carried) * time * (1.0 - (-t / time).exp()));
    let mut t = p.height / (p.radius * gripped);
    for _ in 0..20 {
        t -= (lifted(t) - p.height) / (p.radius * rate(t));
    }
    let speed = p.radius * rate(t);
    let top = p.height + speed * speed / (2.0 * 9.81);
    let fall = (2.0 * top / 9.81).sqrt();
    [t, t + speed / 9.81 + fall, (1.0 + p.restitution) * p.mass * 9.81 * fall]
}

/// Three blows, all alike: the motor is at its full speed again when the rolls grip.
#[test]
fn a_drop_hammer_hits_as_from_its_height() -> Result<(), Error> {
    let p = DropHammerParameters::default();
    let [release, hit, impulse] = blow(&p);
    let mut run = to_tolerance(DropHammer::declared(), 1e-11).build()?;
    for cycle in 0..3 {
        let grip = 0.5 + p.period * f64::from(cycle);
        run.advance_to(grip + 0.1)?;
        let (begin, before) = (run.inputs().gripped, run.inputs().anvil_impulse);
        assert_eq!(begin, 1.0);
        while run.inputs().gripped == 1.0 {
            run.step()?;
        }
        near("release", run.time() - grip, release, 1e-8);
        while run.inputs().anvil_impulse == before {
            run.step()?;
        }
        near("hit", run.time() - grip, hit, 1e-8);
        near("impulse", run.inputs().anvil_impulse - before, impulse, 1e-5);
    }
    // with constant steps release and blow are known to a step of 0.5 ms
    let mut steps = Simulation::new(DropHammer::declared(), 0.5e-3)?;
    while steps.inputs().anvil_impulse == 0.0 {
        steps.step()?;
    }
    near("hit in steps", steps.time() - 0.5, hit, 2e-3);
    near("impulse in steps", steps.inputs().anvil_impulse, impulse, 2e-3 * impulse);
    Ok(())
}
