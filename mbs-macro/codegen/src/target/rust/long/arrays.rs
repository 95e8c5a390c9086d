//! Vectors with named components as arrays, for loops over them.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::compiled::{Compiled, Input};
use crate::target::rust::access::{Access, Argument};
use crate::target::rust::names::Names;

/// The arrays that a program's loops read, and their lengths.
#[derive(Default)]
pub struct Arrays {
    lengths: BTreeMap<Array, usize>,
}

/// A vector that programs depend on.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Array {
    Parameters,
    Inputs,
    Positions,
    Velocities,
    Accelerations,
    Multipliers,
    Feedback,
}

impl Array {
    /// The vector and the place of a symbol in it; `None` of a single quantity.
    pub fn of(input: Input) -> Option<(Self, usize)> {
        Some(match input {
            Input::Parameter(at) => (Self::Parameters, at),
            Input::Input(at) => (Self::Inputs, at),
            Input::Position(at) => (Self::Positions, at),
            Input::Velocity(at) => (Self::Velocities, at),
            Input::Acceleration(at) => (Self::Accelerations, at),
            Input::Multiplier(at) => (Self::Multipliers, at),
            Input::Feedback(at) => (Self::Feedback, at),
            Input::Time
            | Input::MinusTwoAlpha
            | Input::MinusBetaSquared
            | Input::Step
            | Input::HalfStep
            | Input::NextTime => return None,
        })
    }

    /// Whether stages on arrays are given the vector as one.
    pub fn is_given(self) -> bool {
        matches!(self, Self::Positions | Self::Velocities | Self::Feedback)
    }

    pub fn ident(self) -> Ident {
        let name = match self {
            Self::Parameters => "parameter",
            Self::Inputs => "input",
            Self::Positions => "position",
            Self::Velocities => "velocity",
            Self::Accelerations => "acceleration",
            Self::Multipliers => "multiplier",
            Self::Feedback => "feedback",
        };
        format_ident!("{name}_array")
    }

    fn length(self, compiled: &Compiled) -> usize {
        match self {
            Self::Parameters => compiled.parameters.len(),
            Self::Inputs => compiled.inputs.len(),
            Self::Positions | Self::Velocities | Self::Accelerations => compiled.coordinates.len(),
            Self::Multipliers | Self::Feedback => compiled.constraints.len(),
        }
    }

    /// The vector in the function around the loops.
    fn place(self, access: &Access) -> TokenStream {
        let Access { parameters, positions, velocities, .. } = access;
        match self {
            Self::Parameters => quote!(#parameters),
            Self::Inputs => quote!(*inputs),
            Self::Positions if access.is_borrowed() => quote!(*#positions),
            Self::Positions => quote!(#positions),
            Self::Velocities => quote!(#velocities),
            Self::Accelerations => quote!(reactions.acceleration),
            Self::Multipliers => quote!(reactions.multipliers),
            Self::Feedback => quote!(*feedback),
        }
    }
}

impl Arrays {
    /// The array as an argument of a function.
    pub fn argument(&mut self, array: Array, compiled: &Compiled, access: &Access) -> Argument {
        let (ident, length) = (array.ident(), array.length(compiled));
        let is_given = access.is_on_arrays() && array.is_given();
        let value = if is_given {
            quote!(#ident)
        } else {
            self.lengths.insert(array, length);
            quote!(&#ident)
        };
        let length = Literal::usize_unsuffixed(length);
        Argument { declaration: quote!(#ident: &[T; #length]), value }
    }

    pub fn declarations(&self, names: &Names, access: &Access) -> TokenStream {
        let runtime = &names.runtime;
        let declaration = |array: &Array| {
            let (ident, place) = (array.ident(), array.place(access));
            quote!(let #ident = #runtime::Components::into_array(#place);)
        };
        self.lengths.keys().map(declaration).collect()
    }
}
