//! Statements before and behind a loop.

use mbs_symbolic::layout::Kept;
use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};

use super::columns::store;
use super::context::Context;
use crate::targets::rust::places;

/// Statements around a loop.
#[derive(Default)]
pub struct Around {
    pub before: TokenStream,
    pub after: TokenStream,
    /// How many results of the last copy are kept so far.
    count: usize,
}

impl Around {
    /// Keeps the result of a step: that of every copy at once, that of the last one after
    /// the loop.
    pub fn keep(&mut self, context: &Context<'_>, kept: Kept, value: &impl ToTokens) -> TokenStream {
        let Kept::Last(place) = kept else { return store(context, kept, value) };
        let last = format_ident!("last_{}", self.count);
        self.count += 1;
        let place = places::element(place);
        self.before.extend(quote!(let mut #last = T::from_f64(0.0);));
        self.after.extend(quote!(#place = #last;));
        quote!(#last = #value;)
    }
}
