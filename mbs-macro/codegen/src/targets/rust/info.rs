//! The constant that describes a mechanism to tools.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Block, Operations};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::names::Names;
use crate::compiled::{
    Compiled, Count, Crossing, Event, Friction, Lock, Mode, Pivot, Quantity, Sampling, Stop, Transition,
};

pub fn emit(compiled: &Compiled, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    let (name, doc) = (names.mechanism.to_string(), compiled.doc.as_str());
    let dof = Literal::i32_unsuffixed(compiled.degrees_of_freedom);
    let states = compiled.states.iter().map(|&at| Literal::usize_unsuffixed(at));
    let redundant = compiled.redundant.iter().map(|&row| Literal::usize_unsuffixed(row));
    let kept = compiled.kept.each_ref().map(|kept| {
        let kept = kept.iter().map(|&at| Literal::usize_unsuffixed(at));
        quote!(&[#(#kept),*])
    });
    let velocity_forces = compiled.velocity_forces.iter().map(|&at| Literal::usize_unsuffixed(at));
    let parameters = compiled.parameters.iter().map(|p| quantity(&p.quantity, p.value, runtime));
    let inputs = compiled.inputs.iter().map(|it| quantity(&it.quantity, it.value, runtime));
    let coordinates = compiled.coordinates.iter().enumerate();
    let coordinates = coordinates.map(|(at, c)| quantity(c, compiled.declared_start(at), runtime));
    let lines = Literal::usize_unsuffixed(compiled.line_count);
    let outputs = compiled.outputs.iter().map(|output| quantity(output, 0.0, runtime));
    let constraints = compiled.constraints.iter().map(|constraint| {
        let (name, doc, formula) = (&constraint.name, &constraint.doc, &constraint.formula);
        let (is_drive, is_rate) = (constraint.is_drive, constraint.is_rate);
        let dimension = dimension(constraint.dimension, runtime);
        quote! {
            #runtime::Constraint {
                name: #name, doc: #doc, formula: #formula, is_drive: #is_drive, is_rate: #is_rate, dimension: #dimension
            }
        }
    });
    let events = compiled.events.iter().map(|Event { quantity: of, crossing }| {
        let Quantity { name, doc, dimension: dim, .. } = of;
        let dimension = dimension(*dim, runtime);
        let direction = match crossing {
            Crossing::Rising => quote!(Rising),
            Crossing::Falling => quote!(Falling),
            Crossing::Either => quote!(Either),
        };
        quote! {
            #runtime::DeclaredEvent {
                name: #name, doc: #doc, dimension: #dimension, direction: #runtime::Direction::#direction,
            }
        }
    });
    let sampling = sampling(&compiled.sampling, runtime);
    let stops = compiled.stops.iter().map(|Stop { quantity, memory, force, formula, .. }| {
        let Quantity { name, doc, unit, dimension: of, .. } = quantity;
        let (of, memory) = (dimension(*of, runtime), Literal::usize_unsuffixed(*memory));
        let force = option(*force);
        quote! {
            #runtime::DeclaredStop {
                name: #name, doc: #doc, unit: #unit, dimension: #of, memory: #memory, force: #force, formula: #formula,
            }
        }
    });
    let frictions =
        compiled.frictions.iter().map(|Friction { name, memory, limits: [sliding, sticking], stop, .. }| {
            let memory = Literal::usize_unsuffixed(*memory);
            let stop = option(*stop);
            quote! {
                #runtime::DeclaredFriction { name: #name, memory: #memory, limits: [#sliding, #sticking], stop: #stop }
            }
        });
    let modes = modes(compiled, runtime);
    let start_pivots = pivots(&compiled.start_pivots, runtime);
    let pivots = pivots(&compiled.pivots, runtime);
    let functions = compiled.counts().into_iter().map(|function| {
        let Count { function, operations, watch } = function;
        let name = function.name();
        let Operations { mul, add, div, sin_cos, other } = operations;
        let blocks = compiled.blocks(compiled.program(function));
        let written = blocks.iter().map(|block| block.written() as u32).sum::<u32>();
        let loops = blocks.iter().filter(|block| matches!(block, Block::Repeated(_))).count() as u32;
        quote! {
            #runtime::Function {
                name: #name,
                operations: #runtime::Operations {
                    mul: #mul, add: #add, div: #div, sin_cos: #sin_cos, other: #other, watch: #watch,
                },
                written: #written,
                loops: #loops,
            }
        }
    });
    quote! {
        #runtime::Info::from_parts(
            #name, #doc, #dof,
            &[#(#parameters),*], &[#(#inputs),*], &[#(#coordinates),*], #lines, &[#(#outputs),*],
            &[#(#events),*], &[#(#constraints),*], &[#(#states),*], &[#(#redundant),*],
            &[#(#velocity_forces),*], [#(#kept),*], #pivots, #start_pivots, #sampling, &[#(#stops),*], &[#(#frictions),*],
            #modes,
            &[#(#functions),*],
        )
    }
}

/// A place, if there is one.
fn option(place: Option<usize>) -> TokenStream {
    match place.map(Literal::usize_unsuffixed) {
        Some(place) => quote!(::core::option::Option::Some(#place)),
        None => quote!(::core::option::Option::None),
    }
}

/// The modes with their constraints, and the transitions.
fn modes(compiled: &Compiled, runtime: &TokenStream) -> TokenStream {
    if compiled.modes.is_empty() && compiled.transitions.is_empty() {
        return quote!(#runtime::Modes::NONE);
    }
    let modes = compiled.modes.iter().map(|Mode { name, memory }| {
        let memory = Literal::usize_unsuffixed(*memory);
        quote!(#runtime::DeclaredMode { name: #name, memory: #memory })
    });
    let locks = compiled.locks.iter().map(|Lock { name, mode, held, is_rate, formula, .. }| {
        let [mode, held] = [mode, held].map(|it| Literal::usize_unsuffixed(*it));
        quote! {
            #runtime::DeclaredLock { name: #name, mode: #mode, held: #held, is_rate: #is_rate, formula: #formula }
        }
    });
    let transitions = compiled.transitions.iter().map(|it| {
        let Transition { text, is_rising, is_strict, holds_near, sees_forces, memory } = it;
        let memory = Literal::usize_unsuffixed(*memory);
        quote!(#runtime::DeclaredTransition {
            condition: #text, is_rising: #is_rising, is_strict: #is_strict, holds_near: #holds_near,
            sees_forces: #sees_forces, memory: #memory
        })
    });
    quote! {
        #runtime::Modes {
            modes: &[#(#modes),*], locks: &[#(#locks),*], transitions: &[#(#transitions),*],
        }
    }
}

/// The clocks, and what they set.
fn sampling(Sampling { memories, clocks, samples }: &Sampling, runtime: &TokenStream) -> TokenStream {
    if *clocks == 0 && *memories == 0 {
        return quote!(#runtime::Sampling::NONE);
    }
    let [memories, clocks] = [memories, clocks].map(|it| Literal::usize_unsuffixed(*it));
    let samples = samples.iter().map(|[clock, memory]| {
        let [clock, memory] = [clock, memory].map(|it| Literal::usize_unsuffixed(*it));
        quote!([#clock, #memory])
    });
    quote!(#runtime::Sampling { memories: #memories, clocks: #clocks, samples: &[#(#samples),*] })
}

/// A list of pivots by the names of what they pair.
fn pivots(pivots: &[Pivot], runtime: &TokenStream) -> TokenStream {
    let pivots = pivots.iter().map(|Pivot { constraint, coordinate }| {
        quote!(#runtime::Pivot { constraint: #constraint, coordinate: #coordinate })
    });
    quote!(&[#(#pivots),*])
}

fn quantity(quantity: &Quantity, value: f64, runtime: &TokenStream) -> TokenStream {
    let Quantity { name, doc, unit, scale, dimension: dim } = quantity;
    let (scale, value) = (float(*scale), float(value));
    let dimension = dimension(*dim, runtime);
    quote! {
        #runtime::Quantity { name: #name, doc: #doc, unit: #unit, scale: #scale, dimension: #dimension, default: #value }
    }
}

fn float(value: f64) -> TokenStream {
    if value.is_finite() {
        let literal = Literal::f64_suffixed(value);
        quote!(#literal)
    } else {
        quote!(::core::primitive::f64::NAN)
    }
}

/// Fractional exponents, which only outputs can have, are given as 0.
fn dimension(dimension: Dimension, runtime: &TokenStream) -> TokenStream {
    let exponents = dimension.exponents().unwrap_or_default();
    quote!(#runtime::Dimension::from_exponents([#(#exponents),*]))
}
