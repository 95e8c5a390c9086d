//! The compiler behind `mechanism!`: an ordinary library, so that tools and
//! tests run the same code as the macro.
//!
//! One stage, one type, one module; data flows down this list:
//!
//! | stage | gives | after it |
//! |---|---|---|
//! | `files` | tokens | tables have their points, whatever file they come from |
//! | `syntax` | `Declaration`, a span on every node | shapes are right, names unresolved |
//! | `compose` | `Declaration` | sub-assemblies are gone, only plain statements are left |
//! | `model` | `Model` | names are symbols, dimensions agree |
//! | `inputs` | `Inputs` | what a method adds to the symbols of a declaration (step, gains, feedback) has symbols |
//! | `derive` | `Equations` | what follows computes with expressions; bodies, joints and forces are left for words |
//! | `independence` | `Rows` | constraints to solve for are chosen; they are independent, and the contract holds |
//! | `reduction` | `Reduction` | coordinates to integrate are chosen |
//! | `stiff` | `Stiffness` | an implicit stage has its own masses and forces |
//! | `plan` | `Plan` | programs: elimination fixed, loads that follow reactions solved for, parameter-only work hoisted |
//! | `validate` | – | the mechanism closes from its start, is regular there and keeps its values |
//! | `compiled` | `Compiled` | declaration and equations are left as texts; programs have names |
//! | `targets` | tokens, C, or WebAssembly | what is written computes what was checked |
//!
//! `mechanics` is no stage: formulas and facts of joints, forces and equations, which the
//! first stages read and `derive` puts together.
//!
//! Errors of a stage are collected and shown together; a stage with errors is
//! the last.
//!
//! # Why
//!
//! A mechanism is known when its solver is compiled. So the compiler does everything that does not depend on
//! the state. It checks names, units and consistency. It differentiates constraints, and fixes the order in
//! which the constrained system is eliminated. A list of floating-point operations is left. The runtime adds
//! an integrator and nothing else.
//!
//! # Imports
//!
//! Imports run one way along the stages. A test reads them (`tests/tests/house.rs`).
#![forbid(unsafe_code)]

pub mod compiled;
mod compose;
mod derive;
mod diagnostics;
mod files;
mod independence;
mod inputs;
mod mechanics;
mod model;
mod plan;
mod quantity;
mod reactive;
mod reduction;
mod stiff;
mod syntax;
pub mod targets;
mod validate;

use proc_macro2::TokenStream;

pub use compiled::{Compiled, FunctionId};
pub use diagnostics::{Diagnostic, Diagnostics};
pub use files::{Read, with_files};
pub use syntax::{Keyword, KeywordKind, keywords};

/// The expansion of `mechanism! { … }`, whose files are read by the function; errors become `compile_error!`.
#[cfg(feature = "rust")]
pub fn expand(declaration: TokenStream, read: Read<'_>) -> TokenStream {
    let compiled = with_files(declaration, read).and_then(compile);
    compiled.unwrap_or_else(|errors| errors.to_compile_errors())
}

/// Compiles a declaration to Rust.
///
/// # Errors
/// All errors of the first stage that has any.
#[cfg(feature = "rust")]
pub fn compile(declaration: TokenStream) -> Result<TokenStream, Diagnostics> {
    targets::rust(&analyse(declaration)?)
}

/// Compiles a declaration to what every target is printed from: the whole pipeline.
///
/// # Errors
/// All errors of the first stage that has any.
pub fn analyse(declaration: TokenStream) -> Result<Compiled, Diagnostics> {
    let declaration = syntax::parse(declaration)?;
    let declaration = compose::compose(declaration)?;
    let mut model = model::resolve(&declaration)?;
    let mut inputs = inputs::Inputs::new(&mut model);
    let equations = derive::derive(&mut model, &inputs);
    let samples = independence::Samples::new(&model, &inputs);
    let rows = independence::check_equations(&model, &equations, &samples)?;
    let reduction = reduction::reduce(&mut model, &equations, &rows, &mut inputs);
    let plan = plan::plan(&mut model, &equations, &rows, &samples, inputs, reduction)
        .map_err(|error| validate::unsolvable(&model, &error))?;
    validate::check_closure(&model, &equations, &plan)?;
    validate::check_limit(&model, &plan)?;
    validate::check_programs(&model, &equations, &plan, &samples)?;
    Ok(Compiled::new(model, &equations, plan))
}
