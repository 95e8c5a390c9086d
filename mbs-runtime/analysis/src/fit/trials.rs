//! Runs with derivatives, of a mechanism whose parameters are tried.

use std::sync::Arc;

use mbs_runtime::equations::{Equations, Partials};
use mbs_runtime::{Adaptive, Dopri5, Dynamics, Error, Mechanism, Sampled, System, Tolerances};

use crate::family::components;
use crate::{Driven, InputTable};

/// A mechanism that can be run over [`Partials`] with any parameters, as a fit to data needs it.
///
/// [`trials_of_type`] makes one of a type. Every function from parameters over partials to
/// [`Dynamics`] is one.
///
/// # Example
/// Runs of a text:
/// ```
/// use mbs_analysis::Trials;
/// use mbs_live::{Live, Prepared};
/// use mbs_runtime::equations::Partials;
///
/// fn trials_of_text(live: &Live) -> impl Trials + use<> {
///     let over = live.over::<Partials>();
///     move |parameters: &[Partials]| {
///         let live = over.with_parameters(|own| own.copy_from_slice(parameters))?;
///         Ok(Prepared::new(&live))
///     }
/// }
/// ```
pub trait Trials {
    /// Checks that the mechanism takes these parameters, in SI units in the order of
    /// [`Info::parameters`](mbs_runtime::Info::parameters).
    ///
    /// # Errors
    /// As [`Mechanism::new`].
    fn check(&self, parameters: &[Partials]) -> Result<(), Error>;

    /// Calls `look` with the mechanism that has these parameters, and with its declared positions.
    ///
    /// # Errors
    /// As [`Mechanism::new`].
    fn look(&self, parameters: &[Partials], look: &mut Look<'_>) -> Result<(), Error>;

    /// Makes a run, and calls `see` with the number of each time of the trial and the run at this time.
    ///
    /// # Errors
    /// Those of the parameters, of the start and of the run, and those of `see`.
    fn follow(&self, trial: &Trial<'_>, see: &mut See<'_>) -> Result<(), Error>;
}

/// A function of a run at one of its times, which is given by its number.
pub type See<'a> = dyn FnMut(usize, &dyn System<Partials>) -> Result<(), Error> + 'a;

/// A function of a mechanism and its declared positions.
pub type Look<'a> = dyn FnMut(&dyn Equations<Partials>, &[Partials]) + 'a;

/// A run that is tried.
///
/// # Example
/// ```
/// use mbs_analysis::{Trial, Trials, trials_of_type};
/// use mbs_runtime::equations::Partials;
/// use mbs_runtime::{Tolerances, mechanism};
/// # mechanism! {
/// #     pub Fall {
/// #         dof = 1;
/// #         param g = 9.81 [m/s^2];
/// #         gravity = (0, -g);
/// #         body ball (y) { mass = 1 [kg]; }
/// #         start { y = 0; der(y) = 0; }
/// #     }
/// # }
///
/// let trial = Trial {
///     parameters: &[Partials::variable(9.81, 0)],
///     start: &|_, velocities: &mut [Partials]| velocities[0] = Partials::constant(4.0),
///     times: &[1.0],
///     start_time: None,
///     inputs: &[],
///     table: &Default::default(),
///     tolerances: Tolerances::default(),
///     most_steps: 1000,
/// };
/// let trials = trials_of_type::<Fall>();
/// trials.check(trial.parameters)?;
/// let (mut y, mut v) = ([Partials::default()], [Partials::default()]);
/// trials.follow(&trial, &mut |_, run| Ok(run.state(&mut y, &mut v)))?;
/// // y = v t − g t²/2, and its derivative by g
/// assert!((y[0].value - (4.0 - 0.5 * 9.81)).abs() < 1e-9 && (y[0].partials[0] + 0.5).abs() < 1e-9);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Trial<'a> {
    /// The parameters in SI units, in the order of [`Info::parameters`](mbs_runtime::Info::parameters).
    pub parameters: &'a [Partials],
    /// A function that changes positions and velocities of the declared start, before they are made consistent.
    pub start: &'a dyn Fn(&mut [Partials], &mut [Partials]),
    /// The times in s at which the run is looked at, ascending, from its start on.
    pub times: &'a [f64],
    /// The time of the start in s; `None` for the declared one.
    pub start_time: Option<f64>,
    /// The inputs in SI units, in the order of [`Info::inputs`](mbs_runtime::Info::inputs).
    pub inputs: &'a [f64],
    /// The inputs that change with time.
    pub table: &'a Arc<InputTable>,
    /// The tolerances of the run.
    pub tolerances: Tolerances,
    /// The largest number of steps that the run may take.
    pub most_steps: u64,
}

/// Runs of a type with any parameters. The mechanism is compiled once more, for numbers with derivatives. See the
/// example of [`Trial`].
pub fn trials_of_type<M: Mechanism<Real = f64>>() -> impl Trials {
    |parameters: &[Partials]| M::Over::<Partials>::new(components(parameters))
}

impl<D, F> Trials for F
where
    D: Dynamics<Real = Partials>,
    F: Fn(&[Partials]) -> Result<D, Error>,
{
    fn check(&self, parameters: &[Partials]) -> Result<(), Error> {
        self(parameters).map(|_| ())
    }

    fn look(&self, parameters: &[Partials], look: &mut Look<'_>) -> Result<(), Error> {
        let dynamics = self(parameters)?;
        let (_, q, _) = dynamics.declared_start();
        look(dynamics.equations(), q.as_ref());
        Ok(())
    }

    fn follow(&self, trial: &Trial<'_>, see: &mut See<'_>) -> Result<(), Error> {
        let dynamics =
            Driven::new(self(trial.parameters)?, trial.table.clone()).starting_at(trial.start_time);
        let (t, mut q, mut v) = dynamics.declared_start();
        (trial.start)(q.as_mut(), v.as_mut());
        let mut inputs = dynamics.default_inputs();
        dynamics.with_inputs(&mut inputs, |inputs| {
            let given = trial.inputs.iter().map(|value| Partials::constant(*value));
            inputs.iter_mut().zip(given).for_each(|(input, value)| *input = value);
        });
        let run = Adaptive::builder(dynamics)
            .scheme::<Dopri5>()
            .tolerances(trial.tolerances)
            .most_steps(trial.most_steps)
            .from_vectors(t, q, v)
            .made_consistent()
            .inputs(inputs)
            .build()?;
        // the time between two samples is set before each
        let mut run = Sampled::new(run, 1.0)?;
        for (number, time) in trial.times.iter().enumerate() {
            let span = time - run.time().value;
            if span > 0.0 {
                run.set_interval(span)?;
                run.step()?;
            }
            see(number, &run)?;
        }
        Ok(())
    }
}
