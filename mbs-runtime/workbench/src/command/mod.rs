//! The commands that every [`App`](crate::App) has, one a file.
//!
//! Commands, figures, reports, sweeps with their progress, and files need a terminal or a folder. They stand
//! behind the feature `desk`. The rest of this crate runs mechanisms and writes the page in which one runs,
//! on every target of Rust.

pub(crate) mod bode;
#[cfg(feature = "live")]
pub(crate) mod check;
mod compare;
pub(crate) mod completions;
mod curves;
pub(crate) mod equilibrium;
pub(crate) mod explain;
#[cfg(feature = "live")]
pub(crate) mod export;
mod extremes;
pub(crate) mod fit;
#[cfg(feature = "live")]
pub(crate) mod import;
pub(crate) mod inverse;
mod json;
pub(crate) mod linearize;
pub(crate) mod list;
pub(crate) mod merge;
pub(crate) mod modes;
pub(crate) mod new;
mod operating;
mod options;
mod page;
mod responses;
mod shapes;
pub(crate) mod simulate;
pub(crate) mod sweep;
pub(crate) mod synthesize;
pub(crate) mod travel;
#[cfg(feature = "live")]
pub(crate) mod watch;
