//! Constant steps of explicit schemes, whose stages see the inputs of their own times.
//!
//! A table gives inputs over time (`signals.rs`). Schemes with constant steps see them by these stages.

use mbs_runtime::equations::{self, At, Room, Watch};
use mbs_runtime::{Baumgarte, Dynamics, Error, Explicit, Held, Info, Kernel, Moment, Projected};

use crate::settings::Start;

/// Steps of a scheme stage by stage: what a step of a [`Simulation`](mbs_runtime::Simulation) is, whose fused
/// program has the inputs of its start.
#[derive(Clone)]
pub(crate) struct Stages {
    method: Explicit,
    /// α and β in 1/s
    gains: [f64; 2],
    step: f64,
    allow_unstable: bool,
    watch: Watch<f64>,
    /// The start of a step.
    from: [Vec<f64>; 2],
    room: Vec<f64>,
    failure: Option<Error>,
}

impl Stages {
    /// With the method, the gains and the step of a start.
    pub fn new(start: &Start) -> Self {
        let Start { method, alpha, beta, step, allow_unstable, .. } = *start;
        Self {
            method,
            gains: [alpha, beta],
            step,
            allow_unstable,
            // the run watches redundant constraints
            watch: Watch::new(f64::INFINITY),
            from: [Vec::new(), Vec::new()],
            room: Vec::new(),
            failure: None,
        }
    }

    fn keeps_constraints(&self) -> bool {
        self.method.is_stable(self.gains, self.step)
    }
}

impl<D: Dynamics<Real = f64>> Kernel<D> for Stages {
    fn word(&self) -> &'static str {
        self.method.tableau.word
    }

    fn check(&self, _: &Info) -> Result<(), Error> {
        let [alpha, beta] = self.gains;
        Baumgarte::<Held>::new(alpha, beta)?;
        if self.method.is_projected() {
            Baumgarte::<Projected>::new(alpha, beta)?;
        }
        if self.allow_unstable || self.keeps_constraints() {
            return Ok(());
        }
        let feedback = self.method.stabilization.word();
        Err(Error::UnstableGains { alpha, beta, step: self.step, feedback })
    }

    fn step(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        h: f64,
        t_next: f64,
        moment: &mut Moment<f64, D::States>,
    ) -> Option<f64> {
        let keeps_constraints = self.keeps_constraints();
        let Self { method, gains: [alpha, beta], watch, from: [q, v], room, failure, .. } = self;
        let equations = dynamics.equations();
        room.resize(Room::<f64>::len(equations.info(), method.tableau.stage_count()), 0.0);
        let mut room = Room::within(room, equations.info());
        for (from, now) in [(&mut *q, moment.q.as_ref()), (&mut *v, moment.v.as_ref())] {
            from.clear();
            from.extend_from_slice(now);
        }
        let gains = Baumgarte::<Held>::new(*alpha, *beta).ok()?.gains();
        let next = [moment.q.as_mut(), moment.v.as_mut()];
        let taken = dynamics.with_inputs(&mut inputs.clone(), |inputs| {
            let at = At { t: moment.t, q, v };
            let (step, method) = (h, *method);
            let run = equations::Run { equations, at, inputs, gains, step, method, keeps_constraints };
            run.step(t_next, next, watch, &mut room)
        });
        moment.t = t_next;
        *failure = taken.err();
        taken.ok()
    }

    fn failure(&self) -> Option<Error> {
        self.failure
    }
}
