//! Vectors with named components as arrays, for loops over them.

use std::collections::BTreeSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::compiled::{Compiled, Vector};
use crate::targets::rust::access::{Access, Argument};
use crate::targets::rust::names::Names;

/// The vectors that a program's loops read as arrays.
#[derive(Default)]
pub struct Arrays(BTreeSet<Vector>);

impl Vector {
    /// The vector in the function around the loops.
    fn place(self, access: &Access) -> TokenStream {
        let Access { parameters, positions, velocities, .. } = access;
        match self {
            Self::Parameters => quote!(#parameters),
            Self::Inputs => quote!(*inputs),
            Self::Positions if access.is_borrowed() => quote!(*#positions),
            Self::Positions | Self::StatePositions => quote!(#positions),
            Self::Velocities | Self::StateVelocities => quote!(#velocities),
            Self::Accelerations => quote!(reactions.acceleration),
            Self::Multipliers => quote!(reactions.multipliers),
            Self::Feedback => quote!(*feedback),
            Self::Predicted => quote!(*predicted),
            Self::Weights => quote!(*weights),
        }
    }
}

impl Arrays {
    /// The array as an argument of a function.
    pub fn argument(&mut self, vector: Vector, compiled: &Compiled, access: &Access) -> Argument {
        let ident = vector.ident();
        let value = if access.has_array(vector) {
            quote!(#ident)
        } else {
            self.0.insert(vector);
            quote!(&#ident)
        };
        let length = Literal::usize_unsuffixed(access.components(compiled, vector));
        Argument { declaration: quote!(#ident: &[T; #length]), value }
    }

    pub fn declarations(&self, names: &Names, access: &Access) -> TokenStream {
        let runtime = &names.runtime;
        let declaration = |vector: &Vector| {
            let (ident, place) = (vector.ident(), vector.place(access));
            quote!(let #ident = #runtime::Components::into_array(#place);)
        };
        self.0.iter().map(declaration).collect()
    }
}
