//! Declare a mechanism, get a solver.
//!
//! [`mechanism!`] takes bodies, constraints and forces, differentiates the
//! constraints symbolically at compile time, checks them, eliminates the
//! constrained system, and emits straight-line Rust. This crate integrates the
//! result with Heun's method or one of higher order, with Baumgarte feedback or projection,
//! in constant steps or to a tolerance, on the stack: no heap, no panic, no `unsafe`, `no_std`.
//!
//! # Example
//!
//! ```
//! use mbs_runtime::{Simulation, mechanism};
//!
//! mechanism! {
//!     /// Slider-crank driven at constant speed.
//!     pub SliderCrank {
//!         dof = 0;
//!         param crank = 60 [mm];
//!         param rod = 180 [mm];
//!         param omega = 200 [rpm];
//!         body wheel  (angle = phi) { inertia = 0.001 [kg*m^2]; }
//!         body link   (angle = psi) { inertia = 0.003 [kg*m^2]; }
//!         body slider (x)          { mass = 2 [kg]; }
//!         constraint guide: crank*sin(phi) + rod*sin(psi) = 0;
//!         constraint pin: x = crank*cos(phi) + rod*cos(psi);
//!         drive speed: phi = omega*t;
//!         output torque [N*m] = effort(speed);
//!     }
//! }
//!
//! let mut run = Simulation::new(SliderCrank::declared(), 0.5e-3)?;
//! run.advance_to(0.3)?;
//! assert!((run.state().q.x - 0.24).abs() < 1e-6); // one turn
//! # Ok::<(), mbs_runtime::Error>(())
//! ```
//!
//! Where to go from here:
//!
//! * [`language`]: what can be declared, and what is generated;
//! * [`methods`]: schemes, what keeps the constraints, runs to a tolerance;
//! * [`gradients`]: derivatives of runs by parameters, start and inputs;
//! * [`Simulation`]: integration in time with a constant step; [`Builder`] has the choices;
//! * [`Adaptive`]: integration to a tolerance;
//! * [`Baumgarte`]: feedback, its gains and when they are stable;
//! * [`Kinematics`]: the motion of a fully driven mechanism, without integration;
//! * [`System`]: a run as tools see it, on slices, of any mechanism;
//! * [`equations`]: equations, starts and steps on slices, without named components;
//! * [`Error`]: what can go wrong.
//!
//! # Symbols
//!
//! | here | | shape |
//! |---|---|---|
//! | `q`, `v` | coordinates q and velocities v = q̇ | n |
//! | `phi` | constraints Φ(q, t) | m |
//! | `phi_q`, `phi_t` | Jacobian Φ_q, partial time derivative Φ_t | m × n, m |
//! | `phi_dot` | Φ̇ = Φ_q v + Φ_t | m |
//! | `gamma` | γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt | m |
//! | `mass` | mass matrix M | n × n |
//! | `forces` | generalized forces Q | n |
//! | `acceleration` | q̈ | n |
//! | `multipliers` | Lagrange multipliers λ | m |
//! | `alpha`, `beta` | feedback gains α, β in 1/s | |
//! | `step` | step h in s | |
//!
//! M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ − 2αΦ̇ − β²Φ; SI units, angles in radians.
//! The equation numbers in this documentation are those of Z. Jiang, "Dynamic
//! Modeling of Multi-body Systems: A Numerical Study on Crank-slider
//! Mechanism" (2025), doi:10.26855/oajrcap.2025.12.001.
//!
//! # Method and limits
//!
//! Schemes are explicit: the step has to resolve the fastest motion, and stiff springs need
//! small ones, or [`TrBdf2`]. [`Heun`]'s method, the default, is of second order, others are of up to eighth;
//! see [`methods`]. The feedback keeps the constraint violation small, proportional to the
//! error of a step (h³ with Heun's method), it does not remove it; the
//! [`Builder::baumgarte`] gains must be [stable](Baumgarte::is_stable) for the
//! step. In singular positions, where constraints depend on each other, the
//! accelerations are not determined: that is a typed error, found by watching
//! the pivots of the elimination, not a wrong number.
//!
//! # Compile time
//!
//! Cargo does not optimise macros, not even for `--release`. Where mechanisms are large,
//! have it do so for this one, in the manifest of the workspace, and the same under
//! `[profile.release.package]`:
//!
//! ```toml
//! [profile.dev.package]
//! mbs-macro.opt-level = 3
//! mbs-codegen.opt-level = 3
//! mbs-symbolic.opt-level = 3
//! proc-macro2.opt-level = 3
//! quote.opt-level = 3
//! syn.opt-level = 3
//! ```
//!
//! A slider-crank then takes less than 0.1 s, a chain of ten rods 0.3 s instead of 4 s, a
//! row of two hundred four-bars 1.5 s instead of 9 s. Crates made by `mbs new` have it.
//!
//! # Features
//!
//! `std` (default): elementary functions from the standard library. Without it
//! the crate is `no_std` and takes them from `libm`.
//!
//! `macro` (default): `mechanism!` and the matrices of generated code. Without it the crate
//! has what runs any mechanism.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

mod adaptive;
#[doc(hidden)]
pub mod arrays;
mod baumgarte;
mod bounds;
mod changes;
mod components;
mod constant;
mod contact;
mod corners;
mod declared;
mod derivation;
mod diagnosis;
mod dual;
mod eliminating;
pub mod equations;
mod error;
pub mod explicit;
mod floats;
pub mod gradients;
mod halting;
pub mod implicit;
mod info;
#[doc = include_str!("language.md")]
pub mod language {}
#[doc = include_str!("methods.md")]
#[doc = include_str!("precision.svg")]
#[doc = include_str!("energy.svg")]
#[doc = include_str!("stiff.svg")]
pub mod methods {}
mod kinematics;
pub mod lanes;
mod locks;
mod mechanism;
mod method;
mod modes;
mod moreau;
mod pack;
mod pair;
mod partials;
mod pivoting;
mod pressing;
mod reach;
mod real;
mod refusals;
pub mod reverse;
mod room;
mod rubbing;
mod run;
mod samples;
mod simulation;
mod sincos;
pub mod sketch;
mod spare;
mod spline;
pub mod start;
mod sticking;
mod straight;
mod striking;
mod system;
mod touching;
mod two;
mod vectors;
mod view;
mod watch;

pub use adaptive::{
    Adaptive, AdaptiveBuilder, AdaptiveScheme, Dynamics, Effort, Event, MOST_EVENTS, Measured, Moment,
    Sampled, Threshold, Tolerances,
};
pub use baumgarte::Baumgarte;
pub use components::{Components, NoComponents};
pub use constant::{ConstantStep, ConstantStepBuilder, Kernel, Rattle, RattleStep, TrBdf2, TrBdf2Step};
pub use corners::{Knots, Switch};
pub use declared::{
    DeclaredEvent, DeclaredFriction, DeclaredLock, DeclaredMode, DeclaredStop, DeclaredTransition, Modes,
};
pub use derivation::{Derivation, Elimination, Formula};
pub use dual::Dual;
pub use error::Error;
pub use info::{Constraint, Dimension, Direction, Function, Info, Operations, Pivot, Quantity, Sampling};
pub use kinematics::{Kinematics, Motion};
pub use lanes::Lanes;
pub use mbs_interface::implicit::*;
pub use mbs_interface::schemes::*;
pub use mbs_interface::sine::Octant;
pub use mbs_interface::{COMPOSITIONS, Composition, Explicit, RATTLE, RATTLE4, Row, Stabilization, Tableau};
#[cfg(feature = "macro")]
pub use mbs_macro::mechanism;
pub use mechanism::{Accelerations, Gains, Mechanism, Reactions, Stabilized, State, Stepped, growth_limit};
pub use method::*;
pub use pack::Pack;
pub use pair::{Pair, Single, Term};
pub use real::Real;
pub use simulation::{Builder, Simulation};
pub use sketch::Sketch;
pub use system::System;
#[cfg(feature = "std")]
pub use system::SystemClone;
pub use two::{NoTerm, Two};
pub use watch::WorstPlace;

/// The interface that generated code calls. Not part of the public interface.
#[doc(hidden)]
pub mod __private;
