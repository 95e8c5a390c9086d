#![doc = include_str!("../README.md")]
#![doc = include_str!("flap.svg")]
//!
//! The page on linear systems, modes and responses is [`linear`], that on inverse dynamics and statics
//! [`prescribed`], that on fits to measured data [`identification`], that on dimensions for a path or a
//! function [`linkages`], that on solvers of other crates [`ode_crates`].
//!
//! # What it asks a mechanism
//!
//! Everything works on the equations of a mechanism on slices
//! ([`Equations`](mbs_runtime::equations::Equations)), which every type of `mechanism!` is, and
//! every text that `mbs-live` has compiled. Vectors are in the order of
//! [`Info`](mbs_runtime::Info), in SI units and rad.
#![forbid(unsafe_code)]

mod chart;
mod complex;
mod curve;
mod derivative;
mod difference;
mod driven;
mod equilibrium;
mod error;
mod family;
mod first_order;
mod fit;
mod guided;
mod input_table;
mod inverse;
mod jacobian;
#[doc = include_str!("fit/identification.md")]
#[doc = include_str!("fit/identification.svg")]
pub mod identification {}
#[doc = include_str!("linear.md")]
#[doc = include_str!("car.svg")]
pub mod linear {}
mod linearization;
mod modes;
mod pencil;
mod point;
#[doc = include_str!("prescribed.md")]
#[doc = include_str!("tailgate.svg")]
pub mod prescribed {}
mod rates;
mod response;
mod rest;
mod resting;
mod sensitivity;
mod signal;
mod singular;
mod stops;
mod synthesis;
#[doc = include_str!("synthesis/linkages.md")]
#[doc = include_str!("synthesis/linkages.svg")]
pub mod linkages {}
#[doc = include_str!("ode_crates.md")]
pub mod ode_crates {}
mod tangent;
mod travel;

pub use mbs_symbolic::{Beyond, Interpolation};
pub use nalgebra;

pub use curve::{Curve, Moment, Time};
pub use driven::Driven;
pub use equilibrium::{Equilibrium, Search, Stability, Strategy, equilibrium};
pub use error::Error;
pub use family::{Family, of_type};
pub use first_order::FirstOrder;
pub use fit::{
    Estimate, Experiment, Fit, Look, Measurement, Progress, Remainder, See, Trial, Trials, Unknown, clock_of,
    trials_of_type,
};
pub use input_table::{InputTable, Way, own_clock};
pub use inverse::{By, Instant, Prescription, inverse};
pub use linearization::{Linearization, Ports, linearize};
pub use modes::{Behaviour, Mode};
pub use point::{Drives, OperatingPoint};
pub use rates::{Rates, rates};
pub use response::{StepResponse, phases};
pub use sensitivity::{Sensitivities, sensitivities};
pub use signal::{Signal, Variable};
pub use synthesis::{Defect, Linkage, Synthesis, Task};
pub use travel::{Along, Position, Travel, travel};
