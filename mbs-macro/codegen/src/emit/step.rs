//! A whole step as one function on pairs of scalars.

use std::collections::BTreeSet;

use mbs_symbolic::pairs::{Lane, Scalar, Step, Woven};
use mbs_symbolic::{Operand, Operation};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::access::Access;
use super::functions::{Fields, vector};
use super::names::Names;
use super::program::{number_tokens, operation_tokens, symbol_tokens};
use crate::model::Model;
use crate::plan::Plan;

/// The functions of both kinds of feedback; nothing if the mechanism is too large.
pub fn functions(model: &Model, plan: &Plan, names: &Names) -> TokenStream {
    let Some(step) = &plan.fused_step else { return TokenStream::new() };
    let Names { mechanism, runtime, state, .. } = names;
    let (q, inputs) = (&names.coordinates.of_t, &names.inputs.of_t);
    let fields = Fields::new(model);
    let function = |doc: &str, name: &str, woven: &Woven| {
        let name = Ident::new(name, Span::call_site());
        let body = body(model, names, &fields, woven);
        quote! {
            #[doc = #doc]
            #[inline(always)]
            fn #name(&self, at: &#state, inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T) -> #runtime::Stepped<#q> {
                #body
            }
        }
    };
    let held = function("A step with feedback held over it.", "step_held", &step.held);
    let per_stage = function("A step with feedback in both stages.", "step_per_stage", &step.per_stage);
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<T: #runtime::Real> #mechanism<T> {
            #held
            #per_stage
        }
    }
}

/// The trait's function, which chooses between the two.
pub fn choice(plan: &Plan, names: &Names) -> TokenStream {
    if plan.fused_step.is_none() {
        return TokenStream::new();
    }
    let Names { runtime, state, .. } = names;
    let (q, inputs) = (&names.coordinates.of_t, &names.inputs.of_t);
    quote! {
        #[inline(always)]
        fn fused_step<F: #runtime::Feedback>(&self, at: &#state, inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T) -> ::core::option::Option<#runtime::Stepped<#q>> {
            ::core::option::Option::Some(if F::IS_HELD {
                self.step_held(at, inputs, gains, h, t_next)
            } else {
                self.step_per_stage(at, inputs, gains, h, t_next)
            })
        }
    }
}

fn body(model: &Model, names: &Names, fields: &Fields, woven: &Woven) -> TokenStream {
    let runtime = &names.runtime;
    let mut writer = Writer { model, access: Access::of_state(), names: Vec::new(), taken: BTreeSet::new() };
    let mut statements = TokenStream::new();
    for (at, step) in woven.steps.iter().enumerate() {
        statements.extend(writer.statement(at, step, woven.steps.get(at + 1)));
    }
    let n = fields.coordinates.len();
    let outputs: Vec<TokenStream> = woven.outputs.iter().map(|&output| writer.scalar(output)).collect();
    let (q, v) = (
        vector(&names.coordinates.of_t, &fields.coordinates, &outputs[..n]),
        vector(&names.coordinates.of_t, &fields.coordinates, &outputs[n..2 * n]),
    );
    let (growth, sum) = (&outputs[2 * n], &outputs[2 * n + 1]);
    quote! {
        use #runtime::Pair as _;
        let half_h = T::from_f64(0.5) * h;
        #statements
        #runtime::Stepped { next: #runtime::State { t: t_next, q: #q, v: #v }, growth: #growth, sum: #sum }
    }
}

struct Writer<'a> {
    model: &'a Model,
    access: Access,
    names: Vec<Ident>,
    taken: BTreeSet<String>,
}

impl Writer<'_> {
    fn statement(&mut self, at: usize, step: &Step, next: Option<&Step>) -> TokenStream {
        let pair = |value: TokenStream| (format_ident!("p{at}"), value);
        let (name, value) = match step {
            Step::Scalar(operation, a, b, name) => {
                let (a, b) = (self.scalar(*a), self.scalar(*b));
                let value = operation_tokens(*operation, &a, &b, &self.access.mechanism);
                (self.scalar_name(at, name.as_deref()), value)
            }
            Step::Join(a, b) => {
                let (a, b) = (self.scalar(*a), self.scalar(*b));
                pair(quote!(T::Pair::join(#a, #b)))
            }
            Step::Splat(a) => {
                let a = self.scalar(*a);
                pair(quote!(T::Pair::splat(#a)))
            }
            Step::Swap(of) => {
                let of = &self.names[*of];
                pair(quote!(#of.swap()))
            }
            Step::Flip(of) => {
                let of = &self.names[*of];
                pair(quote!(#of.flip()))
            }
            Step::Pair(operation, a, b) => {
                let (a, b) = (&self.names[*a], &self.names[*b]);
                pair(match operation {
                    Operation::Sub => quote!(#a - #b),
                    Operation::Mul => quote!(#a * #b),
                    Operation::Div => quote!(#a / #b),
                    _ => quote!(#a + #b),
                })
            }
            Step::Sines(angles) => {
                let angles = self.names[*angles].clone();
                let (sines, cosines) = (format_ident!("sines{at}"), format_ident!("cosines{at}"));
                self.names.extend([sines.clone(), cosines.clone()]);
                debug_assert_eq!(next, Some(&Step::Cosines));
                return quote!(let (#sines, #cosines) = #angles.sin_cos(););
            }
            // Named with the sines.
            Step::Cosines => return TokenStream::new(),
        };
        self.names.push(name.clone());
        quote!(let #name = #value;)
    }

    fn scalar(&self, scalar: Scalar) -> TokenStream {
        match scalar {
            Scalar::Given(Operand::Number(number)) => number_tokens(number),
            Scalar::Given(Operand::Symbol(symbol)) => symbol_tokens(self.model, &self.access, symbol),
            Scalar::Given(Operand::Hoisted(at) | Operand::Value(at)) => {
                let at = Literal::usize_unsuffixed(at);
                quote!(self.hoisted[#at])
            }
            Scalar::Step(at) => {
                let name = &self.names[at];
                quote!(#name)
            }
            Scalar::Lane(at, lane) => {
                let name = &self.names[at];
                match lane {
                    Lane::First => quote!(#name.first()),
                    Lane::Second => quote!(#name.second()),
                }
            }
        }
    }

    fn scalar_name(&mut self, at: usize, suggested: Option<&str>) -> Ident {
        match suggested {
            Some(name) if syn::parse_str::<Ident>(name).is_ok() && self.taken.insert(name.to_owned()) => {
                Ident::new(name, Span::call_site())
            }
            _ => format_ident!("v{at}"),
        }
    }
}
