//! How generated code names the places of results.

use mbs_symbolic::layout::{Array, Place};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// The array of the result q̈ itself.
pub const ACCELERATION: Array = Array::Result(0);

/// The array of the feedback.
pub const FEEDBACK: Array = Array::Result(1);

/// The variable that holds an array.
pub fn array(array: Array) -> Ident {
    match array {
        Array::Slots => format_ident!("slots"),
        ACCELERATION => format_ident!("acceleration"),
        // stages return nothing else
        Array::Result(_) => format_ident!("feedback"),
    }
}

/// An element of an array.
pub fn element(place: Place) -> TokenStream {
    let (array, at) = (array(place.array), Literal::usize_unsuffixed(place.at));
    quote!(#array[#at])
}
