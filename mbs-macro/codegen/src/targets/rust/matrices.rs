//! The dense matrices Φ_q and M, for people and for comparison: the solver does
//! not use them.

use std::collections::BTreeMap;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::body::Body;
use super::docs;
use super::names::Names;
use super::program::body;
use crate::compiled::{Compiled, FunctionId};

/// Larger matrices are not offered: returned by value, 2¹⁷ entries are 1 MiB of
/// stack.
const MOST_ENTRIES: usize = 1 << 17;

pub fn emit(compiled: &Compiled, names: &Names, docs: &docs::Functions<'_>) -> TokenStream {
    let nalgebra = &names.nalgebra;
    let (n, m) = (compiled.coordinates.len(), compiled.constraints.len());
    if n * n.max(m) > MOST_ENTRIES {
        return TokenStream::new();
    }
    let q = &names.coordinates.of_t;
    let position = Access::of_position();
    let phi_q = {
        let Body { statements, outputs, .. } = body(compiled, names, FunctionId::PhiQ, &position);
        let entries = compiled.jacobian.iter().copied().zip(outputs).collect();
        let matrix = matrix(nalgebra, (m, n), &entries);
        quote!(#statements #matrix)
    };
    let mass = {
        let Body { statements, outputs, .. } = body(compiled, names, FunctionId::Mass, &position);
        let halves = compiled.masses.iter().zip(outputs);
        let entries = halves.flat_map(|(&(i, j), mass)| [((i, j), mass.clone()), ((j, i), mass)]).collect();
        let matrix = matrix(nalgebra, (n, n), &entries);
        quote!(#statements #matrix)
    };
    let phi_q_doc = docs.with_text(
        FunctionId::PhiQ,
        "Jacobian Φ_q, one row per constraint, one column per coordinate. Entries that are not 0:",
    );
    let mass_doc = docs.with_text(FunctionId::Mass, "Mass matrix M. Entries that are not 0:");
    quote! {
        #[doc = #phi_q_doc]
        #[inline]
        pub fn phi_q(&self, t: T, q: &#q) -> #nalgebra::SMatrix<T, #m, #n> { #phi_q }

        #[doc = #mass_doc]
        #[inline]
        pub fn mass(&self, q: &#q) -> #nalgebra::SMatrix<T, #n, #n> { #mass }
    }
}

/// A matrix: written out, or if it is large and so mostly zeros, by its entries.
fn matrix(
    nalgebra: &TokenStream,
    (rows, columns): (usize, usize),
    entries: &BTreeMap<(usize, usize), TokenStream>,
) -> TokenStream {
    const LARGEST_WRITTEN_OUT: usize = 400;
    if rows * columns <= LARGEST_WRITTEN_OUT {
        let columns = (0..columns).map(|column| {
            let entry =
                |row| entries.get(&(row, column)).cloned().unwrap_or_else(|| quote!(T::from_f64(0.0)));
            let entries = (0..rows).map(entry);
            quote!([#(#entries),*])
        });
        return quote!(#nalgebra::SMatrix::from_data(#nalgebra::ArrayStorage([#(#columns),*])));
    }
    let assignments = entries.iter().map(|(&(row, column), value)| {
        let (row, column) = (Literal::usize_unsuffixed(row), Literal::usize_unsuffixed(column));
        quote!(matrix.data.0[#column][#row] = #value;)
    });
    quote! {
        let mut matrix = #nalgebra::SMatrix::from_data(#nalgebra::ArrayStorage([[T::from_f64(0.0); #rows]; #columns]));
        #(#assignments)*
        matrix
    }
}
