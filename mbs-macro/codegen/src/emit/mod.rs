//! Programs to Rust. Cannot fail: whatever could go wrong has been refused.

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
use crate::model::Model;
use crate::plan::Plan;
use names::Names;

/// The items of a mechanism.
pub fn emit(model: &Model, equations: &Equations, plan: &Plan) -> TokenStream {
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
    quote! {
        #types
        #construction
        #solver
        #functions
        #step
        #mechanism
    }
}
