//! How a mechanism comes to be: its parameters, checked, and what depends on
//! them alone.
//!
//! Parameters sit behind this constructor, because it computes everything that depends on them alone. So a
//! mechanism with a negative mass does not exist.

use proc_macro2::TokenStream;
use quote::quote;

use super::access::Access;
use super::body::Body;
use super::names::Names;
use super::program::body;
use super::splines::splines;
use super::tokens;
use crate::compiled::{Comparison, Compiled, Condition, FunctionId};

/// `new`, `declared`, `prepare` and access to the parameters.
pub fn emit(compiled: &Compiled, names: &Names) -> TokenStream {
    let Names { mechanism, parameters, runtime, .. } = names;
    let checks = parameter_checks(compiled, names);
    let splines = splines(compiled, names);
    let Body { statements, outputs, .. } =
        body(compiled, names, FunctionId::Hoisted, &Access::of_parameters());
    let lints = tokens::lints();
    quote! {
        impl #mechanism<::core::primitive::f64> {
            /// The mechanism with its declared parameters, in `f64`.
            ///
            /// For another scalar type, use `default`.
            pub fn declared() -> Self {
                ::core::default::Default::default()
            }
        }

        impl<T: #runtime::Real> #mechanism<T> {
            #(#splines)*

            /// The mechanism with these parameters.
            ///
            /// # Errors
            /// If a parameter is not finite, a mass or an inertia comes out
            /// negative, or a declared condition does not hold.
            pub fn new(parameters: #parameters<T>) -> ::core::result::Result<Self, #runtime::Error> {
                #runtime::__private::check_finite(&parameters)?;
                #checks
                ::core::result::Result::Ok(Self::prepare(parameters))
            }

            /// Computes what depends on parameters alone.
            #lints
            fn prepare(parameters: #parameters<T>) -> Self {
                #statements
                Self { parameters, hoisted: [#(#outputs),*] }
            }

            /// The parameters.
            pub fn parameters(&self) -> &#parameters<T> {
                &self.parameters
            }
        }
    }
}

fn parameter_checks(compiled: &Compiled, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    let Body { statements, outputs, .. } =
        body(compiled, names, FunctionId::Conditions, &Access::of_parameters());
    let checks = compiled.conditions.iter().map(|condition| {
        let Condition { name, comparison, requirement, .. } = condition;
        let (difference, value) = (&outputs[condition.difference], &outputs[condition.value]);
        let comparison = match comparison {
            Comparison::Less => quote!(<),
            Comparison::LessOrEqual => quote!(<=),
            Comparison::Greater => quote!(>),
            Comparison::GreaterOrEqual => quote!(>=),
        };
        quote! {
            if !(#difference #comparison T::from_f64(0.0)) {
                return ::core::result::Result::Err(#runtime::Error::Parameter {
                    name: #name,
                    value: (#value).to_f64(),
                    requirement: #requirement,
                });
            }
        }
    });
    let lints = tokens::lints();
    quote! {
        #lints
        {
            #statements
            #(#checks)*
        }
    }
}
