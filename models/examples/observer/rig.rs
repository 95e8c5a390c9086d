//! A slider-crank on a test rig: the plant runs at 1 kHz, its slider is measured with an error, and a controller
//! holds the speed that the observer estimates. It needs no heap and no standard library.

use mbs_runtime::{Error, Simulation};

use super::SliderCrankFree;
use super::filter::{Measured, Observer};

/// Plant, observer and controller run at 1 kHz.
pub const STEP: f64 = 1e-3;
/// The speed that the controller is to hold, in rad/s.
pub const TARGET: f64 = 250.0 * core::f64::consts::PI / 30.0;

/// How far the measured position is off at most, in m; it is off by any amount below with equal probability.
const OFF: f64 = 0.2e-3;

/// The rig.
pub struct Rig {
    plant: Simulation<SliderCrankFree>,
    observer: Observer,
    /// State of the generator of errors.
    random: u64,
    /// The sum of the controller.
    sum: f64,
}

/// The rig at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    pub time: f64,
    /// Angle and speed of the crank, in rad and rad/s.
    pub truth: [f64; 2],
    /// The estimates of angle and speed.
    pub estimate: [f64; 2],
    /// The standard deviations that the observer gives them.
    pub deviation: [f64; 2],
    /// The torque on the crank, in N·m.
    pub torque: f64,
}

impl Rig {
    /// The plant at its declared start, and an observer that is told wrong: 20° and 50 rpm off.
    ///
    /// # Errors
    /// Those of a start.
    pub fn new() -> Result<Self, Error> {
        let plant = Simulation::new(SliderCrankFree::declared(), STEP)?;
        let wrong = [0.35, plant.state().v.theta1 - 5.2];
        let observer = Observer::new(plant.mechanism(), STEP, wrong, [0.1, 30.0])?;
        Ok(Self { plant, observer, random: 1, sum: 0.0 })
    }

    /// The rig now.
    pub fn seen(&self) -> Seen {
        let state = self.plant.state();
        let variance = self.observer.covariance;
        Seen {
            time: state.t,
            truth: [state.q.theta1, state.v.theta1],
            estimate: self.observer.estimate,
            deviation: [root(variance[0][0]), root(variance[1][1])],
            torque: self.plant.inputs().crank_torque,
        }
    }

    /// Measures, controls, and leads plant and observer on.
    ///
    /// # Errors
    /// Those of plant and observer.
    pub fn tick(&mut self) -> Result<(), Error> {
        let slider = self.plant.state().q.x3 + OFF * self.error();
        let torque = self.torque();
        self.plant.inputs_mut().crank_torque = torque;
        // of equal probability between ±OFF
        let measured = Measured { slider, variance: OFF * OFF / 3.0 };
        self.observer.tick(&measured, torque)?;
        self.plant.step()
    }

    /// A proportional-integral controller with limits, of the estimated speed.
    fn torque(&mut self) -> f64 {
        let error = TARGET - self.observer.estimate[1];
        let sum = self.sum + error * STEP;
        let torque = 2.0 * error + 20.0 * sum;
        if torque > -20.0 && torque < 20.0 {
            self.sum = sum;
        }
        torque.clamp(-20.0, 20.0)
    }

    /// Between −1 and 1, by a linear congruence.
    fn error(&mut self) -> f64 {
        self.random =
            self.random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.random >> 11) as f64) * (2.0 / (1_u64 << 53) as f64) - 1.0
    }
}

/// A root that rounding cannot make undefined.
fn root(x: f64) -> f64 {
    mbs_runtime::Real::sqrt(if x > 0.0 { x } else { 0.0 })
}
