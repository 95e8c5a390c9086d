//! What a person at a desk uses to work with compiled mechanisms.
#![forbid(unsafe_code)]

mod app;
mod command;
mod error;
pub mod figure;
pub mod model;
mod names;
pub mod number;
pub mod quantity;
mod recording;
pub mod report;
mod settings;
pub mod sweep;
mod table;

pub use app::{App, Models, app};
pub use error::Error;
pub use model::Model;
pub use recording::{Column, Recording, Summary, write_csv};
pub use settings::{FeedbackKind, Settings, StartKind};
pub use table::Table;
