//! Tools to work at a desk with mechanisms that `mechanism!` compiled: a command line, recordings, sweeps,
//! figures and reports.
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
#[cfg(feature = "desk")]
mod app;
#[cfg(feature = "desk")]
mod command;
#[cfg(feature = "desk")]
mod console;
#[cfg(feature = "desk")]
mod csv_file;
#[cfg(all(feature = "desk", feature = "live"))]
mod declarations;
#[cfg(any(feature = "desk", feature = "live"))]
mod derivation;
mod digits;
mod doubt;
mod energy;
mod erased;
mod error;
#[cfg(feature = "desk")]
pub mod figure;
#[cfg(feature = "desk")]
mod files;
#[cfg(all(feature = "desk", feature = "live"))]
pub mod fmu;
#[cfg(any(feature = "desk", feature = "live"))]
pub mod html;
mod instant;
#[cfg(feature = "live")]
mod interactive;
#[cfg(feature = "desk")]
mod interrupt;
#[cfg(feature = "live")]
mod live;
#[cfg(feature = "desk")]
mod measurements;
pub mod members;
pub mod model;
#[cfg(feature = "desk")]
mod models;
mod notes;
#[cfg(feature = "desk")]
mod npz;
mod operating;
pub mod quantity;
mod recording;
#[cfg(feature = "desk")]
pub mod report;
mod resolution;
mod run;
mod run_options;
mod settings;
#[cfg(feature = "desk")]
mod sheet;
mod signals;
mod simulated;
mod stages;
mod start;
mod start_state;
#[cfg(feature = "desk")]
pub mod sweep;
mod table;
#[cfg(feature = "desk")]
mod table_file;
mod typed;
mod unit;
mod until;
#[cfg(all(feature = "desk", feature = "live"))]
mod watch;

use mbs_words::names;

#[cfg(feature = "desk")]
pub use app::{App, app};
#[cfg(feature = "desk")]
pub use console::say;
#[cfg(feature = "desk")]
pub use csv_file::write_csv;
pub use doubt::Doubt;
pub use error::Error;
#[cfg(feature = "desk")]
pub use files::check_writable;
#[cfg(feature = "live")]
pub use interactive::{Sources, packed, source_hash};
pub use mbs_pictures::{Column, picture};
pub use mbs_words::number;
pub use model::Model;
#[cfg(feature = "desk")]
pub use models::Models;
pub use operating::{About, Operating, PortNames, doubt};
pub use picture::{Motion, Picture};
pub use recording::{MOST_OCCURRENCES, Recording, Summary};
pub use run::StartValue;
pub use run_options::RunOptions;
pub use settings::{OtherMethod, Settings, Start, StartKind, StartState};
pub use signals::Signals;
pub use table::Table;
pub use unit::Unit;
pub use until::{Ending, Occurrence, Unmet, Until};
