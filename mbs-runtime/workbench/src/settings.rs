//! Settings of a run.

use std::sync::Arc;

use mbs_analysis::InputTable;
use mbs_runtime::{
    COMPOSITIONS, Composition, Explicit, IMPLICIT, Implicit, Info, Stabilization, TRBDF2, Tableau, Threshold,
    Tolerances,
};

use crate::{Signals, Until};

/// Where a run starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartKind {
    /// The declared start, made consistent with the constraints.
    #[default]
    Consistent,
    /// The declared start as it is.
    Declared,
}

/// A method that is more than the stages of an explicit scheme. It keeps the constraints itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OtherMethod {
    /// RATTLE, for forces that do not depend on velocities, with what a step is composed of. Its steps are
    /// constant.
    Rattle(&'static Composition),
    /// An implicit scheme, for stiff forces. Of TR-BDF2 without tolerances the steps are constant.
    Implicit(&'static Implicit),
}

impl OtherMethod {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        COMPOSITIONS.into_iter().map(Self::Rattle).chain(IMPLICIT.into_iter().map(Self::Implicit))
    }

    /// The one with this word.
    pub fn find(word: &str) -> Option<Self> {
        Self::all().find(|method| method.word() == word)
    }

    /// The word that asks for it on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Rattle(composition) => composition.word,
            Self::Implicit(scheme) => scheme.word,
        }
    }

    /// `true` if its steps are constant where no tolerances are given.
    fn is_constant(self) -> bool {
        match self {
            Self::Rattle(_) => true,
            Self::Implicit(scheme) => scheme.word == TRBDF2.word,
        }
    }
}

/// A run of a mechanism. Values are in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Parameters that differ from their declared values.
    pub parameters: Vec<(String, f64)>,
    /// Inputs that differ from their defaults and are constant over the run.
    pub inputs: Vec<(String, f64)>,
    /// Inputs that change during the run.
    pub signals: Option<Signals>,
    /// Step in s.
    pub step: f64,
    /// End time in s.
    pub end: f64,
    /// Every how many steps a row is recorded; 0 counts as 1.
    pub every: u64,
    /// α in 1/s; `None` for the deadbeat gain of the step.
    pub alpha: Option<f64>,
    /// β in 1/s; `None` for the deadbeat gain of the step.
    pub beta: Option<f64>,
    /// The scheme of the steps; `None` for the one that the mechanism declares.
    pub scheme: Option<&'static Tableau>,
    /// A method of another kind in place of a scheme.
    pub other: Option<OtherMethod>,
    /// The way in which the constraints are kept. `None` for projection of a run to a tolerance, and for held
    /// feedback of one with a constant step.
    pub stabilization: Option<Stabilization>,
    /// For a run to a tolerance: its steps are as long as their error permits, and `step` is the
    /// time between two samples of it.
    pub tolerances: Option<Tolerances>,
    /// The condition at which it ends, of a run to a tolerance.
    pub until: Option<Until>,
    /// Where the run starts.
    pub start: StartKind,
    /// Start values of coordinates `x` and rates `der(x)` in place of the declared ones.
    pub from: Vec<(String, f64)>,
    /// Nobody asks for this very step: where clocks need a shorter one, that is taken.
    pub fits_clocks: bool,
    /// Accept gains under which violations grow.
    pub allow_unstable: bool,
}

impl Default for Settings {
    /// One second in steps of 0.5 ms, everything else as recommended.
    fn default() -> Self {
        Self {
            parameters: Vec::new(),
            inputs: Vec::new(),
            signals: None,
            step: 0.5e-3,
            end: 1.0,
            every: 1,
            alpha: None,
            beta: None,
            scheme: None,
            other: None,
            stabilization: None,
            tolerances: None,
            until: None,
            start: StartKind::default(),
            from: Vec::new(),
            fits_clocks: true,
            allow_unstable: false,
        }
    }
}

impl Settings {
    /// The tolerances of a run: those that are given, and the usual ones where the method takes no constant steps,
    /// a condition ends the run, or the mechanism has stops and nothing that constant steps alone have is asked for.
    /// Nothing of a run with a constant step.
    pub(crate) fn tolerances_of_run(&self, info: &Info) -> Option<Tolerances> {
        let asks_for_steps = self.other.is_some()
            || self.scheme.is_some_and(|scheme| !scheme.is_adaptive())
            || self.stabilization.is_some_and(|way| way != Stabilization::Projection);
        let hits = info.jumps() && !asks_for_steps;
        let is_adaptive =
            self.until.is_some() || hits || self.other.is_some_and(|other| !other.is_constant());
        self.tolerances.or(is_adaptive.then(Tolerances::default))
    }
}

/// The start of a run: settings in which every quantity of a mechanism has its number.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// The parameters in SI units, in the order of [`Info::parameters`](mbs_runtime::Info::parameters).
    pub parameters: Vec<f64>,
    /// The inputs in SI units, in the order of [`Info::inputs`](mbs_runtime::Info::inputs).
    pub inputs: Vec<f64>,
    /// The inputs that change with time; of those, the values above do not count.
    pub table: Arc<InputTable>,
    /// When the run starts, in s, unless as the mechanism declares it.
    pub start_time: Option<f64>,
    /// The scheme, and what keeps the constraints.
    pub method: Explicit,
    /// A method of another kind in its place.
    pub other: Option<OtherMethod>,
    /// α in 1/s.
    pub alpha: f64,
    /// β in 1/s.
    pub beta: f64,
    /// Step in s; of a run to a tolerance, the time between two samples of it.
    pub step: f64,
    /// The tolerances of a run that keeps such.
    pub tolerances: Option<Tolerances>,
    /// A threshold that it watches beside its declared events.
    pub threshold: Option<Threshold>,
    /// Where the run starts.
    pub kind: StartKind,
    /// The state in place of the declared start. It has to be consistent, unless the start is
    /// [`Declared`](StartKind::Declared).
    pub state: Option<StartState>,
    /// True if the state alone is of interest, before anything happens in it.
    pub is_looked_at: bool,
    /// Accept gains under which violations grow.
    pub allow_unstable: bool,
}

/// A state at which a run starts, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct StartState {
    /// The time in s at which the run started, which is that of the state if no step was taken.
    pub start_time: f64,
    /// Steps that the run has taken from there. A run to a tolerance counts none.
    pub steps_taken: u64,
    /// The coordinates, in the order of [`Info::coordinates`](mbs_runtime::Info::coordinates).
    pub q: Vec<f64>,
    /// Their rates.
    pub v: Vec<f64>,
}

impl Start {
    /// `true` if inputs from a table change with time.
    pub(crate) fn has_signals(&self) -> bool {
        !self.table.is_empty()
    }
}
