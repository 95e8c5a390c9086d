//! The `mechanism!` macro. Use it through `mbs-runtime`, which re-exports it;
//! the compiler itself is the ordinary library `mbs-codegen`.

use proc_macro::TokenStream;

/// Declares a mechanism and generates its solver.
///
/// The language is described in the documentation of `mbs-runtime`.
#[proc_macro]
pub fn mechanism(declaration: TokenStream) -> TokenStream {
    mbs_codegen::expand(declaration.into()).into()
}
