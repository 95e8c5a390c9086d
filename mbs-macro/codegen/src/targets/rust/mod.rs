//! Rust: the items of a mechanism. Whatever could go wrong with a declaration has been refused; a layout in
//! loops and slots that does not compute what its program does is a mistake of the compiler.

mod access;
mod body;
mod construction;
mod contacts;
mod derivation;
mod docs;
mod functions;
mod info;
mod long;
mod matrices;
mod moments;
mod names;
mod on_pairs;
mod places;
mod program;
mod sketch;
mod solver;
mod splines;
mod stages;
mod step;
mod tokens;
mod transposes;
mod types;
mod weave;
mod writer;

use proc_macro2::TokenStream;
use quote::quote;

use crate::compiled::Compiled;
use crate::diagnostics::{Diagnostic, Diagnostics};
use names::Names;

/// The items of a mechanism.
///
/// # Errors
/// A program that is written in another way than it was checked in.
pub fn rust(compiled: &Compiled) -> Result<TokenStream, Diagnostics> {
    let names = Names::new(compiled);
    let types = types::emit(compiled, &names);
    let construction = construction::emit(compiled, &names);
    let solver = solver::emit(compiled, &names);
    let functions = functions::inherent(compiled, &names);
    let are_on_arrays = stages::are_on_arrays(compiled);
    let step = if are_on_arrays {
        stages::implementation(compiled, &names)
    } else {
        step::functions(compiled, &names).unwrap_or_else(|fault| {
            names.faults.borrow_mut().push(fault);
            TokenStream::new()
        })
    };
    let mechanism = functions::mechanism(compiled, &names, are_on_arrays);
    let transposes = transposes::implementation(compiled, &names);
    if let Some(fault) = names.faults.borrow().first() {
        return Err(Diagnostic::internal(compiled.written.name.span(), fault).into());
    }
    Ok(quote! {
        #types
        #construction
        #solver
        #functions
        #step
        #mechanism
        #transposes
    })
}
