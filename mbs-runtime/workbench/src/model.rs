//! A mechanism whose type is no longer known: what commands work with.
//!
//! A model says how a run of a mechanism starts. Recording (`run.rs`) and sweeping (`members.rs`) are
//! written once, on `dyn System`. A model is made of a type (`typed.rs`) or of a text (`live.rs`).

use mbs_analysis::Trials;
use mbs_runtime::{Derivation, Error, HEUN, Info, Sketch, SystemClone, Tableau};

use crate::members::lanes::InLanes;
use crate::settings::{Settings, Start};

#[cfg(feature = "live")]
pub use crate::live::{as_declared, from_text};
pub use crate::typed::{differentiated, in_lanes, of, with};

/// A mechanism that commands can run: every [`Mechanism`](mbs_runtime::Mechanism) in `f64` by [`of`].
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

    /// Period and offset of its clocks in s.
    ///
    /// # Errors
    /// Parameters that the mechanism refuses.
    fn clocks(&self, parameters: &[f64]) -> Result<Vec<[f64; 2]>, Error>;

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

/// The refusal of a mechanism whose declaration is asked for as a text.
#[cfg(feature = "live")]
pub(crate) fn without_text(name: &str) -> crate::Error {
    let reason = "its declaration is compiled into this program and not there as a text; name its file";
    crate::Error::Name { name: name.to_owned(), reason: reason.into() }
}
