//! Programs to Rust. Whatever could go wrong with a declaration has been refused; a layout in
//! loops and slots that does not compute what its program does is a mistake of the compiler.

mod access;
mod construction;
mod derivation;
mod docs;
mod functions;
mod info;
mod long;
mod matrices;
mod names;
mod program;
mod sketch;
mod solver;
mod splines;
mod stages;
mod step;
mod types;

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::model::Model;
use crate::plan::Plan;
use names::Names;

/// The items of a mechanism.
///
/// # Errors
/// A program that is written in another way than it was checked in.
pub fn emit(model: &Model, equations: &Equations, plan: &Plan) -> Result<TokenStream, Diagnostics> {
    let names = Names::new(model);
    let types = types::emit(model, plan, equations, &names);
    let construction = construction::emit(model, plan, &names);
    let solver = solver::emit(model, plan, &names);
    let functions = functions::inherent(model, equations, plan, &names);
    let are_on_arrays = stages::are_on_arrays(model, plan);
    let step = if are_on_arrays {
        stages::implementation(model, plan, &names)
    } else {
        step::functions(model, plan, &names)
    };
    let mechanism = functions::mechanism(model, equations, plan, &names, are_on_arrays);
    if let Some(fault) = names.faults.borrow().first() {
        return Err(Diagnostic::internal(model.name.span(), fault).into());
    }
    Ok(quote! {
        #types
        #construction
        #solver
        #functions
        #step
        #mechanism
    })
}
