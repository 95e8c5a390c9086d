//! The stages of a mechanism whose programs became loops, on arrays.

use mbs_symbolic::Program;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::long;
use super::names::Names;
use super::program::{Body, body};
use crate::model::Model;
use crate::plan::Plan;

/// Whether the stages are given arrays: where a step is not fused, and both became
/// more than one block.
pub fn are_on_arrays(model: &Model, plan: &Plan) -> bool {
    let is_long = |program: &Program| long::blocks(model, program).len() > 1;
    plan.fused_step.is_none() && is_long(&plan.stabilized) && is_long(&plan.constrained)
}

/// The implementation of the runtime's `OnArrays`.
pub fn implementation(model: &Model, plan: &Plan, names: &Names) -> TokenStream {
    let Names { mechanism, runtime, .. } = names;
    let inputs = &names.inputs.of_t;
    let (n, m) = (model.coordinates.len(), model.constraints.len());
    let [coordinates, constraints] = [n, m].map(|length| {
        let length = Literal::usize_unsuffixed(length);
        quote!([T; #length])
    });
    let stabilized = body(model, names, &plan.stabilized, &Access::of_arrays());
    let (acceleration, feedback) = (stabilized.array(0..n), stabilized.array(n..n + m));
    let Body { statements: stabilized, outputs, .. } = stabilized;
    let growth_of_stabilized = outputs.last();
    let constrained = body(model, names, &plan.constrained, &Access::of_arrays());
    let constrained_acceleration = constrained.array(0..n);
    let Body { statements: constrained, outputs, .. } = constrained;
    let growth_of_constrained = outputs.last();
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<T: #runtime::Real> #runtime::arrays::OnArrays for #mechanism<T> {
            fn stabilized_on_arrays(
                &self,
                t: T,
                position_array: &#coordinates,
                velocity_array: &#coordinates,
                inputs: &#inputs,
                gains: &#runtime::Gains<T>,
            ) -> (#coordinates, #constraints, T) {
                #stabilized
                (#acceleration, #feedback, #growth_of_stabilized)
            }
            fn constrained_on_arrays(
                &self,
                t: T,
                position_array: &#coordinates,
                velocity_array: &#coordinates,
                inputs: &#inputs,
                feedback_array: &#constraints,
            ) -> (#coordinates, T) {
                #constrained
                (#constrained_acceleration, #growth_of_constrained)
            }
        }
    }
}

/// The trait's step, on arrays.
pub fn step(names: &Names) -> TokenStream {
    let Names { runtime, state, .. } = names;
    let (q, inputs) = (&names.coordinates.of_t, &names.inputs.of_t);
    quote! {
        #[inline(always)]
        fn fused_step<F: #runtime::Feedback>(&self, at: &#state, inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T) -> ::core::option::Option<#runtime::Stepped<#q>> {
            ::core::option::Option::Some(#runtime::arrays::step::<Self, F>(self, at, inputs, gains, h, t_next))
        }
    }
}
