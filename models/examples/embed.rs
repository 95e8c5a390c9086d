//! A control loop around a compiled mechanism, as firmware would run it: a PI
//! controller keeps the crank of a slider-crank at its speed against the
//! pulsating inertia of rod and slider. Nothing here allocates but the report.
//!
//! `cargo run --release --example embed`

use mbs_runtime::{Error, Simulation};
use models::SliderCrankFree;

/// Controller and plant run at 2 kHz.
const STEP: f64 = 0.5e-3;
const TARGET: f64 = 250.0 * core::f64::consts::PI / 30.0;

/// A proportional-integral controller with a limited output.
struct SpeedController {
    proportional: f64,
    integral: f64,
    limit: f64,
    sum: f64,
}

impl SpeedController {
    /// The torque for a speed error in rad/s; the sum stops at the limit.
    fn torque(&mut self, error: f64) -> f64 {
        let sum = self.sum + error * STEP;
        let torque = self.proportional * error + self.integral * sum;
        if torque.abs() < self.limit {
            self.sum = sum;
        }
        torque.clamp(-self.limit, self.limit)
    }
}

fn main() -> Result<(), Error> {
    let mut plant = Simulation::new(SliderCrankFree::declared(), STEP)?;
    let mut controller = SpeedController { proportional: 4.0, integral: 40.0, limit: 20.0, sum: 0.0 };

    println!("  time    speed   torque   violation");
    println!("     s      rpm      N·m           m");
    for tick in 0..=2000 {
        let speed = plant.state().v.theta1;
        plant.inputs_mut().crank_torque = controller.torque(TARGET - speed);
        if tick % 200 == 0 {
            let rpm = plant.outputs()?.crank_speed * 30.0 / core::f64::consts::PI;
            let torque = plant.inputs().crank_torque;
            println!("{:6.2} {rpm:8.2} {torque:8.3}   {:9.1e}", plant.time(), plant.violation());
        }
        plant.step()?;
    }
    Ok(())
}
