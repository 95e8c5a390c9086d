//! Transposed programs as functions on slices.

use std::collections::BTreeSet;

use mbs_symbolic::Operand;
use mbs_symbolic::layout::Component;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::access::Access;
use super::body::Body;
use super::names::Names;
use super::program::body_of;
use super::tokens;
use crate::compiled::{Compiled, Kinds, Transposed, Vector};

/// The implementation of the runtime's `Transposed`; nothing where runs are not to be differentiated in reverse.
pub fn implementation(compiled: &Compiled, names: &Names) -> TokenStream {
    if !compiled.choices.has_reverse {
        return TokenStream::new();
    }
    let transposes = match compiled.transposes() {
        Ok(transposes) => transposes,
        Err(fault) => {
            names.faults.borrow_mut().push(fault);
            return TokenStream::new();
        }
    };
    let Names { mechanism, runtime, .. } = names;
    let (mut functions, mut arms) = (TokenStream::new(), TokenStream::new());
    let mut add = |id: Ident, name: &str, transposed: &Transposed| {
        let name = format_ident!("transposed_{name}");
        let body = body(compiled, names, transposed);
        let doc = format!("Backward through `{id}`.");
        functions.extend(quote! {
            #[doc = #doc]
            fn #name(&self, given: &#runtime::reverse::Given<'_, T>, weights: &[T], adjoints: &mut #runtime::reverse::Adjoints<'_, T>) -> ::core::option::Option<()> {
                #body
                ::core::option::Option::Some(())
            }
        });
        arms.extend(quote! {
            #runtime::reverse::Function::#id => Self::#name(self, given, weights, adjoints),
        });
    };
    for (function, transposed) in &transposes.functions {
        // the runtime calls them by the same names
        let id = format_ident!("{function:?}");
        add(id, function.name(), transposed);
    }
    if let Some(Kinds { held, per_stage }) = &transposes.step {
        add(format_ident!("StepHeld"), "step_held", held);
        add(format_ident!("StepPerStage"), "step_per_stage", per_stage);
    } else {
        arms.extend(quote! {
            #runtime::reverse::Function::StepHeld | #runtime::reverse::Function::StepPerStage => ::core::option::Option::None,
        });
    }
    let has_step = transposes.step.is_some();
    let lints = tokens::lints();
    quote! {
        #lints
        impl<T: #runtime::Real> #mechanism<T> { #functions }

        #[allow(clippy::all)]
        impl<T: #runtime::Real> #runtime::reverse::Transposed for #mechanism<T> {
            const HAS_STEP: ::core::primitive::bool = #has_step;
            fn transposed(
                &self,
                function: #runtime::reverse::Function,
                given: &#runtime::reverse::Given<'_, T>,
                weights: &[T],
                adjoints: &mut #runtime::reverse::Adjoints<'_, T>,
            ) -> ::core::option::Option<()> {
                match function { #arms }
            }
        }
    }
}

/// Statements that run a transposed program and add its results to the adjoints.
fn body(compiled: &Compiled, names: &Names, transposed: &Transposed) -> TokenStream {
    let access = Access::of_transposed(transposed.weights);
    let body = body_of(compiled, names, &transposed.program, &access);
    let (arrays, sums) = (arrays(compiled, transposed, &access), sums(compiled, transposed, &body));
    let statements = &body.statements;
    quote! {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        #arrays
        #statements
        #sums
    }
}

/// The vectors that are read, as arrays.
fn arrays(compiled: &Compiled, transposed: &Transposed, access: &Access) -> TokenStream {
    let program = &transposed.program;
    let operands = program.instructions.iter().flat_map(|instruction| [instruction.a, instruction.b]);
    let vector = |operand: Operand| Some(compiled.input_of(operand)?.component()?.vector);
    let read: BTreeSet<Vector> = operands.chain(program.outputs.iter().copied()).filter_map(vector).collect();
    let read = read.into_iter().filter(|vector| access.has_array(*vector));
    let statement = |vector: Vector| {
        let (ident, length) =
            (vector.ident(), Literal::usize_unsuffixed(access.components(compiled, vector)));
        let slice = match (vector, member(vector)) {
            (Vector::Weights, _) => quote!(weights),
            (_, member) => quote!(given.#member),
        };
        quote!(let #ident = #slice.first_chunk::<#length>()?;)
    };
    read.map(statement).collect()
}

/// The member of the runtime's `Given` and `Adjoints` that is for a vector.
fn member(vector: Vector) -> Ident {
    let name = match vector {
        Vector::Parameters => "parameters",
        Vector::Inputs => "inputs",
        Vector::Positions | Vector::StatePositions => "q",
        Vector::Velocities | Vector::StateVelocities => "v",
        Vector::Accelerations | Vector::Predicted => "acceleration",
        Vector::Multipliers => "multipliers",
        Vector::Feedback => "feedback",
        Vector::Weights => "weights",
    };
    Ident::new(name, Span::call_site())
}

/// Adds results to the adjoints, vector after vector.
fn sums(compiled: &Compiled, transposed: &Transposed, body: &Body) -> TokenStream {
    let place = |operand: &Operand| match *operand {
        Operand::Hoisted(at) => Some((Ident::new("hoisted", Span::call_site()), at)),
        operand => {
            let Component { vector, place } = compiled.input_of(operand)?.component()?;
            Some((member(vector), place))
        }
    };
    let mut members: Vec<(Ident, Vec<(usize, usize)>)> = Vec::new();
    for (result, (member, at)) in transposed.by.iter().enumerate().filter_map(|(k, by)| Some((k, place(by)?)))
    {
        match members.iter_mut().find(|(known, _)| *known == member) {
            Some((_, places)) => places.push((result, at)),
            None => members.push((member, vec![(result, at)])),
        }
    }
    members.iter().map(|(member, places)| body.add(&quote!(adjoints.#member), places)).collect()
}
