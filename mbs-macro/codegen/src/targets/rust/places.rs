//! How generated code names arrays, and places in them.

use mbs_symbolic::layout::{Array, Place};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::compiled::Vector;

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

impl Vector {
    /// True if stages on arrays are given the vector as one.
    pub(super) fn is_given(self) -> bool {
        match self {
            Self::Positions
            | Self::Velocities
            | Self::StatePositions
            | Self::StateVelocities
            | Self::Feedback => true,
            Self::Parameters
            | Self::Inputs
            | Self::Accelerations
            | Self::Multipliers
            | Self::Predicted
            | Self::Weights => false,
        }
    }

    /// The name of its array.
    pub(super) fn ident(self) -> Ident {
        let name = match self {
            Self::Parameters => "parameter",
            Self::Inputs => "input",
            // no function is given both
            Self::Positions | Self::StatePositions => "position",
            Self::Velocities | Self::StateVelocities => "velocity",
            Self::Accelerations => "acceleration",
            Self::Multipliers => "multiplier",
            Self::Feedback => "feedback",
            Self::Predicted => "predicted",
            Self::Weights => "weight",
        };
        format_ident!("{name}_array")
    }
}
