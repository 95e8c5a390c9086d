//! The stages of a mechanism whose programs became loops, on arrays.
//!
//! Named components are a detour for loops, so these stages are given arrays and fill arrays. A step
//! converts its state once, works in room of its own, and writes the state in place (`arrays.rs` of the
//! runtime).

use mbs_symbolic::{Number, Operand, Program};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::body::Body;
use super::names::Names;
use super::places::{ACCELERATION, FEEDBACK};
use super::program::body;
use super::tokens;
use crate::compiled::{Compiled, FunctionId};

/// True if the stages are given arrays: where a step is not fused, and both became
/// more than one block.
pub fn are_on_arrays(compiled: &Compiled) -> bool {
    let is_long = |program: &Program| compiled.blocks(program).len() > 1;
    compiled.fused_step.is_none()
        && is_long(compiled.program(FunctionId::Stabilized))
        && is_long(compiled.program(FunctionId::Constrained))
}

/// The stages, and room for a step.
pub fn implementation(compiled: &Compiled, names: &Names) -> TokenStream {
    let Names { mechanism, runtime, .. } = names;
    let inputs = &names.inputs.of_t;
    let (s, m) = (compiled.states.len(), compiled.constraints.len());
    let stabilized = body(compiled, names, FunctionId::Stabilized, &Access::of_arrays());
    let constrained = body(compiled, names, FunctionId::Constrained, &Access::of_arrays());
    let lengths = [s, m, stabilized.slots.max(constrained.slots)].map(Literal::usize_unsuffixed);
    let [states, constraints, slots] = lengths.each_ref().map(|length| quote!([T; #length]));
    let [zero_states, zero_constraints, zero_slots] =
        lengths.each_ref().map(|length| quote!([T::from_f64(0.0); #length]));
    let [_, _, slot_count] = lengths;
    let stage = |body: &Body, results: &TokenStream| {
        let (statements, growth) = (&body.statements, body.outputs.last());
        quote! {
            const SLOTS: ::core::primitive::usize = #slot_count;
            #statements
            #results
            #growth
        }
    };
    let acceleration = |body: &Body| body.write(ACCELERATION, (0..s).map(|state| (state, state)));
    // the array is given as zeros, so what is always 0 is not written
    let given = &compiled.program(FunctionId::Stabilized).outputs;
    let rows = (0..m).filter(|row| given.get(s + row) != Some(&Operand::Number(Number::ZERO)));
    let feedback = stabilized.write(FEEDBACK, rows.map(|row| (s + row, row)));
    let acceleration_of_stabilized = acceleration(&stabilized);
    let stabilized = stage(&stabilized, &quote!(#acceleration_of_stabilized #feedback));
    let constrained = stage(&constrained, &acceleration(&constrained));
    let lints = tokens::lints();
    quote! {
        #lints
        impl<T: #runtime::Real> #mechanism<T> {
            #[inline(always)]
            fn room() -> #runtime::arrays::Room<Self, #slots> {
                #runtime::arrays::Room {
                    states: #zero_states,
                    constraints: #zero_constraints,
                    slots: #zero_slots,
                }
            }
            fn stabilized_on_arrays(
                &self,
                t: T,
                position_array: &#states,
                velocity_array: &#states,
                inputs: &#inputs,
                gains: &#runtime::Gains<T>,
                acceleration: &mut #states,
                feedback: &mut #constraints,
                slots: &mut #slots,
            ) -> T { #stabilized }
            fn constrained_on_arrays(
                &self,
                t: T,
                position_array: &#states,
                velocity_array: &#states,
                inputs: &#inputs,
                feedback_array: &#constraints,
                acceleration: &mut #states,
                slots: &mut #slots,
            ) -> T { #constrained }
        }
    }
}

/// The trait's `stabilized`, `constrained` and `long_step`, by calls of the stages.
pub struct Calls {
    pub stabilized: TokenStream,
    pub constrained: TokenStream,
    pub step: TokenStream,
}

/// The calls of the stages.
pub fn calls(names: &Names) -> Calls {
    let Names { runtime, stepped: state, .. } = names;
    let inputs = &names.inputs.of_t;
    let stabilized = quote! {
        |(t, q, v), a, feedback, slots| self.stabilized_on_arrays(t, q, v, inputs, gains, a, feedback, slots)
    };
    let constrained = quote! {
        |(t, q, v), feedback, a, slots| self.constrained_on_arrays(t, q, v, inputs, feedback, a, slots)
    };
    let step = quote! {
        #[inline(always)]
        fn long_step<X: #runtime::Method>(&self, state: &mut #state, inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T, alarm: T) -> ::core::option::Option<T> {
            #runtime::arrays::step::<Self, X, _>(self, state, [h, t_next, alarm], Self::room, #stabilized, #constrained)
        }
    };
    Calls {
        stabilized: quote!(#runtime::arrays::stabilized::<Self, _>(at, Self::room, #stabilized)),
        constrained: quote!(#runtime::arrays::constrained::<Self, _>(at, feedback, Self::room, #constrained)),
        step,
    }
}
