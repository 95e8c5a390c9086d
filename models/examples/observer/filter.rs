//! An extended Kalman filter for the free slider-crank: from the position of the slider alone it finds angle and
//! speed of the crank. It needs no heap and no standard library.
//!
//! The state is z = (θ₁, θ̇₁), the two numbers that the mechanism is free in. All coordinates follow from them,
//! and a step of the solver leads from z to the next one. Both are functions that the compiler of mechanisms
//! made; computed over [`Dual`] they bring their exact Jacobians:
//!
//! ```text
//! H = ∂x₃/∂z    K = P Hᵀ/(H P Hᵀ + r)    z ← z + K (measured − x₃)    P ← (1 − K H) P
//! F = ∂(z after a step)/∂z                z ← z after a step            P ← F P Fᵀ + Q
//! ```
//!
//! # Source
//! D. Simon, Optimal State Estimation, Wiley 2006, section 13.2 (the discrete-time extended Kalman filter).

use mbs_runtime::{Components, Dual, Error, Mechanism, Real, Simulation, State, start};

use super::{SliderCrankFree, SliderCrankFreeCoordinates};

/// A number with its derivatives by θ₁ and θ̇₁.
type Derived = Dual<f64, 2>;
type Matrix = [[f64; 2]; 2];

/// A measurement.
pub struct Measured {
    /// The position of the slider in m.
    pub slider: f64,
    /// Its variance in m².
    pub variance: f64,
}

/// The filter with its estimate.
pub struct Observer {
    mechanism: SliderCrankFree<Derived>,
    step: f64,
    t: f64,
    /// All coordinates of the last estimate, from which the next assembly starts.
    near: SliderCrankFreeCoordinates<f64>,
    /// The estimates of θ₁ in rad and of θ̇₁ in rad/s.
    pub estimate: [f64; 2],
    /// The covariance of the estimates.
    pub covariance: Matrix,
    /// The growth of their variances in a step.
    pub noise: [f64; 2],
}

impl Observer {
    /// A filter with steps of so many seconds, a first estimate and its variances.
    ///
    /// # Errors
    /// Parameters that the mechanism refuses.
    pub fn new(
        plant: &SliderCrankFree,
        step: f64,
        estimate: [f64; 2],
        variances: [f64; 2],
    ) -> Result<Self, Error> {
        let near = plant.declared_start().q;
        let [angle, speed] = variances;
        Ok(Self {
            mechanism: SliderCrankFree::new(plant.parameters().over())?,
            step,
            t: 0.0,
            near,
            estimate,
            covariance: [[angle, 0.0], [0.0, speed]],
            noise: [0.0, 1e-3],
        })
    }

    /// Corrects the estimate by what is measured, and leads it over a step with this torque in N·m.
    ///
    /// # Errors
    /// Those of an assembly and of a step.
    pub fn tick(&mut self, measured: &Measured, torque: f64) -> Result<(), Error> {
        let here = self.state()?;
        let Dual { value: slider, partials: h } = here.q.x3;
        self.correct(h, measured.slider - slider, measured.variance);
        let here = self.state()?;
        let mut run = Simulation::builder(self.mechanism, self.step).from_state(here).build()?;
        run.inputs_mut().crank_torque = Derived::from_f64(torque);
        run.step()?;
        let next = run.state();
        self.predict([next.q.theta1, next.v.theta1]);
        self.near = next.q.over();
        self.t += self.step;
        Ok(())
    }

    /// All coordinates at the estimate, with their derivatives by it.
    fn state(&self) -> Result<State<SliderCrankFreeCoordinates<Derived>>, Error> {
        let [angle, speed] = self.estimate;
        let mut guess = self.mechanism.declared_start();
        guess.t = Derived::from_f64(self.t);
        guess.q = self.near.over();
        guess.q.theta1 = Derived::variable(angle, 0);
        guess.v.theta1 = Derived::variable(speed, 1);
        // the declared start prescribes θ₁ and its rate, so these are kept
        start::consistent(&self.mechanism, &guess)
    }

    fn correct(&mut self, h: [f64; 2], difference: f64, variance: f64) {
        let p = &self.covariance;
        let ph = [p[0][0] * h[0] + p[0][1] * h[1], p[1][0] * h[0] + p[1][1] * h[1]];
        let total = h[0] * ph[0] + h[1] * ph[1] + variance;
        let gain = [ph[0] / total, ph[1] / total];
        self.estimate = [self.estimate[0] + gain[0] * difference, self.estimate[1] + gain[1] * difference];
        self.covariance = [
            [p[0][0] - gain[0] * ph[0], p[0][1] - gain[0] * ph[1]],
            [p[1][0] - gain[1] * ph[0], p[1][1] - gain[1] * ph[1]],
        ];
    }

    fn predict(&mut self, next: [Derived; 2]) {
        let (f, p) = ([next[0].partials, next[1].partials], &self.covariance);
        let row = |f: [f64; 2]| [f[0] * p[0][0] + f[1] * p[1][0], f[0] * p[0][1] + f[1] * p[1][1]];
        let [a, b] = [row(f[0]), row(f[1])];
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let across = dot(a, f[1]);
        self.covariance = [[dot(a, f[0]) + self.noise[0], across], [across, dot(b, f[1]) + self.noise[1]]];
        self.estimate = [next[0].value, next[1].value];
    }
}
