//! The slider-crank of the paper: the declaration of the library, as a text.

use mbs_live::Live;
use mbs_runtime::{Error, Explicit, HEUN};
use mbs_workbench::sweep;

use super::setup::{Setup, TURN};
use crate::library;

/// Feedback evaluated in both stages of Heun's method, as the paper has it.
pub const PER_STAGE: Explicit = Explicit::per_stage(&HEUN);
/// Feedback held over each step.
pub const HELD: Explicit = Explicit::held(&HEUN);

/// The mechanism, compiled.
pub struct Crank {
    /// With its declared parameters.
    pub mechanism: Live,
    /// Where the outputs of interest are among the coordinates and the multipliers.
    pub x3: usize,
    pub drive: usize,
}

/// Its parameters in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Parameters {
    pub l1: f64,
    pub l2: f64,
    pub m1: f64,
    pub m2: f64,
    pub m3: f64,
    /// J / (m l²) of crank and rod.
    pub inertia_factor: f64,
    pub omega: f64,
}

impl Crank {
    /// Reads the declaration.
    ///
    /// # Errors
    /// It is not what this study is about.
    pub fn new() -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        let entry = library().iter().find(|entry| entry.name == "slider-crank");
        let mechanism = entry.ok_or("the library has no `slider-crank`")?.text().compile()?;
        let info = mechanism.declared_info();
        let x3 = info.coordinates.iter().position(|coordinate| coordinate.name == "x3");
        let drive = info.constraints.iter().position(|constraint| constraint.name == "crank_speed");
        let (Some(x3), Some(drive), 7) = (x3, drive, info.coordinates.len()) else {
            return Err("`slider-crank` is not that of the paper".into());
        };
        Ok(Self { x3, drive, mechanism })
    }

    /// The declared parameters; one that is not there is no number.
    pub fn parameters(&self) -> Parameters {
        let info = self.mechanism.declared_info();
        let declared = |name: &str| {
            info.parameters.iter().find(|it| it.name == name).map_or(f64::NAN, |parameter| parameter.default)
        };
        Parameters {
            l1: declared("l1"),
            l2: declared("l2"),
            m1: declared("m1"),
            m2: declared("m2"),
            m3: declared("m3"),
            inertia_factor: declared("inertia_factor"),
            omega: declared("omega"),
        }
    }

    /// The same mechanism with these values for some of the parameters.
    pub fn with(&self, changed: &[(&str, f64)]) -> Result<Live, Error> {
        let info = self.mechanism.declared_info();
        self.mechanism.with_parameters(|values| {
            for (value, parameter) in values.iter_mut().zip(info.parameters) {
                if let Some((_, new)) = changed.iter().find(|(name, _)| *name == parameter.name) {
                    *value = *new;
                }
            }
        })
    }

    /// max ‖Φ‖ over all steps of one turn, both ends included, at 200 rpm from the paper's
    /// start with each of these gains in both stages; or the error with which the run ended,
    /// if it did not reach its end.
    pub fn max_violations(&self, title: &str, gains: &[(f64, f64)]) -> Vec<Result<f64, Error>> {
        sweep::map(title, gains, |&(alpha, beta)| Setup::gains(alpha, beta).largest_violation(self, TURN))
    }
}
