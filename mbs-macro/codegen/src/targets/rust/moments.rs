//! When steps end, and what happens between them: corners over time, switches, and the samples of clocks.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::names::{Names, field};
use super::program::body;
use crate::compiled::{Compiled, FunctionId, Knots, Sampling};

fn knots(Knots { at, period, jumps }: &Knots, names: &Names) -> TokenStream {
    let (runtime, period) = (&names.runtime, period.unwrap_or_default());
    quote!(#runtime::Knots { at: &[#(#at),*], period: #period, jumps: #jumps })
}

/// The switches and their values; nothing without one.
pub fn switches(compiled: &Compiled, names: &Names) -> (TokenStream, TokenStream) {
    if compiled.switches.is_empty() {
        return (TokenStream::new(), TokenStream::new());
    }
    let Names { runtime, state, inputs, .. } = names;
    let inputs = &inputs.of_t;
    let switches = compiled.switches.iter().map(|(name, at)| {
        let knots = knots(at, names);
        quote!(#runtime::Switch { name: #name, knots: #knots })
    });
    let body = body(compiled, names, FunctionId::Switches, &Access::of_state());
    let (statements, values) = (&body.statements, body.array(0..compiled.switches.len()));
    let declared = quote!(const SWITCHES: &'static [#runtime::Switch] = &[#(#switches),*];);
    let written = quote! {
        fn switches(&self, at: &#state, inputs: &#inputs, values: &mut [T]) {
            #statements
            for (to, from) in values.iter_mut().zip(#values) {
                *to = from;
            }
        }
    };
    (declared, written)
}

/// Where time passes a knot; nothing without one.
pub fn next_corner(compiled: &Compiled, names: &Names) -> TokenStream {
    if compiled.corners.is_empty() {
        return TokenStream::new();
    }
    let (runtime, inputs) = (&names.runtime, &names.inputs.of_t);
    let body = body(compiled, names, FunctionId::Corners, &Access::of_position());
    let (statements, values) = (&body.statements, body.array(0..2 * compiled.corners.len()));
    let (values_count, count) = (2 * compiled.corners.len(), compiled.corners.len());
    let [values_count, count] = [values_count, count].map(Literal::usize_unsuffixed);
    let knots = compiled.corners.iter().map(|it| knots(it, names));
    quote! {
        fn next_corner(&self, t: T, inputs: &#inputs) -> T {
            const KNOTS: [#runtime::Knots; #count] = [#(#knots),*];
            #statements
            let lines: [T; #values_count] = #values;
            #runtime::__private::next_corner(t, lines.as_chunks().0, &KNOTS)
        }
    }
}

/// The clocks, and what they set; nothing without one.
pub fn samples(compiled: &Compiled, names: &Names) -> TokenStream {
    let Sampling { clocks, samples, .. } = &compiled.sampling;
    if samples.is_empty() {
        return TokenStream::new();
    }
    let groups = clocks + compiled.transitions.len();
    let (state, inputs) = (&names.state, &names.inputs.of_t);
    let valued = |function, access: &Access, count: usize| {
        let body = body(compiled, names, function, access);
        let (statements, values) = (&body.statements, body.array(0..count));
        let count = Literal::usize_unsuffixed(count);
        quote!(let values: [T; #count] = { #statements #values };)
    };
    let times = valued(FunctionId::Clocks, &Access::of_position(), 2 * clocks);
    let values = valued(FunctionId::Samples, &Access::of_state(), samples.len());
    let index = |at: usize| Literal::usize_unsuffixed(at);
    let pairs = (0..*clocks).map(|clock| {
        let [at, period, offset] = [clock, 2 * clock, 2 * clock + 1].map(index);
        quote!(#at => [values[#period], values[#offset]],)
    });
    let sets = (0..groups).map(|clock| {
        let of_clock = samples.iter().enumerate().filter(|(_, [of, _])| *of == clock);
        let sets = of_clock.map(|(at, [_, memory])| {
            let (memory, at) = (field(&compiled.inputs[*memory].quantity.name), index(at));
            quote!(inputs.#memory = values[#at];)
        });
        let clock = index(clock);
        quote!(#clock => { #(#sets)* })
    });
    let transitions = transitions(compiled, names);
    quote! {
        #transitions
        fn clock(&self, clock: ::core::primitive::usize) -> [T; 2] {
            #times
            match clock {
                #(#pairs)*
                _ => [T::from_f64(::core::primitive::f64::NAN); 2],
            }
        }
        fn sample(&self, at: &#state, inputs: &mut #inputs, clock: ::core::primitive::usize) {
            #values
            match clock {
                #(#sets)*
                _ => {}
            }
        }
    }
}

/// The values of transitions; nothing without one.
fn transitions(compiled: &Compiled, names: &Names) -> TokenStream {
    if compiled.transitions.is_empty() {
        return TokenStream::new();
    }
    let Names { state, reactions, .. } = names;
    let inputs = &names.inputs.of_t;
    let body = body(compiled, names, FunctionId::Transitions, &Access::of_state());
    let (statements, values) = (&body.statements, body.array(0..compiled.transitions.len()));
    quote! {
        fn transitions(&self, at: &#state, inputs: &#inputs, reactions: &#reactions, values: &mut [T]) {
            #statements
            for (to, from) in values.iter_mut().zip(#values) {
                *to = from;
            }
        }
    }
}
