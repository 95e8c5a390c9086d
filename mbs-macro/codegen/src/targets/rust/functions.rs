//! The generated functions.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::body::{Body, named};
use super::contacts;
use super::derivation;
use super::docs;
use super::info;
use super::matrices;
use super::moments;
use super::names::{Fields, Names, field};
use super::program::body;
use super::sketch;
use super::solver;
use super::stages;
use super::step;
use super::tokens;
use crate::compiled::{Argument, Compiled, FunctionId, Property, Results};

/// Systems with more unknowns are not forced into the step.
const LARGEST_INLINED: usize = 64;

/// The attribute that forces functions into the step that calls them, or leaves them to the compiler.
///
/// Within the step, results that it does not use disappear, all stages are scheduled
/// together, and the code has the vector instructions that an ensemble's step is
/// compiled for. Large systems are left to the compiler.
fn inlining(compiled: &Compiled) -> TokenStream {
    let unknowns = compiled.coordinates.len() + compiled.constraints.len();
    if unknowns <= LARGEST_INLINED { quote!(#[inline(always)]) } else { quote!(#[inline]) }
}

/// The public functions that compute one thing each.
pub fn inherent(compiled: &Compiled, names: &Names) -> TokenStream {
    let Names { mechanism, runtime, state, reactions, .. } = names;
    let (rows, inputs) = (&names.constraints.of_t, &names.inputs.of_t);
    let fields = Fields::new(compiled);
    let docs = docs::Functions::new(compiled);
    let methods = compiled.functions().filter(|function| function.is(Property::Method));
    let methods = methods.map(|function| method(compiled, names, &fields, &docs, function));
    let baumgarte_rhs = {
        let body = body(compiled, names, FunctionId::BaumgarteRhs, &Access::of_state());
        let (statements, value) = (&body.statements, body.vector(rows, &fields.rows, 0..fields.rows.len()));
        quote!(#statements #value)
    };
    let rhs_doc = docs.of(FunctionId::BaumgarteRhs);
    let accelerations_doc = docs.with_text(
        FunctionId::Reactions,
        "Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ, without feedback terms.\n\n\
         In a singular position the result is not finite or its `growth` exceeds the runtime's `growth_limit`.",
    );
    let matrices = matrices::emit(compiled, names, &docs);
    let lints = tokens::lints();
    quote! {
        #lints
        impl<T: #runtime::Real> #mechanism<T> {
            #(#methods)*

            #[doc = #rhs_doc]
            ///
            /// The gains α and β are in 1/s.
            #[inline]
            pub fn baumgarte_rhs(&self, at: &#state, alpha: T, beta: T) -> #rows {
                let gains =
                    &#runtime::Gains { minus_two_alpha: -(alpha + alpha), minus_beta_squared: -(beta * beta) };
                #baumgarte_rhs
            }

            #matrices

            #[doc = #accelerations_doc]
            #[inline]
            pub fn accelerations(&self, at: &#state, inputs: &#inputs) -> #reactions {
                let none = <#rows as #runtime::Components>::splat(T::from_f64(0.0));
                #runtime::Mechanism::reactions(self, at, inputs, &none)
            }
        }
    }
}

/// A function of the motion that gives one vector or one number.
fn method(
    compiled: &Compiled,
    names: &Names,
    fields: &Fields,
    docs: &docs::Functions<'_>,
    function: FunctionId,
) -> TokenStream {
    let (q, rows) = (&names.coordinates.of_t, &names.constraints.of_t);
    let (state, inputs) = (&names.state, &names.inputs.of_t);
    let reads = |argument| function.arguments().contains(&argument);
    let (access, mut given) = match reads(Argument::Velocities) {
        true => (Access::of_state(), quote!(at: &#state)),
        false => (Access::of_position(), quote!(t: T, q: &#q)),
    };
    if reads(Argument::Inputs) {
        given.extend(quote!(, inputs: &#inputs));
    }
    let body = body(compiled, names, function, &access);
    let (statements, outputs) = (&body.statements, &body.outputs);
    let (of, value) = match function.results() {
        [Results::Constraints] => (quote!(#rows), body.vector(rows, &fields.rows, 0..fields.rows.len())),
        [Results::Coordinates] => {
            (quote!(#q), body.vector(q, &fields.coordinates, 0..fields.coordinates.len()))
        }
        _ => (quote!(T), quote!(#(#outputs)*)),
    };
    let (doc, name, inline) = (docs.of(function), field(function.name()), inlining(compiled));
    quote! {
        #[doc = #doc]
        #inline
        pub fn #name(&self, #given) -> #of { #statements #value }
    }
}

/// The implementation of the runtime's trait.
pub fn mechanism(compiled: &Compiled, names: &Names, are_on_arrays: bool) -> TokenStream {
    let Names { mechanism, runtime, parameters, state, reactions, .. } = names;
    let (q, s, rows) = (&names.coordinates.of_t, &names.states.of_t, &names.constraints.of_t);
    let (inputs, outputs) = (&names.inputs.of_t, &names.outputs.of_t);
    let fields = Fields::new(compiled);
    let scheme = solver::scheme(compiled, names);
    let inline = inlining(compiled);
    let info = info::emit(compiled, names);
    let derivation = derivation::emit(compiled);
    let sketch = sketch::emit(&compiled.sketch, names);
    let points = Literal::usize_unsuffixed(compiled.sketch.points.len());
    let events = Literal::usize_unsuffixed(compiled.events.len());
    let event_values = {
        let body = body(compiled, names, FunctionId::Events, &Access::of_state());
        let (statements, values) = (&body.statements, body.array(0..compiled.events.len()));
        quote!(#statements #values)
    };
    let (next_corner, (switches, switch_values)) =
        (moments::next_corner(compiled, names), moments::switches(compiled, names));
    let samples = moments::samples(compiled, names);
    let stops = contacts::stops(compiled, names);
    let places = sketch::places(&body(compiled, names, FunctionId::Points, &Access::of_position()));
    let states = states(compiled, names, &fields);
    let kernels = kernels(compiled, names, &fields, are_on_arrays);
    let fused_step = if are_on_arrays { stages::calls(names).step } else { step::choice(compiled, names) };
    let start = declared_start(compiled, names, &fields);
    let worst_start_pivot = worst_pivot(compiled, names, FunctionId::StartPivots);
    let worst_pivot = worst_pivot(compiled, names, FunctionId::Pivots);
    let output_values = {
        let body = body(compiled, names, FunctionId::Outputs, &Access::of_state());
        let fields: Vec<_> = compiled.outputs.iter().map(|output| field(&output.name)).collect();
        let (statements, value) = (&body.statements, body.vector(outputs, &fields, 0..fields.len()));
        quote!(#statements #value)
    };
    let lints = tokens::lints();
    quote! {
        #lints
        impl<T: #runtime::Real> #runtime::Mechanism for #mechanism<T> {
            type Real = T;
            type Over<Scalar: #runtime::Real> = #mechanism<Scalar>;
            type Scheme = #scheme;
            type Parameters = #parameters<T>;
            type Inputs = #inputs;
            type Coordinates = #q;
            type States = #s;
            type Constraints = #rows;
            type Outputs = #outputs;
            type Points = [[T; 2]; #points];
            type Events = [T; #events];
            const INFO: &'static #runtime::Info = &#info;
            const DERIVATION: &'static #runtime::Derivation = &#derivation;
            const SKETCH: &'static #runtime::Sketch = &#sketch;
            #switches

            fn new(parameters: #parameters<T>) -> ::core::result::Result<Self, #runtime::Error> {
                Self::new(parameters)
            }
            fn parameters(&self) -> &#parameters<T> {
                &self.parameters
            }
            #[inline(always)]
            fn hoisted(&self) -> &[T] {
                &self.hoisted
            }
            #[inline(always)]
            fn from_hoisted(parameters: #parameters<T>, hoisted: impl ::core::ops::FnMut(::core::primitive::usize) -> T) -> Self {
                Self { parameters, hoisted: #runtime::__private::each(hoisted) }
            }
            fn declared_start(&self) -> #state { #start }
            #inline
            fn phi(&self, t: T, q: &#q) -> #rows {
                Self::phi(self, t, q)
            }
            #inline
            fn phi_dot(&self, at: &#state) -> #rows {
                Self::phi_dot(self, at)
            }
            #states
            #kernels
            #fused_step
            fn worst_pivot(&self, t: T, q: &#q) -> ::core::option::Option<(::core::primitive::usize, T)> { #worst_pivot }
            fn worst_start_pivot(&self, t: T, q: &#q) -> ::core::option::Option<(::core::primitive::usize, T)> { #worst_start_pivot }
            #inline
            fn kinetic_energy(&self, at: &#state) -> T {
                Self::kinetic_energy(self, at)
            }
            #inline
            fn potential_energy(&self, at: &#state) -> T {
                Self::potential_energy(self, at)
            }
            #inline
            fn outputs(&self, at: &#state, inputs: &#inputs, reactions: &#reactions) -> #outputs { #output_values }
            #inline
            fn events(&self, at: &#state, inputs: &#inputs) -> [T; #events] { #event_values }
            #next_corner
            #switch_values
            #samples
            #stops
            fn points(&self, t: T, q: &#q) -> [[T; 2]; #points] { #places }
        }
    }
}

/// The way from all coordinates to those that are integrated, and back.
fn states(compiled: &Compiled, names: &Names, fields: &Fields) -> TokenStream {
    let Names { runtime, state, stepped, .. } = names;
    let (q, states) = (&names.coordinates.of_t, &names.states.of_t);
    if !compiled.has_reduced_states() {
        return quote! {
            #[inline(always)]
            fn states(all: #q) -> #states { all }
            #[inline(always)]
            fn complete(&self, at: &#stepped) -> #state { *at }
        };
    }
    let n = fields.coordinates.len();
    let body = body(compiled, names, FunctionId::Complete, &Access::of_step());
    let statements = &body.statements;
    let [positions, velocities] = [0..n, n..2 * n].map(|range| body.vector(q, &fields.coordinates, range));
    let chosen = fields.states.iter().map(|state| quote!(all.#state)).collect::<Vec<_>>();
    let chosen = named(states, &fields.states, &chosen);
    let inline = inlining(compiled);
    quote! {
        #[inline(always)]
        fn states(all: #q) -> #states { #chosen }
        #inline
        fn complete(&self, at: &#stepped) -> #state {
            #statements
            #runtime::State { t: at.t, q: #positions, v: #velocities }
        }
    }
}

/// The functions that solve the constrained system.
fn kernels(compiled: &Compiled, names: &Names, fields: &Fields, are_on_arrays: bool) -> TokenStream {
    let Names { runtime, state, stepped, reactions, .. } = names;
    let (q, rows, inputs) = (&names.coordinates.of_t, &names.constraints.of_t, &names.inputs.of_t);
    let states = &names.states.of_t;
    let (n, s, m) = (fields.coordinates.len(), fields.states.len(), fields.rows.len());
    let acceleration = |body: &Body| body.vector(q, &fields.coordinates, 0..n);
    let of_states = |body: &Body| body.vector(states, &fields.states, 0..s);
    let stabilized = if are_on_arrays {
        stages::calls(names).stabilized
    } else {
        let body = body(compiled, names, FunctionId::Stabilized, &Access::of_step());
        let (statements, growth) = (&body.statements, body.outputs.last());
        let (acceleration, feedback) = (of_states(&body), body.vector(rows, &fields.rows, s..s + m));
        quote!(#statements #runtime::Stabilized { acceleration: #acceleration, feedback: #feedback, growth: #growth })
    };
    let accelerations = |function: FunctionId, access: Access| {
        let body = body(compiled, names, function, &access);
        let (statements, growth, acceleration) = (&body.statements, body.outputs.last(), acceleration(&body));
        quote!(#statements #runtime::Accelerations { acceleration: #acceleration, growth: #growth })
    };
    let constrained = if are_on_arrays {
        stages::calls(names).constrained
    } else {
        let body = body(compiled, names, FunctionId::Constrained, &Access::of_step());
        let (statements, growth, acceleration) = (&body.statements, body.outputs.last(), of_states(&body));
        quote!(#statements #runtime::Accelerations { acceleration: #acceleration, growth: #growth })
    };
    let position_correction = accelerations(FunctionId::PositionCorrection, Access::of_position());
    let velocity_correction = accelerations(FunctionId::VelocityCorrection, Access::of_position());
    let projection = accelerations(FunctionId::Projection, Access::of_position());
    let reactions_body = {
        let body = body(compiled, names, FunctionId::Reactions, &Access::of_state());
        let (statements, growth) = (&body.statements, body.outputs.last());
        let (acceleration, multipliers) = (acceleration(&body), body.vector(rows, &fields.rows, n..n + m));
        quote!(#statements #runtime::Reactions { acceleration: #acceleration, multipliers: #multipliers, growth: #growth })
    };
    let inline = inlining(compiled);
    // the trait has that of an explicit stage
    let implicit = compiled.has_stiffness.then(|| {
        let body = body(compiled, names, FunctionId::Implicit, &Access::of_step());
        let (statements, growth, acceleration) = (&body.statements, body.outputs.last(), of_states(&body));
        quote! {
            #inline
            fn implicit(&self, at: &#stepped, inputs: &#inputs, shift: T, predicted: &#states) -> #runtime::Accelerations<#states> {
                #statements
                #runtime::Accelerations { acceleration: #acceleration, growth: #growth }
            }
        }
    });
    // Corrections call what they solve for a residual; programs know it as feedback.
    quote! {
        #inline
        fn stabilized(&self, at: &#stepped, inputs: &#inputs, gains: &#runtime::Gains<T>) -> #runtime::Stabilized<#states, #rows> { #stabilized }
        #inline
        fn constrained(&self, at: &#stepped, inputs: &#inputs, feedback: &#rows) -> #runtime::Accelerations<#states> { #constrained }
        #implicit
        #inline
        fn reactions(&self, at: &#state, inputs: &#inputs, feedback: &#rows) -> #reactions { #reactions_body }
        fn position_correction(&self, t: T, q: &#q, feedback: &#rows) -> #runtime::Accelerations<#q> { #position_correction }
        fn velocity_correction(&self, t: T, q: &#q, feedback: &#rows) -> #runtime::Accelerations<#q> { #velocity_correction }
        #inline
        fn projection(&self, t: T, q: &#q, feedback: &#rows) -> #runtime::Accelerations<#q> { #projection }
    }
}

fn declared_start(compiled: &Compiled, names: &Names, fields: &Fields) -> TokenStream {
    let runtime = &names.runtime;
    let q = &names.coordinates.of_t;
    let n = fields.coordinates.len();
    let body = body(compiled, names, FunctionId::Start, &Access::of_position());
    let (positions, velocities) =
        (body.vector(q, &fields.coordinates, 0..n), body.vector(q, &fields.coordinates, n..2 * n));
    let (statements, time) = (&body.statements, body.outputs.last());
    quote!(#statements #runtime::State { t: #time, q: #positions, v: #velocities })
}

fn worst_pivot(compiled: &Compiled, names: &Names, pivots: FunctionId) -> TokenStream {
    let runtime = &names.runtime;
    let count = compiled.program(pivots).outputs.len();
    if count == 0 {
        return quote!(::core::option::Option::None);
    }
    let body = body(compiled, names, pivots, &Access::of_position());
    let (statements, growths) = (&body.statements, body.array(0..count));
    quote!(#statements #runtime::__private::worst(&#growths))
}
