//! Mechanisms with gears.

use mbs_runtime::{Error, Simulation};
use models::{
    DcMotor, DcMotorInputs, DcMotorParameters, GearedMotor, GearedMotorInputs, GearedMotorParameters,
    PlanetaryGear, PlanetaryGearInputs,
};
use paths::{Instant, through_fused_path};

use super::{EXACT, near};

/// At an instant to rounding. Later Heun's error for the planet on its circle, a
/// relative (ωh)² of the arm's largest ω.
#[test]
fn planetary_gear_has_the_ratio_of_willis() -> Result<(), Error> {
    let mechanism = PlanetaryGear::declared();
    let p = *mechanism.parameters();
    let (rs, rp) = (p.sun_radius, p.planet_radius);
    let (a, share) = (rs + rp, rs / (2.0 * (rs + rp)));
    let inertia = p.sun_inertia
        + share.powi(2) * (p.arm_inertia + p.planet_mass * a * a + p.planet_inertia * (a / rp).powi(2));
    for (sun_torque, load) in [(0.0, 0.0), (0.02, 0.0), (0.02, -0.1), (0.0, 0.3)] {
        let inputs = PlanetaryGearInputs { sun_torque, load };
        let start = |step| Simulation::builder(mechanism, step).inputs(inputs).build();
        let simulation = start(1e-4)?;
        let v = simulation.state().v;
        near("arm", v.beta, share * p.speed, p.speed * EXACT);
        near("planet", v.psi, -a / rp * share * p.speed, p.speed * EXACT);
        let outputs = simulation.outputs()?;
        near("ratio", outputs.ratio, 2.0 * a / rs, 10.0 * EXACT);

        let sun = (sun_torque + share * load) / inertia;
        let planet = -a / rp * share * sun;
        let inner = (sun_torque - p.sun_inertia * sun) / rs;
        let outer = (p.planet_inertia * planet + rp * inner) / rp;
        let pin = p.planet_mass * a * (share * sun).hypot((share * p.speed).powi(2));
        // forces are of the size of 10 N, accelerations of 100 rad/s²
        let reactions = simulation.reactions()?;
        near("sun", reactions.acceleration.alpha, sun, 1e3 * EXACT);
        near("teeth of the sun", outputs.inner_force, inner, 1e2 * EXACT);
        near("teeth of the ring", outputs.outer_force, outer, 1e2 * EXACT);
        near("pin", outputs.pin_force, pin, 1e2 * EXACT);

        let end = p.speed + 0.1 * sun;
        let largest = end.abs().max(p.speed);
        through_fused_path("planetary gear", 1e-4, start, |case, run| {
            run.advance_to(0.1)?;
            let now = run.now()?;
            let truncation = largest * (share * largest * 1e-4).powi(2);
            // 1000 steps, each of which rounds
            let rounding = 1e3 * f64::EPSILON * largest;
            case.near_within("sun after 0.1 s", now.v.alpha, end, truncation, rounding);
            case.near_within("ratio", now.outputs.ratio, 2.0 * a / rs, 0.0, 1e3 * EXACT);
            Ok(())
        })?;
    }
    Ok(())
}

/// Heun's method multiplies ω − ω∞ by 1 − z + z²/2 in a step of z = h/τ, which
/// after n of them is off by n z³/6 exp(−(n − 1)z) at most, less than z²/12.
#[test]
fn geared_motor_runs_up() -> Result<(), Error> {
    let step = 1e-4;
    for (speed, load) in [(0.0_f64, 0.0), (30.0, 0.0), (0.0, 0.2)] {
        let p = GearedMotorParameters { speed, ..Default::default() };
        let inputs = GearedMotorInputs { load };
        let start = |step| Simulation::builder(GearedMotor::new(p)?, step).inputs(inputs).build();
        let n = p.pinion_radius / p.wheel_radius;
        let inertia = p.rotor_inertia + n * n * p.wheel_inertia;
        let damping = p.stall / p.no_load + n * n * p.viscous;
        // the wheel turns the other way
        let (torque, tau) = (p.stall - n * load, inertia / damping);
        let limit = torque / damping;
        let tolerance = (limit - speed).abs() * (step / tau).powi(2) / 12.0;
        through_fused_path("geared motor", step, start, |case, run| {
            for k in 0..20_u32 {
                let t = 0.05 * f64::from(k);
                run.advance_to(t)?;
                let omega = limit + (speed - limit) * (-t / tau).exp();
                // each step rounds; what those before the last τ left is forgotten
                let rounding = tau / step * f64::EPSILON * limit.max(speed);
                let Instant { v, outputs, .. } = run.now()?;
                case.near_within("motor", v.phi1, omega, tolerance, rounding);
                case.near_within("wheel", v.phi2, -n * omega, tolerance, rounding);
                let motor = p.stall * (1.0 - v.phi1 / p.no_load);
                let acceleration = (torque - damping * v.phi1) / inertia;
                let teeth = (motor - p.rotor_inertia * acceleration) / p.pinion_radius;
                // at an instant, forces of the size of 10 N
                case.near_within("teeth", outputs.tooth_force, teeth, 0.0, 1e2 * EXACT);
                case.near_within("power", outputs.motor_power, motor * v.phi1, 0.0, 1e2 * EXACT);
            }
            Ok(())
        })?;
    }
    Ok(())
}

/// At rest the current carries the load and the speed is the wanted one. The slowest root of
/// 5e-7 λ³ + 1e-4 λ² + 0.0125 λ + 0.25 = 0 is −24/s, so that e⁻⁴⁸ = 1e-21 of the deviation is left.
#[test]
fn dc_motor_holds_its_speed() -> Result<(), Error> {
    let p: DcMotorParameters<f64> = DcMotorParameters::default();
    let inputs = DcMotorInputs { load: -0.1 };
    let start = |step| Simulation::builder(DcMotor::declared(), step).inputs(inputs).build();
    through_fused_path("motor at its speed", 2e-4, start, |case, run| {
        run.advance_to(2.0)?;
        let now = run.now()?;
        case.near("speed", now.v.theta, p.wanted, p.wanted * EXACT);
        let current = -inputs.load / p.constant;
        case.near("current", now.v.current, current, current * EXACT);
        let voltage = p.resistance * current + p.constant * p.wanted;
        case.near("voltage", now.outputs.control, voltage, voltage * EXACT);
        Ok(())
    })
}
