//! Where a mechanism is linearized.

use mbs_runtime::equations::Equations;
use mbs_runtime::{Info, System};
use nalgebra::DVector;

use crate::tangent::Rest;
use crate::{Error, Variable};

/// A state is on its constraints if a correction that leads there is shorter than this share of the
/// scales. A run with feedback stays nearer than that, and what is found differs by such a share.
const NEAR: f64 = 1e-5;

/// The behaviour of drives while a mechanism moves away from an operating point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drives {
    /// They stand still where they are at that time, Φ_t = 0 and Φ_tt = 0: the mechanism is at rest.
    Held,
    /// They move on: what is linearized is the deviation from the motion through the point.
    Moving,
}

/// The state, the inputs and the time about which a mechanism is linearized. See the example of
/// [`linearize`](crate::linearize).
#[derive(Clone, Debug, PartialEq)]
pub struct OperatingPoint {
    /// The time in s.
    pub t: f64,
    /// Positions, with Φ = 0.
    pub q: Vec<f64>,
    /// Velocities, with Φ̇ = 0.
    pub v: Vec<f64>,
    /// The inputs.
    pub inputs: Vec<f64>,
    /// Drives stand still or move on.
    pub drives: Drives,
}

impl OperatingPoint {
    /// A position at rest with drives held, an equilibrium or not. See the example of
    /// [`linearize`](crate::linearize).
    pub fn at_rest(t: f64, q: &[f64], inputs: &[f64]) -> Self {
        let v = vec![0.0; q.len()];
        Self { t, q: q.to_vec(), v, inputs: inputs.to_vec(), drives: Drives::Held }
    }

    /// The same, with the values of own states behind the positions, as those of a [`Search`](crate::Search) and of an
    /// [`Equilibrium`](crate::Equilibrium) are.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::{OperatingPoint, Variable};
    /// # use mbs_runtime::{Mechanism, mechanism};
    ///
    /// mechanism! {
    ///     pub Coil {
    ///         dof = 1;
    ///         body anchor (x) { mass = 1 [kg]; }
    ///         state current [A];
    ///         der(current) = -2 [1/s]*current;
    ///         force pull on x = 3 [N/A]*current - 5 [N/m]*x;
    ///     }
    /// }
    ///
    /// let point = OperatingPoint::resting(<Coil as Mechanism>::INFO, 0.0, &[0.1, 2.0], &[]);
    /// assert_eq!((&point.q[..], &point.v[..]), (&[0.1, 0.0][..], &[0.0, 2.0][..]));
    /// assert_eq!(point.value(Variable::Velocity(1), &[]), 2.0);
    /// ```
    pub fn resting(info: &Info, t: f64, q: &[f64], inputs: &[f64]) -> Self {
        Self::split(t, q, info.lines, inputs)
    }

    pub(crate) fn split(t: f64, q: &[f64], lines: usize, inputs: &[f64]) -> Self {
        let (positions, states) = q.split_at(lines.min(q.len()));
        let mut point = Self::at_rest(t, positions, inputs);
        point.q.resize(q.len(), 0.0);
        point.v.extend_from_slice(states);
        point
    }

    /// A state in motion, in which drives move on.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::{OperatingPoint, Ports, linearize};
    /// use mbs_runtime::mechanism;
    ///
    /// mechanism! {
    ///     pub Boat {
    ///         dof = 1;
    ///         body boat (x) { mass = 1 [kg]; }
    ///         force water on x = -3 [kg/m]*der(x)^2;
    ///     }
    /// }
    ///
    /// let point = OperatingPoint::in_motion(0.0, &[0.0], &[2.0], &[]);
    /// let linear = linearize(&Boat::declared(), &point, &Ports::default())?;
    /// // v̇ = −3 v², ∂v̇/∂v = −6 v
    /// assert!((linear.rate[1] + 12.0).abs() < 1e-9 && (linear.a[(1, 1)] + 12.0).abs() < 1e-9);
    /// # Ok::<(), mbs_analysis::Error>(())
    /// ```
    pub fn in_motion(t: f64, q: &[f64], v: &[f64], inputs: &[f64]) -> Self {
        Self { t, q: q.to_vec(), v: v.to_vec(), inputs: inputs.to_vec(), drives: Drives::Moving }
    }

    /// The present state of a run, in motion.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::{OperatingPoint, Variable};
    /// use mbs_runtime::{Simulation, mechanism};
    ///
    /// mechanism! {
    ///     pub Fall {
    ///         dof = 1;
    ///         gravity = (0, -9.81) [m/s^2];
    ///         body ball (y) { mass = 1 [kg]; }
    ///     }
    /// }
    ///
    /// let mut run = Simulation::new(Fall::declared(), 1e-3)?;
    /// run.advance_to(0.5)?;
    /// let point = OperatingPoint::of_run(&run);
    /// assert_eq!(point.t, 0.5);
    /// assert!((point.value(Variable::Velocity(0), &[]) + 0.5 * 9.81).abs() < 1e-12);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    pub fn of_run(run: &dyn System) -> Self {
        let info = run.equations().info();
        let [mut q, mut v] = [(); 2].map(|()| vec![0.0; info.coordinates.len()]);
        let mut inputs = vec![0.0; info.inputs.len()];
        run.state(&mut q, &mut v);
        run.inputs(&mut inputs);
        Self { t: run.time(), q, v, inputs, drives: Drives::Moving }
    }

    /// The value of a state, an input or a parameter at the point; NaN for an output or a multiplier, which depend on
    /// accelerations. `parameters` are all parameters, in the order of [`Info`](mbs_runtime::Info). See the example
    /// of [`of_run`](Self::of_run).
    pub fn value(&self, variable: Variable, parameters: &[f64]) -> f64 {
        let found = match variable {
            Variable::Coordinate(at) => self.q.get(at),
            Variable::Velocity(at) => self.v.get(at),
            Variable::Input(at) => self.inputs.get(at),
            Variable::Parameter(at) => parameters.get(at),
            Variable::Output(_) | Variable::Multiplier(_) => None,
        };
        found.copied().unwrap_or(f64::NAN)
    }

    /// Refuses vectors of other lengths, and a state that the constraints do not allow.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::OffConstraints`].
    pub(crate) fn check(&self, mechanism: &dyn Equations<f64>) -> Result<(), Error> {
        let info = mechanism.info();
        let n = info.coordinates.len();
        for (what, list, expected) in [
            ("positions", &self.q, n),
            ("velocities", &self.v, n),
            ("inputs", &self.inputs, info.inputs.len()),
        ] {
            if list.len() != expected {
                return Err(Error::Length { what, found: list.len(), expected });
            }
        }
        let rest = self.rest(mechanism);
        let (q, v) = (DVector::from_column_slice(&self.q), DVector::from_column_slice(&self.v));
        let phi = rest.violation(&q);
        let rate = match self.drives {
            Drives::Held => rest.along(&q, &v),
            Drives::Moving => rest.violation_rate(&q, &v),
        };
        // as fast as it moves, or a scale in a second
        let speeds = v.component_div(&rest.scales());
        let speed =
            speeds.rows(0, info.lines).iter().fold(1.0, |largest: f64, speed| largest.max(speed.abs()));
        for (violation, allowed, is_rate) in [(phi, NEAR, false), (rate, NEAR * speed, true)] {
            let distance = rest.correction(&q, &violation).component_div(&rest.scales()).amax();
            // what is no number is not near either
            if distance.is_nan() || distance > allowed {
                let row = violation.iamax();
                let constraint = info.constraints.get(row).map_or("", |constraint| constraint.name);
                let violation = violation.get(row).map_or(f64::NAN, |violation| violation.abs());
                return Err(Error::OffConstraints { constraint, is_rate, violation });
            }
        }
        Ok(())
    }

    /// The mechanism at this position and time.
    pub(crate) fn rest<'a>(&'a self, mechanism: &'a dyn Equations<f64>) -> Rest<'a> {
        Rest::new(mechanism, self.t, &self.inputs, &self.q)
    }
}
