//! Types that `mechanism!` compiled as models.

use std::marker::PhantomData;

use mbs_analysis::Trials;
use mbs_runtime::equations::Partials;
use mbs_runtime::{
    Derivation, Error, Held, Info, Mechanism, PerStage, Projected, Scheme, Sketch, Stabilization,
    SystemClone, Tableau,
};

use crate::Model;
use crate::adaptive;
use crate::erased::Erased;
use crate::members::lanes::{self, InLanes};
use crate::settings::{Settings, Start};
use crate::simulated::{components, simulation};

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
    let lanes = Some(Box::new(lanes::Typed(PhantomData::<M>)) as Box<dyn InLanes>);
    Box::new(Typed { defaults, lanes, trials: None, mechanism: PhantomData::<M> })
}

/// The mechanism `M` as a [`Model`] that can be fitted to data, for which its equations are compiled for
/// numbers with derivatives too.
pub fn differentiated<M: Mechanism<Real = f64>>(defaults: Settings) -> Box<dyn Model> {
    let trials: Option<MakeTrials> =
        Some(|parameters| M::Over::<Partials>::new(components(parameters)).map(Erased::of_type));
    Box::new(Typed { defaults, lanes: None, trials, mechanism: PhantomData::<M> })
}

type MakeTrials = fn(&[Partials]) -> Result<Erased<Partials>, Error>;

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

    fn clocks(&self, parameters: &[f64]) -> Result<Vec<[f64; 2]>, Error> {
        let mechanism = M::new(components(parameters))?;
        Ok((0..M::INFO.sampling.clocks).map(|clock| mechanism.clock(clock)).collect())
    }

    fn start(&self, start: &Start) -> Result<Box<dyn SystemClone>, Error> {
        if let Some(tolerances) = start.tolerances {
            let mechanism = M::new(components(&start.parameters))?;
            return adaptive::start(Erased::of_type(mechanism), tolerances, start);
        }
        if let Some(method) = start.other {
            let mechanism = M::new(components(&start.parameters))?;
            return adaptive::constant(Erased::of_type(mechanism), method, start);
        }
        // A fused step of each method that could be chosen would take long to compile.
        let is_declared = start.method.tableau.is(M::Scheme::TABLEAU);
        if start.has_signals() || !is_declared {
            let mechanism = M::new(components(&start.parameters))?;
            return adaptive::in_stages(Erased::of_type(mechanism), start);
        }
        Ok(match start.method.stabilization {
            Stabilization::Held => Box::new(simulation::<M, Held<M::Scheme>>(start)?),
            Stabilization::PerStage => Box::new(simulation::<M, PerStage<M::Scheme>>(start)?),
            Stabilization::Projection => Box::new(simulation::<M, Projected<M::Scheme>>(start)?),
        })
    }

    fn trials(&self) -> Option<Box<dyn Trials + Sync + '_>> {
        self.trials.map(|make| adaptive::trials(make) as Box<dyn Trials + Sync>)
    }

    fn in_lanes(&self) -> Option<&dyn InLanes> {
        self.lanes.as_deref()
    }
}
