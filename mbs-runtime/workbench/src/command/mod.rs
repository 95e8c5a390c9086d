//! The commands that every [`App`](crate::App) has, one a file.

#[cfg(feature = "live")]
pub(crate) mod check;
mod compare;
pub(crate) mod completions;
mod curves;
pub(crate) mod equilibrium;
pub(crate) mod explain;
#[cfg(feature = "live")]
pub(crate) mod export;
mod json;
pub(crate) mod list;
pub(crate) mod new;
mod options;
mod page;
pub(crate) mod simulate;
pub(crate) mod sweep;
#[cfg(feature = "live")]
pub(crate) mod watch;
