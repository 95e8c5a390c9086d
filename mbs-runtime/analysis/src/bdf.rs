//! Backward differentiation formulas of variable order and step, by the crate diffsol.
//!
//! The solver is the kernel of a run with a constant step. So starts, inputs, projection and errors are
//! those of other runs. The feature `bdf` is off by default. It takes three minutes of a core to compile,
//! most of it a library of linear algebra that diffsol names and nobody calls here.

use std::cell::RefCell;
use std::collections::VecDeque;

use diffsol::error::DiffsolError;
use diffsol::{
    BdfState, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquationsImplicit, OdeSolverMethod,
    OdeSolverProblem, Vector,
};
use mbs_runtime::equations::{Watch, cause, reach};
use mbs_runtime::explicit::project;
use mbs_runtime::{
    ConstantStep, ConstantStepBuilder, Dynamics, Effort, Error, Heun, Info, Kernel, Moment, Tolerances,
};
use nalgebra::DMatrix;

use crate::FirstOrder;

/// A mechanism being integrated to a tolerance by backward differentiation formulas (BDF) of order 1
/// to 5, for stiff dampers, controllers and contacts; see the page [`ode_crates`](crate::ode_crates)
/// for when to take it.
///
/// A step of the run is the time between two samples. The solver takes steps of its own, as long as
/// the tolerances permit, and starts anew where inputs change. Samples are interpolated between them
/// and projected onto the constraints.
///
/// # Example
/// ```
/// use mbs_analysis::{Bdf, BdfSteps, FirstOrder};
/// use mbs_runtime::equations::Differentiated;
/// use mbs_runtime::{System, Tolerances, mechanism};
///
/// mechanism! {
///     /// A weight that sinks in grease.
///     pub Sinking {
///         dof = 1;
///         gravity = (0, -9.81) [m/s^2];
///         body weight (y) { mass = 1 [kg]; }
///         force grease on y = -1e6 [N*s/m]*der(y);
///         start { y = 0; }
///     }
/// }
///
/// let weight = Sinking::declared();
/// let system = FirstOrder::new(Differentiated(weight))?;
/// let mut run = BdfSteps::builder(weight, system, Tolerances::default(), 0.1).build()?;
/// run.advance_to(1.0)?;
/// assert!((run.state().v.y + 9.81e-6).abs() < 1e-9);
/// // an explicit method would need 300 000 steps
/// assert!(run.effort().is_some_and(|effort| effort.steps < 1000));
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
pub type Bdf<D> = ConstantStep<D, BdfSteps>;

/// The solver between two samples of a [`Bdf`] run.
#[derive(Clone)]
pub struct BdfSteps {
    system: FirstOrder,
    tolerances: Tolerances,
    /// Where the solver is, and the differences of the steps before; nothing at a start.
    history: Option<BdfState<NalgebraVec<f64>>>,
    /// y of the samples that its last steps passed.
    ahead: VecDeque<Vec<f64>>,
    /// So many steps a solver takes at least.
    eager: u32,
    effort: Effort,
    /// Why it could not go on.
    failure: Option<Error>,
}

/// Where the solver could not go on, and how long a step was that it tried.
struct Stuck {
    t: f64,
    y: Vec<f64>,
    step: f64,
}

/// So many samples are kept, however many a long step passes.
const MOST_AHEAD: usize = 10_000;
/// So many steps the first solver takes at least; after a change of inputs, of which more may follow,
/// it is one.
const EAGER: u32 = 1024;
/// Newton's method of a step ends with this share of the tolerance. The share 0.2 of diffsol lets
/// stiff forces do work by what is left of it.
const NEWTON: f64 = 0.02;
/// Where the solver is stuck, the mechanism is looked at over this share of the time between samples.
const EXAMINED: f64 = 1e-3;

type Matrix = NalgebraMat<f64>;
type Lu = NalgebraLU<f64>;

impl BdfSteps {
    /// Choices to make before a run starts: `system` has the equations of `mechanism` over duals, and
    /// a sample is due every `interval` seconds.
    ///
    /// Of the tolerances those of the error count; `max_step` and `first_step` are the solver's own.
    pub fn builder<D: Dynamics<Real = f64>>(
        mechanism: D,
        system: FirstOrder,
        tolerances: Tolerances,
        interval: f64,
    ) -> ConstantStepBuilder<D, Self> {
        let (ahead, effort) = (VecDeque::new(), Effort::default());
        ConstantStepBuilder::new(
            mechanism,
            interval,
            Self { system, tolerances, history: None, ahead, eager: EAGER, effort, failure: None },
        )
    }

    /// Lets the solver take steps from where it is, or from y at `t`, until it passes `t_next`, and
    /// keeps the samples that lie behind it, `interval` apart.
    ///
    /// The solver borrows its problem, so both live as long as this call. A new solver has to find the
    /// Jacobian and the length of its steps again, which may take it many short steps; so each is
    /// used for twice as many steps as the one before. Where inputs change, what lies ahead is for
    /// nothing.
    fn run_on(&mut self, t: f64, y: &[f64], [t_next, interval]: [f64; 2]) -> Result<(), Stuck> {
        let Self { system, tolerances, history, ahead, eager, effort, .. } = self;
        let at_start = |_| Stuck { t, y: y.to_vec(), step: interval };
        let problem = problem(system, tolerances, t, y.to_vec()).map_err(at_start)?;
        let state = match history.take() {
            Some(state) => state,
            None => problem.bdf_state::<Lu>().map_err(at_start)?,
        };
        let mut solver = problem.bdf_solver::<Lu>(state).map_err(at_start)?;
        let mut taken = 0;
        loop {
            // the formula holds for the last steps alone, so samples are taken after each
            let mut sample = t_next + ahead.len() as f64 * interval;
            while sample <= solver.state().t && ahead.len() < MOST_AHEAD {
                ahead.push_back(solver.interpolate(sample).map_err(at_start)?.clone_as_vec());
                sample = t_next + ahead.len() as f64 * interval;
            }
            if !ahead.is_empty() && (taken >= *eager || ahead.len() >= MOST_AHEAD) {
                break;
            }
            let (before, step) = (solver.state().t, solver.state().h);
            if solver.step().is_err() {
                if !ahead.is_empty() {
                    // the next call will be told
                    break;
                }
                return Err(Stuck { t: before, y: solver.state().y.clone_as_vec(), step });
            }
            taken += 1;
            effort.count(solver.state().t - before);
        }
        let statistics = solver.get_statistics();
        let rejected = statistics.number_of_error_test_failures + statistics.number_of_nonlinear_solver_fails;
        effort.rejected += rejected as u64;
        *eager = eager.saturating_mul(2);
        *history = Some(solver.into_state());
        Ok(())
    }

    /// Why the solver is stuck: what short explicit steps from there say (longer ones would fail by
    /// the stiff forces), constraints that cannot be met a sample later, or else that no step of its
    /// own is short enough.
    fn cause<D: Dynamics<Real = f64>>(
        &self,
        stuck: &Stuck,
        dynamics: &D,
        inputs: &D::Inputs,
        interval: f64,
        moment: &mut Moment<f64, D::States>,
    ) -> Error {
        let Stuck { t, ref y, step } = *stuck;
        put(moment, t, y);
        let (now, mut inputs) = (moment.clone(), inputs.clone());
        let watch = Watch::new(f64::INFINITY);
        let found = cause::<D, Heun>(dynamics, &mut inputs, &now, moment, watch, EXAMINED * interval);
        let [q, _] = self.system.completed(t, y);
        let later = dynamics.with_inputs(&mut inputs, |inputs| {
            dynamics.with_room::<Heun>(|room| {
                reach(dynamics.equations(), t + interval, &q, inputs, interval, room)
            })
        });
        found.or(later.err()).unwrap_or(Error::StepTooShort { t, step })
    }
}

/// Writes y at `t` into a moment.
fn put<V: AsMut<[f64]>>(moment: &mut Moment<f64, V>, t: f64, y: &[f64]) {
    let Moment { t: own, q, v, .. } = moment;
    *own = t;
    for (at, y) in q.as_mut().iter_mut().chain(v.as_mut()).zip(y) {
        *at = *y;
    }
}

/// The problem that diffsol solves, from y at `t` on. It asks for products of the Jacobian with one
/// vector after the other at the same place, where the matrix is found once.
#[allow(clippy::type_complexity, reason = "an opaque type has no shorter name")]
fn problem(
    system: &FirstOrder,
    tolerances: &Tolerances,
    t: f64,
    y: Vec<f64>,
) -> Result<
    OdeSolverProblem<
        impl OdeEquationsImplicit<
            M = NalgebraMat<f64>,
            V = NalgebraVec<f64>,
            T = f64,
            C = <NalgebraMat<f64> as diffsol::MatrixCommon>::C,
        > + use<>,
    >,
    DiffsolError,
> {
    let (n, of_values, of_slopes) = (system.dimension(), system.clone(), system.clone());
    let found = RefCell::new((f64::NAN, Vec::new(), DMatrix::zeros(n, n)));
    let product = move |y: &[f64], _: &[f64], t: f64, x: &[f64], product: &mut [f64]| {
        let (at, place, jacobian) = &mut *found.borrow_mut();
        if *at != t || place != y {
            of_slopes.jacobian(t, y, jacobian);
            (*at, *place) = (t, y.to_vec());
        }
        for (product, row) in product.iter_mut().zip(jacobian.row_iter()) {
            *product = row.iter().zip(x).map(|(entry, x)| entry * x).sum();
        }
    };
    let mut problem = OdeBuilder::<Matrix>::new()
        .t0(t)
        .rtol(tolerances.rtol)
        .atol(vec![tolerances.atol; n])
        .rhs_implicit(move |y, _, t, slope| of_values.derivative(t, y, slope), product)
        .init(move |_, _, start| start.copy_from_slice(&y), n)
        .build()?;
    problem.ode_options.nonlinear_solver_tolerance = NEWTON;
    // they are counted over a run, in which a stiff direction that turns causes many
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    Ok(problem)
}

impl<D: Dynamics<Real = f64>> Kernel<D> for BdfSteps {
    fn word(&self) -> &'static str {
        "bdf"
    }

    fn check(&self, _: &Info) -> Result<(), Error> {
        self.tolerances.check::<f64>()
    }

    fn accelerate(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        _: f64,
        moment: &mut Moment<f64, D::States>,
    ) -> f64 {
        dynamics.with_inputs(&mut inputs.clone(), |inputs| {
            let own = self.system.inputs_mut();
            if own != inputs {
                own.iter_mut().zip(inputs).for_each(|(own, input)| *own = *input);
                let is_begun = self.history.is_some();
                (self.history, self.failure, self.eager) = (None, None, if is_begun { 1 } else { EAGER });
                self.ahead.clear();
            }
        });
        let Moment { t, q, v, a } = moment;
        dynamics.acceleration(*t, q, v, inputs, a)
    }

    fn step(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        interval: f64,
        t_next: f64,
        moment: &mut Moment<f64, D::States>,
    ) -> Option<f64> {
        if self.ahead.is_empty() {
            let y = [moment.q.as_ref(), moment.v.as_ref()].concat();
            if let Err(stuck) = self.run_on(moment.t, &y, [t_next, interval]) {
                self.failure = Some(self.cause(&stuck, dynamics, inputs, interval, moment));
                return None;
            }
        }
        put(moment, t_next, &self.ahead.pop_front()?);
        let Moment { q, v, a, .. } = moment;
        let growth = project(q, v, a, |at, delta| dynamics.correction(t_next, &at, delta));
        Some(growth + dynamics.acceleration(t_next, q, v, inputs, a))
    }

    fn failure(&self) -> Option<Error> {
        self.failure
    }

    fn effort(&self) -> Option<Effort> {
        Some(self.effort)
    }
}
