//! A motor whose speed a sampled controller keeps: plant and controller in one declaration.

use mbs_runtime::{Error, Simulation, mechanism};

mechanism! {
    /// A motor with inductance under a PI controller at 1 kHz.
    pub SampledMotor {
        dof = 1;
        method = rk4;
        param resistance = 1 [ohm];
        param inductance = 0.5 [mH];
        param constant = 0.05 [N*m/A];
        param inertia = 1e-4 [kg*m^2];
        input target [rad/s] = 100;
        memory integral [rad] = 0;
        memory volts [V] = 0;
        state current [A] = 0;
        der(current) = (volts - resistance*current - constant*der(theta))/inductance;
        body rotor (theta) { inertia = inertia; }
        torque drive on rotor = constant*current;
        let off = target - der(theta);
        every 1 [ms] {
            set integral = integral + off*1 [ms];
            set volts = 0.1 [V*s]*off + 5 [V]*integral;
        }
    }
}

/// Time in s, speed in rad/s, current in A, voltage in V and the sum in rad, every 10 ms of 0.2 s, by steps of 0.1 ms.
///
/// # Errors
/// Those of a start and of a step.
pub fn run(mut seen: impl FnMut([f64; 5])) -> Result<(), Error> {
    let mut motor = Simulation::new(SampledMotor::declared(), 1e-4)?;
    for at in 0..=20 {
        motor.advance_to(1e-2 * f64::from(at))?;
        let (state, inputs) = (motor.state(), motor.inputs());
        seen([state.t, state.v.theta, state.v.current, inputs.volts, inputs.integral]);
    }
    Ok(())
}
