//! The generated functions.

use mbs_symbolic::Program;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::derivation;
use super::docs;
use super::info;
use super::matrices;
use super::names::{Names, field};
use super::program::{Body, body};
use super::sketch;
use super::stages;
use super::step;
use crate::derive::Equations;
use crate::model::Model;
use crate::plan::Plan;

/// Systems with more unknowns are not forced into the step.
const LARGEST_INLINED: usize = 64;

/// The fields of the two vectors that most functions return.
pub(super) struct Fields {
    pub coordinates: Vec<Ident>,
    pub rows: Vec<Ident>,
}

impl Fields {
    pub fn new(model: &Model) -> Self {
        Self {
            coordinates: model.coordinates.iter().map(|c| field(&c.quantity.name)).collect(),
            rows: model.constraints.iter().map(|constraint| field(&constraint.name)).collect(),
        }
    }
}

/// Whether what runs at every step is forced into it.
///
/// There, what the step does not use disappears, and both stages are scheduled
/// together; and it is compiled for the vector instructions that an ensemble's
/// step is compiled for. Large systems are left to the compiler.
fn inlining(model: &Model) -> TokenStream {
    let unknowns = model.coordinates.len() + model.constraints.len();
    if unknowns <= LARGEST_INLINED { quote!(#[inline(always)]) } else { quote!(#[inline]) }
}

/// The public functions that compute one thing each.
pub fn inherent(model: &Model, equations: &Equations, plan: &Plan, names: &Names) -> TokenStream {
    let Names { mechanism, runtime, state, reactions, .. } = names;
    let (q, rows, inputs) = (&names.coordinates.of_t, &names.constraints.of_t, &names.inputs.of_t);
    let fields = Fields::new(model);
    let (n, m) = (fields.coordinates.len(), fields.rows.len());
    let position = Access::of_position();
    let at_state = Access::of_state();

    let rows_of = |program: &Program, access: &Access| {
        let body = body(model, names, program, access);
        let (statements, value) = (&body.statements, body.vector(rows, &fields.rows, 0..m));
        quote!(#statements #value)
    };
    let phi = rows_of(&plan.phi, &position);
    let phi_t = rows_of(&plan.phi_t, &position);
    let phi_dot = rows_of(&plan.phi_dot, &at_state);
    let gamma = rows_of(&plan.gamma, &at_state);
    let baumgarte_rhs = rows_of(&plan.baumgarte_rhs, &at_state);
    let forces = {
        let body = body(model, names, &plan.forces, &at_state);
        let (statements, value) = (&body.statements, body.vector(q, &fields.coordinates, 0..n));
        quote!(#statements #value)
    };
    let scalar = |program: &Program| {
        let Body { statements, outputs, .. } = body(model, names, program, &at_state);
        quote!(#statements #(#outputs)*)
    };
    let (kinetic, potential) = (scalar(&plan.kinetic_energy), scalar(&plan.potential_energy));
    let inline = inlining(model);
    let d = docs::Functions::new(model, equations, plan);
    let (phi_doc, phi_t_doc, gamma_doc) = (d.phi(), d.phi_t(), d.gamma());
    let (rhs_doc, forces_doc, accelerations_doc) = (d.baumgarte_rhs(), d.forces(), d.accelerations());
    let matrices = matrices::emit(model, plan, names, &d);
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<T: #runtime::Real> #mechanism<T> {
            #[doc = #phi_doc]
            #inline
            pub fn phi(&self, t: T, q: &#q) -> #rows { #phi }

            #[doc = #phi_t_doc]
            #[inline]
            pub fn phi_t(&self, t: T, q: &#q) -> #rows { #phi_t }

            /// Φ̇ = Φ_q v + Φ_t, the constraint violation in velocities.
            #inline
            pub fn phi_dot(&self, at: &#state) -> #rows { #phi_dot }

            #[doc = #gamma_doc]
            #[inline]
            pub fn gamma(&self, at: &#state) -> #rows { #gamma }

            #[doc = #rhs_doc]
            #[inline]
            pub fn baumgarte_rhs(&self, at: &#state, alpha: T, beta: T) -> #rows {
                let gains =
                    &#runtime::Gains { minus_two_alpha: -(alpha + alpha), minus_beta_squared: -(beta * beta) };
                #baumgarte_rhs
            }

            #matrices

            #[doc = #forces_doc]
            #[inline]
            pub fn forces(&self, at: &#state, inputs: &#inputs) -> #q { #forces }

            #[doc = #accelerations_doc]
            #[inline]
            pub fn accelerations(&self, at: &#state, inputs: &#inputs) -> #reactions {
                let none = <#rows as #runtime::Components>::splat(T::from_f64(0.0));
                #runtime::Mechanism::reactions(self, at, inputs, &none)
            }

            /// Kinetic energy ½ vᵀMv in J.
            #inline
            pub fn kinetic_energy(&self, at: &#state) -> T { #kinetic }

            /// Potential energy of gravity (0 at the origin) and springs in J.
            #inline
            pub fn potential_energy(&self, at: &#state) -> T { #potential }
        }
    }
}

/// The implementation of the runtime's trait.
pub fn mechanism(
    model: &Model,
    equations: &Equations,
    plan: &Plan,
    names: &Names,
    are_on_arrays: bool,
) -> TokenStream {
    let Names { mechanism, runtime, parameters, state, reactions, .. } = names;
    let (q, rows) = (&names.coordinates.of_t, &names.constraints.of_t);
    let (inputs, outputs) = (&names.inputs.of_t, &names.outputs.of_t);
    let fields = Fields::new(model);
    let inline = inlining(model);
    let info = info::emit(model, plan, names);
    let derivation = derivation::emit(model, equations, plan);
    let sketch = sketch::emit(&model.sketch, names);
    let points = Literal::usize_unsuffixed(model.sketch.points.len());
    let places = sketch::places(&body(model, names, &plan.points, &Access::of_position()));
    let kernels = kernels(model, plan, names, &fields, are_on_arrays);
    let fused_step = if are_on_arrays { stages::step(names) } else { step::choice(plan, names) };
    let start = declared_start(model, plan, names, &fields);
    let worst_start_pivot = worst_pivot(model, names, &plan.start_pivots);
    let worst_pivot = worst_pivot(model, names, &plan.pivots);
    let output_values = {
        let body = body(model, names, &plan.outputs, &Access::of_state());
        let fields: Vec<_> = model.outputs.iter().map(|output| field(&output.quantity.name)).collect();
        let (statements, value) = (&body.statements, body.vector(outputs, &fields, 0..fields.len()));
        quote!(#statements #value)
    };
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<T: #runtime::Real> #runtime::Mechanism for #mechanism<T> {
            type Real = T;
            type Over<Scalar: #runtime::Real> = #mechanism<Scalar>;
            type Parameters = #parameters<T>;
            type Inputs = #inputs;
            type Coordinates = #q;
            type Constraints = #rows;
            type Outputs = #outputs;
            type Points = [[T; 2]; #points];
            const INFO: &'static #runtime::Info = &#info;
            const DERIVATION: &'static #runtime::Derivation = &#derivation;
            const SKETCH: &'static #runtime::Sketch = &#sketch;

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
                Self { parameters, hoisted: ::core::array::from_fn(hoisted) }
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
            fn points(&self, t: T, q: &#q) -> [[T; 2]; #points] { #places }
        }
    }
}

/// The functions that solve the constrained system.
fn kernels(model: &Model, plan: &Plan, names: &Names, fields: &Fields, are_on_arrays: bool) -> TokenStream {
    let Names { runtime, state, reactions, .. } = names;
    let (q, rows, inputs) = (&names.coordinates.of_t, &names.constraints.of_t, &names.inputs.of_t);
    let (n, m) = (fields.coordinates.len(), fields.rows.len());
    let acceleration = |body: &Body| body.vector(q, &fields.coordinates, 0..n);
    let of_rows = |body: &Body| body.vector(rows, &fields.rows, n..n + m);
    let stabilized = if are_on_arrays {
        quote!(#runtime::arrays::stabilized(self, at, inputs, gains))
    } else {
        let body = body(model, names, &plan.stabilized, &Access::of_state());
        let (statements, growth) = (&body.statements, body.outputs.last());
        let (acceleration, feedback) = (acceleration(&body), of_rows(&body));
        quote!(#statements #runtime::Stabilized { acceleration: #acceleration, feedback: #feedback, growth: #growth })
    };
    let accelerations = |program: &Program, access: Access| {
        let body = body(model, names, program, &access);
        let (statements, growth, acceleration) = (&body.statements, body.outputs.last(), acceleration(&body));
        quote!(#statements #runtime::Accelerations { acceleration: #acceleration, growth: #growth })
    };
    let constrained = if are_on_arrays {
        quote!(#runtime::arrays::constrained(self, at, inputs, feedback))
    } else {
        accelerations(&plan.constrained, Access::of_state())
    };
    let position_correction = accelerations(&plan.position_correction, Access::of_position());
    let velocity_correction = accelerations(&plan.velocity_correction, Access::of_position());
    let reactions_body = {
        let body = body(model, names, &plan.reactions, &Access::of_state());
        let (statements, growth) = (&body.statements, body.outputs.last());
        let (acceleration, multipliers) = (acceleration(&body), of_rows(&body));
        quote!(#statements #runtime::Reactions { acceleration: #acceleration, multipliers: #multipliers, growth: #growth })
    };
    let inline = inlining(model);
    // Corrections call what they solve for a residual; programs know it as feedback.
    quote! {
        #inline
        fn stabilized(&self, at: &#state, inputs: &#inputs, gains: &#runtime::Gains<T>) -> #runtime::Stabilized<#q, #rows> { #stabilized }
        #inline
        fn constrained(&self, at: &#state, inputs: &#inputs, feedback: &#rows) -> #runtime::Accelerations<#q> { #constrained }
        #inline
        fn reactions(&self, at: &#state, inputs: &#inputs, feedback: &#rows) -> #reactions { #reactions_body }
        fn position_correction(&self, t: T, q: &#q, feedback: &#rows) -> #runtime::Accelerations<#q> { #position_correction }
        fn velocity_correction(&self, t: T, q: &#q, feedback: &#rows) -> #runtime::Accelerations<#q> { #velocity_correction }
    }
}

fn declared_start(model: &Model, plan: &Plan, names: &Names, fields: &Fields) -> TokenStream {
    let runtime = &names.runtime;
    let q = &names.coordinates.of_t;
    let n = fields.coordinates.len();
    let body = body(model, names, &plan.start, &Access::of_position());
    let (positions, velocities) =
        (body.vector(q, &fields.coordinates, 0..n), body.vector(q, &fields.coordinates, n..2 * n));
    let (statements, time) = (&body.statements, body.outputs.last());
    quote!(#statements #runtime::State { t: #time, q: #positions, v: #velocities })
}

fn worst_pivot(model: &Model, names: &Names, pivots: &Program) -> TokenStream {
    let runtime = &names.runtime;
    if pivots.outputs.is_empty() {
        return quote!(::core::option::Option::None);
    }
    let body = body(model, names, pivots, &Access::of_position());
    let (statements, growths) = (&body.statements, body.array(0..pivots.outputs.len()));
    quote!(#statements #runtime::__private::worst(&#growths))
}
