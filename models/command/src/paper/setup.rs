//! The runs of the paper: what they are made with, and what is recorded.

use mbs_live::Run;
use mbs_runtime::{Error, Explicit, System};

use super::crank::{Crank, PER_STAGE, Parameters};

/// The paper's step, 0.5 ms.
pub const STEP: f64 = 0.5e-3;
/// One turn at 200 rpm, in s.
pub const TURN: f64 = 0.3;
/// The speeds of Table 3 in rpm.
pub const SPEEDS: [f64; 5] = [100.0, 150.0, 200.0, 250.0, 300.0];
/// End of the torque runs in s.
pub const TORQUE_END: f64 = 1.2;
/// When the transient of the torque is over, in s (§5.3 of the paper).
pub const STEADY: f64 = 0.1;

/// The moment of inertia of crank and linkage about their centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inertia {
    /// m l²/12: a slender rod about its centre, as it should be.
    Rod,
    /// m l²/3: the rod about its end, with which the paper's Table 3 comes out.
    Paper,
}

impl Inertia {
    /// J / (m l²)
    pub fn factor(self) -> f64 {
        match self {
            Self::Rod => 1.0 / 12.0,
            Self::Paper => 1.0 / 3.0,
        }
    }

    /// Its name in the keys of the results.
    pub fn key(self) -> &'static str {
        match self {
            Self::Rod => "ml2_12",
            Self::Paper => "ml2_3",
        }
    }
}

/// A run of the driven slider-crank.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Crank speed in rpm.
    pub rpm: f64,
    /// Which inertia.
    pub inertia: Inertia,
    /// α in 1/s.
    pub alpha: f64,
    /// β in 1/s.
    pub beta: f64,
    /// True if velocities start on Φ̇ = 0, instead of at 0 but for the crank's,
    /// as the paper has it.
    pub consistent: bool,
    /// End time in s.
    pub end: f64,
}

impl Setup {
    /// The paper's start at 200 rpm with these gains, over one turn.
    pub fn gains(alpha: f64, beta: f64) -> Self {
        Self { rpm: 200.0, inertia: Inertia::Rod, alpha, beta, consistent: false, end: TURN }
    }

    /// The same from a consistent start.
    pub fn consistent(self) -> Self {
        Self { consistent: true, ..self }
    }

    /// A torque run: the given speed and inertia, 1.2 s.
    pub fn torque(self, rpm: f64, inertia: Inertia) -> Self {
        Self { rpm, inertia, end: TORQUE_END, ..self }
    }

    /// The parameters of the mechanism.
    pub fn parameters(&self, crank: &Crank) -> Parameters {
        let omega = self.rpm * (std::f64::consts::PI / 30.0);
        Parameters { omega, inertia_factor: self.inertia.factor(), ..crank.parameters() }
    }

    fn run(&self, crank: &Crank, method: Explicit) -> Result<Run, Error> {
        let Parameters { omega, inertia_factor, .. } = self.parameters(crank);
        let mechanism = crank.with(&[("omega", omega), ("inertia_factor", inertia_factor)])?;
        // The paper's study goes beyond the stability limit on purpose.
        let builder = Run::builder(&mechanism, STEP).method(method).gains([self.alpha, self.beta]);
        let builder = builder.allow_unstable();
        if self.consistent { builder.build() } else { builder.as_declared().build() }
    }

    /// Everything about the run, up to its end or to the error that ends it.
    ///
    /// # Errors
    /// Only what keeps a run from starting; an error on the way is in [`Trace::ended`].
    pub fn trace(&self, crank: &Crank, method: Explicit) -> Result<Trace, Error> {
        let mut run = self.run(crank, method)?;
        let mut trace = Trace::default();
        let steps = run.steps_to(self.end)?;
        for taken in 0..=steps {
            let outcome = trace.append(&run, crank, self);
            let outcome = outcome.and_then(|()| if taken < steps { run.step() } else { Ok(()) });
            if let Err(error) = outcome {
                trace.ended = Some(error);
                break;
            }
        }
        Ok(trace)
    }

    /// max ‖Φ‖ over all steps up to a time, both ends included, with feedback in both stages.
    ///
    /// # Errors
    /// The error that kept the run from starting, or ended it.
    pub fn largest_violation(&self, crank: &Crank, end: f64) -> Result<f64, Error> {
        let mut run = self.run(crank, PER_STAGE)?;
        let mut largest = 0.0;
        for _ in 0..run.steps_to(end)? {
            largest = run.violations()[0].max(largest);
            run.step()?;
        }
        Ok(run.violations()[0].max(largest))
    }
}

/// A recorded run.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// Time in s.
    pub t: Vec<f64>,
    /// Coordinates x1, y1, θ1, x2, y2, θ2, x3.
    pub q: [Vec<f64>; 7],
    /// The analytical x3.
    pub exact_x3: Vec<f64>,
    /// |x3 − exact| / exact
    pub relative_x3: Vec<f64>,
    /// ‖Φ‖
    pub phi: Vec<f64>,
    /// ‖Φ̇‖
    pub phi_dot: Vec<f64>,
    /// −λ of the drive with the feedback terms in it, as the paper takes it.
    pub raw_torque: Vec<f64>,
    /// −λ of the drive without them.
    pub clean_torque: Vec<f64>,
    /// Why the run ended early, if it did.
    pub ended: Option<Error>,
}

impl Trace {
    fn append(&mut self, run: &Run, crank: &Crank, setup: &Setup) -> Result<(), Error> {
        let (mut q, mut v, mut acceleration) = ([0.0; 7], [0.0; 7], [0.0; 7]);
        let mut multipliers = vec![0.0; crank.mechanism.declared_info().constraints.len()];
        let torque = |solved: Result<(), Error>, multipliers: &[f64]| {
            solved.map(|()| -multipliers.get(crank.drive).copied().unwrap_or(f64::NAN))
        };
        run.state(&mut q, &mut v);
        let raw = run.raw_reactions(&mut acceleration, &mut multipliers);
        let raw = torque(raw, &multipliers)?;
        let clean = run.reactions(&mut acceleration, &mut multipliers);
        let clean = torque(clean, &multipliers)?;
        let (t, x3) = (run.time(), q[crank.x3]);
        let exact = exact_x3(&setup.parameters(crank), t);
        for (column, value) in self.q.iter_mut().zip(q) {
            column.push(value);
        }
        let [phi, phi_dot] = run.violations();
        self.t.push(t);
        self.exact_x3.push(exact);
        self.relative_x3.push(((x3 - exact) / exact).abs());
        self.phi.push(phi);
        self.phi_dot.push(phi_dot);
        self.raw_torque.push(raw);
        self.clean_torque.push(clean);
        Ok(())
    }

    /// The largest of a column, or the error that ended the run.
    ///
    /// # Errors
    /// [`Trace::ended`].
    pub fn largest(&self, column: &[f64]) -> Result<f64, Error> {
        self.ended.map_or(Ok(()), Err)?;
        Ok(column.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    }

    /// The largest of a column from [`STEADY`] on, or the error that ended the run.
    ///
    /// # Errors
    /// [`Trace::ended`].
    pub fn steady_peak(&self, column: &[f64]) -> Result<f64, Error> {
        // Half a step earlier, so that rounding of the time does not decide.
        let first = self.t.partition_point(|t| *t < STEADY - 0.5 * STEP);
        self.largest(column.get(first..).unwrap_or(&[]))
    }
}

/// x3 = l1 cos θ1 + l2 cos θ2 with θ1 = ωt and l1 sin θ1 + l2 sin θ2 = 0.
pub fn exact_x3(p: &Parameters, t: f64) -> f64 {
    let (s, c) = (p.omega * t).sin_cos();
    let sin2 = -p.l1 / p.l2 * s;
    p.l1 * c + p.l2 * (1.0 - sin2 * sin2).sqrt()
}
