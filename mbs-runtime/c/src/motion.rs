//! A mechanism in motion, begun with what was set for it.

use mbs_live::{Live, Prepared};
use mbs_runtime::equations::At;
use mbs_runtime::{
    Adaptive, AdaptiveScheme, ConstantStepBuilder, DOPRI5, Error, Explicit, Kernel, MethodVisitor, Rattle,
    Sampled, Stabilization, SystemClone, TRBDF2, Tableau, Tolerances, TrBdf2, implicit, with_type,
};

use crate::method::Method;
use crate::status::{Failure, Status};

/// The settings of a run.
#[derive(Clone)]
pub struct Settings {
    /// The mechanism with its declared parameters.
    pub live: Live,
    /// The method.
    pub method: Method,
    /// The step in s, of a run to a tolerance the time between samples.
    pub step: f64,
    /// The parameters in SI units.
    pub parameters: Vec<f64>,
    /// The inputs in SI units.
    pub inputs: Vec<f64>,
    /// Time, positions and velocities in place of the declared start.
    pub start: Option<(f64, Vec<f64>, Vec<f64>)>,
    /// Those of a run to a tolerance.
    pub tolerances: Option<Tolerances>,
    /// α and β in 1/s in place of the declared or deadbeat ones.
    pub gains: Option<[f64; 2]>,
}

impl Settings {
    /// A run at its start.
    ///
    /// # Errors
    /// Those of the mechanism, and settings that do not go together.
    pub fn begin(&self) -> Result<Box<dyn SystemClone>, Failure> {
        let live = self.live.with_parameters(|own| own.copy_from_slice(&self.parameters))?;
        match (self.method, self.tolerances) {
            (Method::Explicit(scheme, kept), None) => self.explicit(&live, scheme, kept),
            (Method::Explicit(scheme, kept), Some(tolerances)) => {
                self.has_no_gains("a run to a tolerance")?;
                self.adaptive(&live, scheme, kept, tolerances)
            }
            (Method::Rattle(composition), None) => {
                self.has_no_gains(composition.word)?;
                self.constant(Rattle::builder(Prepared::new(&live), self.step).composition(composition))
            }
            (Method::Implicit(scheme), tolerances) => {
                self.has_no_gains(scheme.word)?;
                let usual = (scheme.word != TRBDF2.word).then(Tolerances::default);
                let Some(tolerances) = tolerances.or(usual) else {
                    return self.constant(TrBdf2::builder(Prepared::new(&live), self.step));
                };
                let unknown = || Err(Error::Scheme { name: scheme.word }.into());
                let started = Sampling { settings: self, live: &live, tolerances };
                implicit::with_type(scheme, started).unwrap_or_else(unknown)
            }
            (Method::Rattle(composition), Some(_)) => {
                let word = composition.word;
                Err(Failure::new(
                    Status::Method,
                    format!("the method `{word}` takes constant steps; set no tolerances, or take a scheme"),
                ))
            }
        }
    }

    /// Refuses gains where nothing is fed back.
    fn has_no_gains(&self, what: &str) -> Result<(), Failure> {
        match self.gains {
            None => Ok(()),
            Some(_) => Err(Failure::new(
                Status::Method,
                format!("gains were set, but {what} keeps the constraints without feedback; leave them out"),
            )),
        }
    }

    /// Constant steps of a scheme. Feedback that the text declares counts where the method names none.
    fn explicit(
        &self,
        live: &Live,
        scheme: Option<&'static Tableau>,
        kept: Option<Stabilization>,
    ) -> Result<Box<dyn SystemClone>, Failure> {
        let declared = live.declared_feedback().filter(|_| kept.is_none());
        let stabilization = match &declared {
            Some(feedback) if !feedback.is_held => Stabilization::PerStage,
            Some(_) => Stabilization::Held,
            None => kept.unwrap_or_default(),
        };
        let method = Explicit { tableau: scheme.unwrap_or(live.declared_scheme()), stabilization };
        let mut builder = mbs_live::Run::builder(live, self.step).method(method).inputs(&self.inputs);
        if let Some(gains) = self.gains.or(declared.map(|feedback| [feedback.alpha, feedback.beta])) {
            builder = builder.gains(gains);
        }
        if let Some((t, q, v)) = &self.start {
            builder = builder.from_state(At { t: *t, q, v });
        }
        Ok(Box::new(builder.build()?))
    }

    /// Samples of a run to a tolerance, which keeps the constraints by projection.
    fn adaptive(
        &self,
        live: &Live,
        scheme: Option<&'static Tableau>,
        kept: Option<Stabilization>,
        tolerances: Tolerances,
    ) -> Result<Box<dyn SystemClone>, Failure> {
        if matches!(kept, Some(Stabilization::Held | Stabilization::PerStage)) {
            let message = "a run to a tolerance keeps the constraints by projection; leave the feedback out of the \
                           method, or set no tolerances";
            return Err(Failure::new(Status::Method, message));
        }
        let declared = live.declared_scheme();
        let tableau = scheme.unwrap_or(if declared.is_adaptive() { declared } else { &DOPRI5 });
        let started = Sampling { settings: self, live, tolerances };
        let unknown = || Err(Error::Scheme { name: tableau.word }.into());
        with_type(Explicit::projected(tableau), started).unwrap_or_else(unknown)
    }

    /// Constant steps of a method that keeps the constraints itself.
    fn constant<K>(&self, builder: ConstantStepBuilder<Prepared, K>) -> Result<Box<dyn SystemClone>, Failure>
    where
        K: Kernel<Prepared> + 'static,
    {
        let mut builder = builder.inputs(self.inputs.clone());
        if let Some((t, q, v)) = self.start.clone() {
            builder = builder.from_vectors(t, q, v);
        }
        Ok(Box::new(builder.build()?))
    }
}

/// Begins a run to a tolerance with a scheme that is chosen at run time.
struct Sampling<'a> {
    settings: &'a Settings,
    live: &'a Live,
    tolerances: Tolerances,
}

impl MethodVisitor for Sampling<'_> {
    type Result = Result<Box<dyn SystemClone>, Failure>;

    fn visit<X: mbs_runtime::Method>(self) -> Self::Result {
        self.with_scheme::<X::Scheme>()
    }
}

impl implicit::Visitor for Sampling<'_> {
    type Result = Result<Box<dyn SystemClone>, Failure>;

    fn visit<S: AdaptiveScheme>(self) -> Self::Result {
        self.with_scheme::<S>()
    }
}

impl Sampling<'_> {
    fn with_scheme<S: AdaptiveScheme>(self) -> Result<Box<dyn SystemClone>, Failure> {
        // nothing more is compiled for a scheme without an estimate
        if const { S::ESTIMATE.is_none() } {
            return Err(Error::NoEstimate { scheme: S::WORD }.into());
        }
        let Self { settings, live, tolerances } = self;
        let builder = Adaptive::builder(Prepared::new(live)).scheme::<S>().tolerances(tolerances);
        let mut builder = builder.inputs(settings.inputs.clone());
        if let Some((t, q, v)) = settings.start.clone() {
            builder = builder.from_vectors(t, q, v);
        }
        Ok(Box::new(Sampled::new(builder.build()?, settings.step)?))
    }
}
