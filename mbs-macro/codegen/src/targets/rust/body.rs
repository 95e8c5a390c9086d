//! The statements of a program with its outputs, and how functions return these.

use std::ops::Range;

use mbs_symbolic::Program;
use mbs_symbolic::layout::{Array, Place};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::names::Names;
use super::{places, tokens};

/// Statements that run a program, and its outputs.
pub struct Body {
    pub statements: TokenStream,
    /// As expressions.
    pub outputs: Vec<TokenStream>,
    /// Of a long program, where they are kept.
    pub places: Option<Vec<Place>>,
    /// The number of slots of a long program.
    pub slots: usize,
    pub runtime: TokenStream,
}

impl Body {
    /// A stand-in for a program that cannot be written; nobody gets to see it.
    pub fn none(program: &Program, names: &Names) -> Self {
        let outputs = vec![tokens::internal("a program has no layout"); program.outputs.len()];
        let runtime = names.runtime.clone();
        Self { statements: TokenStream::new(), outputs, places: None, slots: 0, runtime }
    }

    /// Some of the outputs as an array.
    pub fn array(&self, range: Range<usize>) -> TokenStream {
        let Some(places) = &self.places else {
            let outputs = &self.outputs[range];
            return quote!([#(#outputs),*]);
        };
        let (runtime, count) = (&self.runtime, Literal::usize_unsuffixed(range.len()));
        let places = places[range].iter().map(|place| Literal::usize_unsuffixed(place.at));
        quote! {{
            const PLACES: [::core::primitive::u32; #count] = [#(#places),*];
            #runtime::__private::gather(&slots, &PLACES)
        }}
    }

    /// Statements that write outputs of a long program into an array, each pair of an output and
    /// its element, but for those that are there already.
    pub fn write(&self, array: Array, pairs: impl Iterator<Item = (usize, usize)>) -> TokenStream {
        let runtime = &self.runtime;
        let literal = Literal::usize_unsuffixed;
        let places = self.places.as_deref().unwrap_or_default();
        let rows: Vec<_> = pairs
            .filter_map(|(output, to)| Some((places.get(output)?, to)))
            .filter(|(place, _)| place.array == Array::Slots)
            .map(|(place, to)| (literal(place.at), literal(to)))
            .map(|(from, to)| quote!([#from, #to]))
            .collect();
        if rows.is_empty() {
            return TokenStream::new();
        }
        let (array, count) = (places::array(array), literal(rows.len()));
        quote! {{
            const PLACES: [[::core::primitive::u32; 2]; #count] = [#(#rows),*];
            #runtime::__private::copy(slots, #array, &PLACES);
        }}
    }

    /// Statements that add outputs to elements of a slice, each pair of an output and its element.
    pub fn add(&self, slice: &TokenStream, pairs: &[(usize, usize)]) -> TokenStream {
        let literal = Literal::usize_unsuffixed;
        let Some(places) = &self.places else {
            let length = literal(pairs.iter().map(|(_, to)| to + 1).max().unwrap_or(0));
            let sums = pairs.iter().map(|&(output, to)| {
                let (value, to) = (&self.outputs[output], literal(to));
                quote!(sums[#to] = sums[#to] + #value;)
            });
            return quote! {{
                let sums = #slice.first_chunk_mut::<#length>()?;
                #(#sums)*
            }};
        };
        let runtime = &self.runtime;
        let rows = pairs.iter().map(|&(output, to)| {
            let (from, to) = (literal(places[output].at), literal(to));
            quote!([#from, #to])
        });
        let count = literal(pairs.len());
        quote! {{
            const PLACES: [[::core::primitive::u32; 2]; #count] = [#(#rows),*];
            #runtime::__private::add(&slots, #slice, &PLACES);
        }}
    }

    /// Some of the outputs as a vector with named components.
    pub fn vector(&self, of_t: &TokenStream, fields: &[Ident], range: Range<usize>) -> TokenStream {
        if self.places.is_some() && !fields.is_empty() {
            let (runtime, array) = (&self.runtime, self.array(range));
            return quote!(<#of_t as #runtime::Components>::from_array(#array));
        }
        named(of_t, fields, &self.outputs[range])
    }
}

/// A vector of type `of_t` with these components.
pub fn named(of_t: &TokenStream, fields: &[Ident], values: &[TokenStream]) -> TokenStream {
    if fields.is_empty() {
        return quote!(::core::default::Default::default());
    }
    // `Name<T>` as it stands in expressions
    let name = of_t.clone().into_iter().next();
    quote!(#name { #(#fields: #values),* })
}
