//! What a person at a desk uses to work with mechanisms that `mechanism!`
//! compiled: a command line, recordings, sweeps, figures and reports.
//!
//! - [`app`] gives a program of one line the commands `list`, `simulate`, `sweep`
//!   and `new` for its own mechanisms.
//! - [`model::of`] takes any [`Mechanism`](mbs_runtime::Mechanism) in `f64` as
//!   a [`Model`], whose type no longer matters; [`simulate`](Model#method.simulate) runs it with
//!   [`Settings`] and gives a [`Recording`].
//! - [`quantity`] reads values with units; [`Table`] and [`number`] print them.
//! - [`sweep`] runs a computation over a grid on all cores.
//! - [`picture`] finds what a mechanism looks like from its sketch and a run.
//! - [`figure`] draws curves, heat maps and mechanisms to SVG and PNG; [`report`] makes one
//!   offline HTML page of figures, tables and moving pictures.
//!
//! # Example
//! ```
//! use mbs_workbench::{Settings, model};
//!
//! mbs_runtime::mechanism! {
//!     /// A weight on a massless rod.
//!     pub Pendulum {
//!         dof = 1;
//!         param length = 1 [m];
//!         gravity = (0, -9.81) [m/s^2];
//!         body bob (x, y) { mass = 2 [kg]; }
//!         constraint rod: x^2 + y^2 = length^2;
//!         start { x = length; guess y = 0; }
//!     }
//! }
//!
//! let pendulum = model::of::<Pendulum>();
//! let settings = Settings { end: 0.5, parameters: vec![("length".into(), 0.8)], ..Settings::default() };
//! let recording = pendulum.simulate(&settings, &mut |_, _| ())?;
//! assert_eq!(recording.summary.steps, 1000);
//! assert!(recording.column("y").is_some_and(|y| y.values.last() < Some(&0.0)));
//! # Ok::<(), mbs_workbench::Error>(())
//! ```
#![forbid(unsafe_code)]

mod adaptive;
mod app;
mod command;
mod console;
mod doubt;
mod error;
pub mod figure;
mod files;
#[cfg(feature = "live")]
pub mod fmu;
#[cfg(feature = "live")]
mod import;
#[cfg(feature = "live")]
mod interactive;
mod interrupt;
#[cfg(feature = "live")]
mod live;
mod measurements;
pub mod members;
pub mod model;
mod models;
mod names;
mod npz;
pub mod number;
mod operating;
pub mod picture;
pub mod quantity;
mod recording;
pub mod report;
mod run;
mod run_options;
mod settings;
mod sheet;
mod signals;
pub mod sweep;
mod table;
mod template;
mod unit;
mod until;
#[cfg(feature = "live")]
mod watch;

pub use app::{App, app};
pub use console::say;
pub use doubt::Doubt;
pub use error::Error;
pub use model::Model;
pub use models::Models;
pub use operating::{About, Operating, PortNames, doubt};
pub use picture::{Motion, Picture};
pub use recording::{Column, MOST_OCCURRENCES, Recording, Summary, write_csv};
pub use run::StartValue;
pub use run_options::RunOptions;
pub use settings::{ConstantMethod, Settings, Start, StartKind};
pub use signals::Signals;
pub use table::Table;
pub use unit::Unit;
pub use until::{Occurrence, Unmet, Until};
