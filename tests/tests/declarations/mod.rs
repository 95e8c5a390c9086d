//! The declarations of the mechanisms in `models`, as token streams.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use proc_macro2::TokenStream;

/// Name and declaration of every mechanism that the tests look at.
pub fn of_models() -> [(&'static str, TokenStream); 3] {
    [
        ("slider_crank", declaration(include_str!("../../../models/src/slider_crank.rs"))),
        ("slider_crank_free", declaration(include_str!("../../../models/src/slider_crank_free.rs"))),
        ("pendulum", declaration(include_str!("../../../models/src/pendulum.rs"))),
    ]
}

/// The declaration in the first `mechanism! { … }` of a file.
fn declaration(source: &str) -> TokenStream {
    let file = syn::parse_file(source).expect("models are Rust");
    let mut macros = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Macro(item) if item.mac.path.is_ident("mechanism") => Some(item.mac.tokens),
        _ => None,
    });
    macros.next().expect("a model declares a mechanism")
}
