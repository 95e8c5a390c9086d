//! A mechanism whose type is no longer known: what commands work with.
//!
//! A model says how a run of a mechanism starts. Recording (`run.rs`) and sweeping (`members.rs`) are
//! written once, on `dyn System`. A model is made of a type (`of`) or of a text (`live.rs`).

use std::marker::PhantomData;

use mbs_analysis::Trials;
use mbs_runtime::{
    Baumgarte, Components, Derivation, Error, HEUN, Held, Info, Mechanism, Method, PerStage, Projected,
    Scheme, Simulation, Sketch, Stabilization, State, SystemClone, Tableau,
};

use crate::adaptive::{self, Erased};
use crate::members::lanes::InLanes;
use crate::settings::{Settings, Start, StartKind};
use crate::start_state::StartState;

/// A mechanism that commands can run: every [`Mechanism`] in `f64` by [`of`].
///
/// The work of the commands ([`simulate`](#method.simulate), [`sweep`](#method.sweep) and so on) is written
/// once for all mechanisms, on the runs that it starts.
pub trait Model: Send + Sync {
    /// Names, units, equations and operation counts.
    fn info(&self) -> &'static Info;

    /// The equations and their elimination.
    fn derivation(&self) -> &'static Derivation;

    /// The points and the parts that a picture of it shows.
    fn sketch(&self) -> &'static Sketch;

    /// The scheme that it declares: Heun's method, unless it says another.
    fn scheme(&self) -> &'static Tableau;

    /// `true` if the declaration names its scheme. By default this holds for every scheme but Heun's method.
    fn declares_scheme(&self) -> bool {
        !self.scheme().is(&HEUN)
    }

    /// The settings of a run where nothing else is said.
    fn defaults(&self) -> Settings {
        Settings::default()
    }

    /// A run at its start.
    ///
    /// # Errors
    /// Parameters, inputs, gains, a step or a start that the mechanism refuses.
    fn start(&self, start: &Start) -> Result<Box<dyn SystemClone>, Error>;

    /// Its declaration, where that is a text: other programs than this one can be made of it.
    #[cfg(feature = "live")]
    fn text(&self) -> Option<&mbs_live::Text> {
        None
    }

    /// Its runs with derivatives, if it has such: what is fitted to data, and of which dimensions are found.
    fn trials(&self) -> Option<Box<dyn Trials + Sync + '_>> {
        None
    }

    /// Its runs in lanes, many to a vector instruction, if it has such.
    fn in_lanes(&self) -> Option<&dyn InLanes> {
        None
    }
}

/// The mechanism `M` as a [`Model`]. Steps of the scheme that it declares are fused, those of others are
/// taken stage by stage: the same numbers, and only one scheme to compile.
pub fn of<M: Mechanism<Real = f64>>() -> Box<dyn Model> {
    with::<M>(Settings::default())
}

/// The mechanism `M` as a [`Model`] with defaults of its own: a fast mechanism
/// needs a smaller step.
pub fn with<M: Mechanism<Real = f64>>(defaults: Settings) -> Box<dyn Model> {
    Box::new(Typed { defaults, lanes: None, trials: None, mechanism: PhantomData::<M> })
}

/// The mechanism `M` as a [`Model`] whose sweeps run eight members to a vector
/// instruction: some times faster, and some seconds more to compile.
pub fn in_lanes<M: Mechanism<Real = f64>>(defaults: Settings) -> Box<dyn Model> {
    let lanes = Some(Box::new(crate::members::lanes::Typed(PhantomData::<M>)) as Box<dyn InLanes>);
    Box::new(Typed { defaults, lanes, trials: None, mechanism: PhantomData::<M> })
}

/// The mechanism `M` as a [`Model`] that can be fitted to data, for which its equations are compiled for
/// numbers with derivatives too.
pub fn differentiated<M: Mechanism<Real = f64>>(defaults: Settings) -> Box<dyn Model> {
    let trials: Option<MakeTrials> = Some(adaptive::trials::<M>);
    Box::new(Typed { defaults, lanes: None, trials, mechanism: PhantomData::<M> })
}

/// The mechanism that a text declares as a [`Model`] with these defaults: compiled in
/// milliseconds, and slower to run than one whose type the compiler knew.
///
/// # Errors
/// [`Declaration`](crate::Error::Declaration).
#[cfg(feature = "live")]
pub fn from_text(text: &mbs_live::Text, defaults: Settings) -> Result<Box<dyn Model>, crate::Error> {
    crate::live::compiled(text, defaults)
}

/// The mechanism that a text declares as a [`Model`], with the step and the feedback that it declares.
///
/// # Errors
/// [`Declaration`](crate::Error::Declaration).
#[cfg(feature = "live")]
pub fn as_declared(text: &mbs_live::Text) -> Result<Box<dyn Model>, crate::Error> {
    crate::live::as_declared(text)
}

/// The refusal of a mechanism whose declaration is asked for as a text.
#[cfg(feature = "live")]
pub(crate) fn without_text(name: &str) -> crate::Error {
    let reason = "its declaration is compiled into this program and not there as a text; name its file";
    crate::Error::Name { name: name.to_owned(), reason: reason.into() }
}

type MakeTrials = fn() -> Box<dyn Trials + Sync>;

struct Typed<M> {
    defaults: Settings,
    lanes: Option<Box<dyn InLanes>>,
    trials: Option<MakeTrials>,
    mechanism: PhantomData<M>,
}

impl<M: Mechanism<Real = f64>> Model for Typed<M> {
    fn info(&self) -> &'static Info {
        M::INFO
    }

    fn derivation(&self) -> &'static Derivation {
        M::DERIVATION
    }

    fn sketch(&self) -> &'static Sketch {
        M::SKETCH
    }

    fn scheme(&self) -> &'static Tableau {
        M::Scheme::TABLEAU
    }

    fn defaults(&self) -> Settings {
        self.defaults.clone()
    }

    fn start(&self, start: &Start) -> Result<Box<dyn SystemClone>, Error> {
        if let Some(tolerances) = start.tolerances {
            let mechanism = M::new(components(&start.parameters))?;
            return adaptive::start(Erased::new(mechanism), tolerances, start);
        }
        if let Some(method) = start.other {
            let mechanism = M::new(components(&start.parameters))?;
            return adaptive::constant(Erased::new(mechanism), method, start);
        }
        // A fused step of each method that could be chosen would take long to compile.
        let is_declared = start.method.tableau.is(M::Scheme::TABLEAU);
        if start.has_signals() || !is_declared {
            let mechanism = M::new(components(&start.parameters))?;
            return adaptive::in_stages(Erased::new(mechanism), start);
        }
        Ok(match start.method.stabilization {
            Stabilization::Held => Box::new(simulation::<M, Held<M::Scheme>>(start)?),
            Stabilization::PerStage => Box::new(simulation::<M, PerStage<M::Scheme>>(start)?),
            Stabilization::Projection => Box::new(simulation::<M, Projected<M::Scheme>>(start)?),
        })
    }

    fn trials(&self) -> Option<Box<dyn Trials + Sync + '_>> {
        self.trials.map(|make| make() as Box<dyn Trials + Sync>)
    }

    fn in_lanes(&self) -> Option<&dyn InLanes> {
        self.lanes.as_deref()
    }
}

/// A simulation of a known type.
pub(crate) fn simulation<M: Mechanism<Real = f64>, X: Method>(
    start: &Start,
) -> Result<Simulation<M, X>, Error> {
    let mut builder = Simulation::builder(M::new(components(&start.parameters))?, start.step)
        .baumgarte(Baumgarte::<X>::new(start.alpha, start.beta)?)
        .inputs(components(&start.inputs));
    if let Some(StartState { start_time, q, v, .. }) = &start.state {
        builder = builder.from_state(State { t: *start_time, q: components(q), v: components(v) });
    }
    if start.kind == StartKind::Declared {
        builder = builder.as_declared();
    }
    if start.allow_unstable {
        builder = builder.allow_unstable();
    }
    builder.build()
}

/// Components from as many numbers.
pub(crate) fn components<C: Components>(values: &[C::Real]) -> C {
    let mut array = C::splat(C::Real::default()).into_array();
    array.as_mut().iter_mut().zip(values).for_each(|(component, value)| *component = *value);
    C::from_array(array)
}
