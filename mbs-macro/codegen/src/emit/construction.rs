//! How a mechanism comes to be: its parameters, checked, and what depends on
//! them alone.

use mbs_symbolic::Stage;
use proc_macro2::TokenStream;
use quote::quote;

use super::access::Access;
use super::names::Names;
use super::program::{Body, body};
use super::splines::splines;
use crate::model::{Check, Direction, Model};
use crate::plan::Plan;
use crate::syntax::Comparison;

/// `new`, `declared`, `prepare` and access to the parameters.
pub fn emit(model: &Model, plan: &Plan, names: &Names) -> TokenStream {
    let Names { mechanism, parameters, runtime, .. } = names;
    let checks = parameter_checks(model, plan, names);
    let splines = splines(model, names);
    let Body { statements, outputs, .. } = body(model, names, &plan.prepare, &Access::of_parameters());
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
            #[allow(unused_variables, clippy::all)]
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

fn parameter_checks(model: &Model, plan: &Plan, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    let Body { statements, outputs, .. } = body(model, names, &plan.requirements, &Access::of_parameters());
    let mut outputs = outputs.into_iter();
    let mut checks = TokenStream::new();
    for requirement in &model.requirements {
        let (difference, value) = (outputs.next(), outputs.next());
        let comparison = match requirement.comparison {
            Comparison::Less => quote!(<),
            Comparison::LessOrEqual => quote!(<=),
            Comparison::Greater => quote!(>),
            Comparison::GreaterOrEqual => quote!(>=),
        };
        let (name, text) = (&requirement.name, &requirement.text);
        checks.extend(quote! {
            if !(#difference #comparison T::from_f64(0.0)) {
                return ::core::result::Result::Err(#runtime::Error::Parameter {
                    name: #name,
                    value: (#value).to_f64(),
                    requirement: #text,
                });
            }
        });
    }
    for (coordinate, mass) in model.coordinates.iter().zip(outputs.by_ref()) {
        let body = &model.bodies[coordinate.body];
        let what = if coordinate.direction == Direction::Angle { "inertia" } else { "mass" };
        let name = format!("{what} of {}", body.name);
        let is_repeated =
            coordinate.direction == Direction::Y && model.coordinate_of(body, Direction::X).is_some();
        if is_repeated {
            continue;
        }
        checks.extend(quote! {
            if !(#mass >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(#runtime::Error::Parameter {
                    name: #name,
                    value: (#mass).to_f64(),
                    requirement: "it must not be negative",
                });
            }
        });
    }
    let is_known = |check: &&Check| model.arena.stage(check.value) == Stage::Parameter;
    for (check, value) in model.checks.iter().filter(is_known).zip(outputs) {
        let comparison = if check.is_strict { quote!(>) } else { quote!(>=) };
        let requirement = check.rule();
        let name = format!("{} of {}", check.property, check.owner);
        checks.extend(quote! {
            if !(#value #comparison T::from_f64(0.0)) {
                return ::core::result::Result::Err(#runtime::Error::Parameter {
                    name: #name,
                    value: (#value).to_f64(),
                    requirement: #requirement,
                });
            }
        });
    }
    quote! {
        #[allow(unused_variables)]
        #[allow(clippy::all)]
        {
            #statements
            #checks
        }
    }
}
