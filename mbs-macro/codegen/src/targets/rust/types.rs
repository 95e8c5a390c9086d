//! The generated structs: the mechanism and its vectors with named components.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::docs;
use super::names::{Names, field};
use super::tokens;
use crate::compiled::{Compiled, Quantity, Results, Setting};
use crate::targets::words;

/// Vectors with more components are converted by calls.
const LARGEST_INLINED: usize = 64;

/// A field of a generated struct: name, documentation, declared value.
struct Field {
    name: Ident,
    text: String,
    doc: String,
    value: f64,
}

pub fn emit(compiled: &Compiled, names: &Names) -> TokenStream {
    let Names { mechanism, parameters, runtime, .. } = names;
    let visibility = &compiled.written.visibility;
    let doc = docs::mechanism(compiled);
    let hoisted = compiled.length(Results::Hoisted);
    let hoisted_doc = docs::hoisted(compiled);
    let parameter_fields: Vec<_> = compiled
        .parameters
        .iter()
        .map(|it| setting(it, words::quantity(&it.quantity, Some(it.value))))
        .collect();
    let parameter_doc =
        format!("Parameters of [`{mechanism}`], in SI units; the default is the declaration.");
    let parameters = components(visibility, parameters, names, &parameter_doc, &parameter_fields);
    let inputs = names.inputs.name.as_ref().map(|name| {
        let fields: Vec<_> = compiled.inputs.iter().map(|it| setting(it, words::input(it))).collect();
        let doc = format!("Inputs of [`{mechanism}`], set by the embedding program, in SI units.");
        components(visibility, name, names, &doc, &fields)
    });
    let coordinate = |at: usize| {
        let name = &compiled.coordinates[at].name;
        Field { name: field(name), text: name.clone(), doc: words::coordinate(compiled, at), value: 0.0 }
    };
    let coordinates = names.coordinates.name.as_ref().map(|name| {
        let fields: Vec<_> = (0..compiled.coordinates.len()).map(coordinate).collect();
        let doc = format!("Coordinates of [`{mechanism}`], or their rates, in SI units.");
        components(visibility, name, names, &doc, &fields)
    });
    let states = names.states.name.as_ref().map(|name| {
        let fields: Vec<_> = compiled.states.iter().map(|&at| coordinate(at)).collect();
        let doc = format!(
            "Coordinates that are integrated of [`{mechanism}`], or their rates, in SI units; constraints give the others."
        );
        components(visibility, name, names, &doc, &fields)
    });
    let outputs = names.outputs.name.as_ref().map(|name| {
        let fields: Vec<_> = compiled.outputs.iter().map(output).collect();
        let doc = format!("Outputs of [`{mechanism}`], in SI units.");
        components(visibility, name, names, &doc, &fields)
    });
    let constraints = names.constraints.name.as_ref().map(|name| {
        let fields: Vec<_> = compiled
            .constraints
            .iter()
            .map(|constraint| Field {
                name: field(&constraint.name),
                text: constraint.name.clone(),
                doc: format!("{}\n\n`{} = 0`", constraint.doc, constraint.formula),
                value: 0.0,
            })
            .collect();
        let doc = format!(
            "One component per constraint of [`{mechanism}`]: Φ, its derivatives, or the multipliers λ."
        );
        components(visibility, name, names, &doc, &fields)
    });
    let parameters_type = &names.parameters;
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        #visibility struct #mechanism<T = ::core::primitive::f64> {
            parameters: #parameters_type<T>,
            #[doc = #hoisted_doc]
            hoisted: [T; #hoisted],
        }

        impl<T: #runtime::Real> ::core::default::Default for #mechanism<T> {
            /// The mechanism with its declared parameters.
            fn default() -> Self {
                Self::prepare(<#parameters_type<T> as ::core::default::Default>::default())
            }
        }

        #parameters
        #inputs
        #coordinates
        #states
        #constraints
        #outputs
    }
}

fn setting(Setting { quantity, value }: &Setting, doc: String) -> Field {
    Field { name: field(&quantity.name), text: quantity.name.clone(), doc, value: *value }
}

fn output(quantity: &Quantity) -> Field {
    let doc = words::quantity(quantity, None);
    Field { name: field(&quantity.name), text: quantity.name.clone(), doc, value: 0.0 }
}

/// A struct with one field per component, and its conversions.
fn components(
    visibility: &TokenStream,
    name: &Ident,
    names: &Names,
    doc: &str,
    fields: &[Field],
) -> TokenStream {
    let Names { runtime, nalgebra, .. } = names;
    let length = Literal::usize_unsuffixed(fields.len());
    let idents: Vec<_> = fields.iter().map(|field| &field.name).collect();
    let texts: Vec<_> = fields.iter().map(|field| field.text.as_str()).collect();
    let docs = fields.iter().map(|field| field.doc.trim());
    let positions = (0..fields.len()).map(Literal::usize_unsuffixed);
    let defaults = fields.iter().map(|field| tokens::float(field.value));
    // A mechanism without parameters still has the struct; it needs its `T`.
    let (marker, marker_value) = if fields.is_empty() {
        (
            quote!(#[doc(hidden)] pub marker: ::core::marker::PhantomData<T>,),
            quote!(marker: ::core::marker::PhantomData,),
        )
    } else {
        (TokenStream::new(), TokenStream::new())
    };
    // Thousands of moves, inlined wherever a vector is looped over, are most of
    // what the compiler would have to do.
    let inline = match fields.len() <= LARGEST_INLINED {
        true => quote!(#[inline(always)]),
        false => quote!(#[inline(never)]),
    };
    let positions: Vec<_> = positions.collect();
    let copies = (fields.len() > LARGEST_INLINED).then(|| {
        quote! {
            #[inline(never)]
            fn copy_to(&self, array: &mut [T; #length]) {
                #(array[#positions] = self.#idents;)*
            }
            #[inline(never)]
            fn copy_from(&mut self, array: &[T; #length]) {
                #(self.#idents = array[#positions];)*
            }
        }
    });
    let (array, value) =
        if fields.is_empty() { (quote!(_), quote!(_)) } else { (quote!(array), quote!(value)) };
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        #visibility struct #name<T = ::core::primitive::f64> {
            #(#[doc = #docs] pub #idents: T,)*
            #marker
        }

        impl<T: #runtime::Real> ::core::default::Default for #name<T> {
            #[allow(clippy::approx_constant)]
            fn default() -> Self {
                Self { #(#idents: #defaults,)* #marker_value }
            }
        }

        impl<T: #runtime::Real> #runtime::Components for #name<T> {
            type Real = T;
            type Array = [T; #length];
            const NAMES: &'static [&'static ::core::primitive::str] = &[#(#texts),*];

            #inline
            fn into_array(self) -> [T; #length] {
                [#(self.#idents),*]
            }
            #inline
            fn from_array(#array: [T; #length]) -> Self {
                Self { #(#idents: array[#positions],)* #marker_value }
            }
            #inline
            fn splat(#value: T) -> Self {
                Self { #(#idents: value,)* #marker_value }
            }
            #copies
        }

        impl<T: #runtime::Real> ::core::convert::From<#name<T>> for #nalgebra::SVector<T, #length> {
            fn from(components: #name<T>) -> Self {
                #nalgebra::SVector::<T, #length>::from_data(#nalgebra::ArrayStorage([
                    #runtime::Components::into_array(components),
                ]))
            }
        }
    }
}
