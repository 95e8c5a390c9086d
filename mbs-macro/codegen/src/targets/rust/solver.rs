//! The cost of a step, and the declared step and feedback, as constants. The
//! runtime's own condition decides whether these are stable.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};

use super::names::Names;
use crate::compiled::{Compiled, Feedback, FunctionId};

/// The type of the declared scheme.
pub fn scheme(compiled: &Compiled, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    let scheme = Ident::new(compiled.choices.scheme.type_name, Span::call_site());
    quote!(#runtime::#scheme)
}

pub fn emit(compiled: &Compiled, names: &Names) -> TokenStream {
    let Names { mechanism, runtime, stepped, .. } = names;
    let (rows, inputs) = (&names.constraints.of_t, &names.inputs.of_t);
    let stabilized = compiled.program(FunctionId::Stabilized);
    let operations = stabilized.operations().total();
    let stages = compiled.choices.scheme.stage_count();
    // the state before and after a step, and in each stage where it is and what changes it
    let states = 4 * stages;
    let values = stages
        * stabilized.instructions.len().max(compiled.program(FunctionId::Constrained).instructions.len());
    let mut tokens = quote! {
        impl<T: #runtime::Real> #mechanism<T> {
            /// Operations of one evaluation of the right-hand side, the watch over
            /// the pivots included; a step takes one per stage, or less.
            pub const OPERATIONS: ::core::primitive::u32 = #operations;
            /// The size of the state of a step (time, positions, velocities) in bytes.
            pub const STATE_BYTES: ::core::primitive::usize = ::core::mem::size_of::<#stepped>();
            /// A bound of the stack that a step takes, in bytes, in optimized code:
            /// every value of all evaluations of the right-hand side once, four
            /// copies of the state, the inputs and the rows per stage, and 1 KiB for calls.
            pub const STACK_BYTES: ::core::primitive::usize = #values * ::core::mem::size_of::<T>()
                + #states * (Self::STATE_BYTES + ::core::mem::size_of::<#rows>() + ::core::mem::size_of::<#inputs>())
                + 1024;
        }
    };
    if let (Some(limit), Some(span)) = (compiled.choices.stack, compiled.written.stack) {
        let limit = limit as usize;
        let message =
            format!("a step of `{mechanism}` may take more stack than the {limit} bytes that are allowed");
        tokens.extend(quote_spanned! {span=>
            const _: () = ::core::assert!(#mechanism::<::core::primitive::f64>::STACK_BYTES <= #limit, #message);
        });
    }
    let Some(step) = compiled.choices.step else { return tokens };
    tokens.extend(quote! {
        impl #mechanism<::core::primitive::f64> {
            /// The declared step in s.
            pub const STEP: ::core::primitive::f64 = #step;
        }
    });
    let (Some(feedback), Some(span)) = (&compiled.choices.feedback, compiled.written.feedback) else {
        return tokens;
    };
    let Feedback { is_held, alpha, beta } = *feedback;
    let kind = if is_held { quote!(Held) } else { quote!(PerStage) };
    let scheme = scheme(compiled, names);
    let message = feedback.refusal(step);
    tokens.extend(quote! {
        impl #mechanism<::core::primitive::f64> {
            /// The declared feedback of the constraint violation, stable with
            /// steps of [`STEP`](Self::STEP).
            pub const FEEDBACK: #runtime::Baumgarte<#runtime::#kind<#scheme>> =
                match #runtime::Baumgarte::new(#alpha, #beta) {
                    ::core::result::Result::Ok(feedback) => feedback,
                    ::core::result::Result::Err(_) => #runtime::Baumgarte::NONE,
                };
        }
    });
    // At the statement itself, so that this is where the compiler points.
    tokens.extend(quote_spanned! {span=>
        const _: () = ::core::assert!(
            #mechanism::<::core::primitive::f64>::FEEDBACK
                .is_stable(#mechanism::<::core::primitive::f64>::STEP),
            #message
        );
    });
    tokens
}
