//! What a run is asked to do.

use crate::Signals;

/// When the feedback is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FeedbackKind {
    /// Once a step ([`mbs_runtime::Held`]).
    #[default]
    Held,
    /// In both stages of Heun's method ([`mbs_runtime::PerStage`]).
    PerStage,
}

/// Where a run starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartKind {
    /// The declared start, made consistent with the constraints.
    #[default]
    Consistent,
    /// The declared start as it is.
    Declared,
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
    /// When the feedback is evaluated.
    pub feedback: FeedbackKind,
    /// Where the run starts.
    pub start: StartKind,
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
            feedback: FeedbackKind::default(),
            start: StartKind::default(),
            allow_unstable: false,
        }
    }
}
