//! Stops: their gaps, and how a mechanism answers impulses along them.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::names::Names;
use super::program::body;
use crate::compiled::{Compiled, FunctionId, Results};

/// The functions of stops; nothing without one.
pub fn stops(compiled: &Compiled, names: &Names) -> TokenStream {
    if compiled.contacts() == 0 {
        return TokenStream::new();
    }
    let Names { state, reactions, .. } = names;
    let inputs = &names.inputs.of_t;
    let q = &names.coordinates.of_t;
    let values = |function: FunctionId, of: Results, access: &Access| {
        let body = body(compiled, names, function, access);
        let count = compiled.length(of);
        let (statements, values) = (&body.statements, body.array(0..count));
        let count = Literal::usize_unsuffixed(count);
        quote!(let values: [T; #count] = { #statements #values };)
    };
    let laws = values(FunctionId::Stops, Results::Stops, &Access::of_position());
    let gaps = values(FunctionId::Gaps, Results::Gaps, &Access::of_state());
    let limits = values(FunctionId::Limits, Results::Limits, &Access::of_state());
    let contacts = values(FunctionId::Contacts, Results::Contacts, &Access::of_position());
    quote! {
        fn stop_laws(&self, laws: &mut [T]) {
            #laws
            for (to, from) in laws.iter_mut().zip(values) {
                *to = from;
            }
        }
        fn gaps(&self, at: &#state, reactions: &#reactions, gaps: &mut [T]) {
            #gaps
            for (to, from) in gaps.iter_mut().zip(values) {
                *to = from;
            }
        }
        fn limits(&self, at: &#state, inputs: &#inputs, reactions: &#reactions, limits: &mut [T]) {
            #limits
            for (to, from) in limits.iter_mut().zip(values) {
                *to = from;
            }
        }
        fn contacts(&self, t: T, q: &#q, what: &mut dyn ::core::ops::FnMut(&[T])) {
            #contacts
            what(&values);
        }
    }
}
