//! Mechanisms from texts, compiled in milliseconds and run at once, without rustc.
//!
//! A [`Text`] is what stands in `mechanism! { … }`, in a file of its own or in a Rust file.
//! The compiler of the macro makes programs of it, and this crate interprets them, for one
//! state or for a [`Pack`] of runs together. Results are those of the compiled Rust, to
//! the last bit; errors are those of the macro, with their places in the text.
//!
//! # Example
//! ```
//! use mbs_live::{Stepper, Text};
//! use mbs_runtime::equations::At;
//! use mbs_runtime::{Explicit, Gains};
//!
//! let text = "Pendulum {
//!     dof = 1;
//!     param length = 1 [m];
//!     gravity = (0, -9.81) [m/s^2];
//!     body bob (x, y) { mass = 2 [kg]; }
//!     constraint rod: x^2 + y^2 = length^2;
//!     start { x = length; guess y = 0; }
//! }";
//! let pendulum = Text::declaration("pendulum.mbs", text).compile()?;
//!
//! let (h, mut q, mut v) = (1e-3, vec![1.0, 0.0], vec![0.0, 0.0]);
//! let method = Explicit::default();
//! let [alpha, beta] = method.deadbeat(h);
//! let gains = Gains { minus_two_alpha: -2.0 * alpha, minus_beta_squared: -beta * beta };
//! let mut steps = Stepper::new(&pendulum, method);
//! for k in 0..500 {
//!     let t = f64::from(k) * h;
//!     let growth = steps.step(At { t, q: &q, v: &v }, &[], &gains, h, t + h);
//!     assert!(growth < 10.0);
//!     (q, v) = (steps.q().to_vec(), steps.v().to_vec());
//! }
//! assert!(q[1] < -0.8);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How it runs
//! Each program of the compiled mechanism becomes flat code: operations on numbered slots,
//! which are taken again as soon as their numbers are no longer read. The code is followed
//! once and compared with its program before anything runs. A step is one program where the
//! compiler has fused it, else its stages one after the other. Compiled Rust weaves that
//! one program into pairs, which may give a zero the other sign; all other bits agree.
#![forbid(unsafe_code)]

mod arguments;
mod block;
mod check;
mod code;
mod equations;
mod error;
mod excerpt;
mod find;
mod folder;
mod grouped;
mod instruction;
mod lanes;
mod lexing;
mod live;
mod prepared;
mod products;
mod run;
mod slots;
mod sources;
mod statics;
mod stepper;
mod steps;
mod text;
mod transposed;
mod words;

pub use mbs_codegen::compiled::Feedback;
pub use mbs_codegen::targets::{CSources, Experiment, Fmu, RUN_SCRIPTS, Scalar, Version as FmiVersion, Wasm};

pub use error::{Error, Location, Note, Problem, Warnings};
pub use lanes::LANES;
pub use live::Live;
pub use prepared::Prepared;
pub use run::{Builder, Pack, Run};
pub use stepper::Stepper;
pub use text::{LONGEST, Text};
