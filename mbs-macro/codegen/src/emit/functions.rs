//! The generated functions.

use mbs_symbolic::{Operand, Program, Stage};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::access::Access;
use super::derivation;
use super::docs;
use super::info;
use super::names::{Names, field};
use super::program::{Body, body};
use super::sketch;
use super::splines::splines;
use super::step;
use crate::derive::Equations;
use crate::model::{Check, Direction, Model};
use crate::plan::Plan;
use crate::syntax::Comparison;

/// Systems with more unknowns are not forced into the step.
const LARGEST_INLINED: usize = 64;

/// `new`, `declared`, `prepare` and access to the parameters.
pub fn construction(model: &Model, plan: &Plan, names: &Names) -> TokenStream {
    let Names { mechanism, parameters, runtime, .. } = names;
    let checks = parameter_checks(model, plan, names);
    let splines = splines(model, names);
    let Body { statements, outputs } = body(model, names, &plan.prepare, &Access::of_parameters());
    quote! {
        impl #mechanism<::core::primitive::f64> {
            /// The mechanism with its declared parameters, in `f64`.
            ///
            /// For another scalar type, use `default`.
            pub fn declared() -> Self {
                ::core::default::Default::default()
            }
        }

        impl<T: #runtime::Real> #mechanism<T> {
            #(#splines)*

            /// The mechanism with these parameters.
            ///
            /// # Errors
            /// If a parameter is not finite, a mass or an inertia comes out
            /// negative, or a declared condition does not hold.
            pub fn new(parameters: #parameters<T>) -> ::core::result::Result<Self, #runtime::Error> {
                #runtime::__private::check_finite(&parameters)?;
                #checks
                ::core::result::Result::Ok(Self::prepare(parameters))
            }

            /// Computes what depends on parameters alone.
            #[allow(unused_variables, clippy::all)]
            fn prepare(parameters: #parameters<T>) -> Self {
                #statements
                Self { parameters, hoisted: [#(#outputs),*] }
            }

            /// The parameters.
            pub fn parameters(&self) -> &#parameters<T> {
                &self.parameters
            }
        }
    }
}

fn parameter_checks(model: &Model, plan: &Plan, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    let Body { statements, outputs } = body(model, names, &plan.requirements, &Access::of_parameters());
    let mut outputs = outputs.into_iter();
    let mut checks = TokenStream::new();
    for requirement in &model.requirements {
        let (difference, value) = (outputs.next(), outputs.next());
        let comparison = match requirement.comparison {
            Comparison::Less => quote!(<),
            Comparison::LessOrEqual => quote!(<=),
            Comparison::Greater => quote!(>),
            Comparison::GreaterOrEqual => quote!(>=),
        };
        let (name, text) = (&requirement.name, &requirement.text);
        checks.extend(quote! {
            if !(#difference #comparison T::from_f64(0.0)) {
                return ::core::result::Result::Err(#runtime::Error::Parameter {
                    name: #name,
                    value: (#value).to_f64(),
                    requirement: #text,
                });
            }
        });
    }
    for (coordinate, mass) in model.coordinates.iter().zip(outputs.by_ref()) {
        let body = &model.bodies[coordinate.body];
        let what = if coordinate.direction == Direction::Angle { "inertia" } else { "mass" };
        let name = format!("{what} of {}", body.name);
        let is_repeated =
            coordinate.direction == Direction::Y && model.coordinate_of(body, Direction::X).is_some();
        if is_repeated {
            continue;
        }
        checks.extend(quote! {
            if !(#mass >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(#runtime::Error::Parameter {
                    name: #name,
                    value: (#mass).to_f64(),
                    requirement: "it must not be negative",
                });
            }
        });
    }
    let is_known = |check: &&Check| model.arena.stage(check.value) == Stage::Parameter;
    for (check, value) in model.checks.iter().filter(is_known).zip(outputs) {
        let (comparison, requirement) = match check.is_strict {
            true => (quote!(>), "it has to be positive"),
            false => (quote!(>=), "it must not be negative"),
        };
        let name = format!("{} of {}", check.property, check.element);
        checks.extend(quote! {
            if !(#value #comparison T::from_f64(0.0)) {
                return ::core::result::Result::Err(#runtime::Error::Parameter {
                    name: #name,
                    value: (#value).to_f64(),
                    requirement: #requirement,
                });
            }
        });
    }
    quote! {
        #[allow(unused_variables)]
        #[allow(clippy::all)]
        {
            #statements
            #checks
        }
    }
}

/// A vector of named components from the outputs of a program.
pub(super) fn vector(name: &TokenStream, fields: &[Ident], values: &[TokenStream]) -> TokenStream {
    if fields.is_empty() {
        return quote!(::core::default::Default::default());
    }
    let name = turbofish(name);
    quote!(#name { #(#fields: #values),* })
}

/// `Name<T>` as it stands in expressions.
fn turbofish(of_t: &TokenStream) -> TokenStream {
    let name = of_t.clone().into_iter().next();
    quote!(#name)
}

/// A matrix: written out, or if it is large and so mostly zeros, by its entries.
fn matrix(
    nalgebra: &TokenStream,
    (rows, columns): (usize, usize),
    entry: impl Fn(usize, usize) -> Option<TokenStream>,
) -> TokenStream {
    const LARGEST_WRITTEN_OUT: usize = 400;
    if rows * columns <= LARGEST_WRITTEN_OUT {
        let columns = (0..columns).map(|column| {
            let entries = (0..rows).map(|row| entry(row, column).unwrap_or_else(|| quote!(T::from_f64(0.0))));
            quote!([#(#entries),*])
        });
        return quote!(#nalgebra::SMatrix::from_data(#nalgebra::ArrayStorage([#(#columns),*])));
    }
    let mut entries = TokenStream::new();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        if let Some(value) = entry(row, column) {
            let (row, column) = (Literal::usize_unsuffixed(row), Literal::usize_unsuffixed(column));
            entries.extend(quote!(matrix.data.0[#column][#row] = #value;));
        }
    }
    quote! {
        let mut matrix = #nalgebra::SMatrix::from_data(#nalgebra::ArrayStorage([[T::from_f64(0.0); #rows]; #columns]));
        #entries
        matrix
    }
}

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

/// The public functions that compute one thing each.
pub fn inherent(model: &Model, equations: &Equations, plan: &Plan, names: &Names) -> TokenStream {
    let Names { mechanism, runtime, nalgebra, state, reactions, .. } = names;
    let (q, rows, inputs) = (&names.coordinates.of_t, &names.constraints.of_t, &names.inputs.of_t);
    let fields = Fields::new(model);
    let (n, m) = (fields.coordinates.len(), fields.rows.len());
    let position = Access::of_position();
    let at_state = Access::of_state();

    let rows_of = |program: &Program, access: &Access| {
        let Body { statements, outputs } = body(model, names, program, access);
        let value = vector(rows, &fields.rows, &outputs);
        quote!(#statements #value)
    };
    let phi = rows_of(&plan.phi, &position);
    let phi_t = rows_of(&plan.phi_t, &position);
    let phi_dot = rows_of(&plan.phi_dot, &at_state);
    let gamma = rows_of(&plan.gamma, &at_state);
    let baumgarte_rhs = rows_of(&plan.baumgarte_rhs, &at_state);
    let forces = {
        let Body { statements, outputs } = body(model, names, &plan.forces, &at_state);
        let value = vector(q, &fields.coordinates, &outputs);
        quote!(#statements #value)
    };
    let phi_q = {
        let Body { statements, outputs } = body(model, names, &plan.phi_q, &position);
        let is_zero =
            |at: usize| matches!(plan.phi_q.outputs[at], Operand::Number(number) if number.is_zero());
        let matrix = matrix(nalgebra, (m, n), |row, column| {
            let at = row * n + column;
            (!is_zero(at)).then(|| outputs[at].clone())
        });
        quote!(#statements #matrix)
    };
    let mass = {
        let Body { statements, outputs } = body(model, names, &plan.mass, &position);
        let matrix = matrix(nalgebra, (n, n), |row, column| (row == column).then(|| outputs[row].clone()));
        quote!(#statements #matrix)
    };
    let scalar = |program: &Program| {
        let Body { statements, outputs } = body(model, names, program, &at_state);
        quote!(#statements #(#outputs)*)
    };
    let (kinetic, potential) = (scalar(&plan.kinetic_energy), scalar(&plan.potential_energy));
    let d = docs::Functions::new(model, equations, plan);
    let (phi_doc, phi_q_doc, phi_t_doc, gamma_doc) = (d.phi(), d.phi_q(), d.phi_t(), d.gamma());
    let (rhs_doc, mass_doc, forces_doc, accelerations_doc) =
        (d.baumgarte_rhs(), d.mass(), d.forces(), d.accelerations());
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<T: #runtime::Real> #mechanism<T> {
            #[doc = #phi_doc]
            #[inline]
            pub fn phi(&self, t: T, q: &#q) -> #rows { #phi }

            #[doc = #phi_q_doc]
            #[inline]
            pub fn phi_q(&self, t: T, q: &#q) -> #nalgebra::SMatrix<T, #m, #n> { #phi_q }

            #[doc = #phi_t_doc]
            #[inline]
            pub fn phi_t(&self, t: T, q: &#q) -> #rows { #phi_t }

            /// Φ̇ = Φ_q v + Φ_t, the constraint violation in velocities.
            #[inline]
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

            #[doc = #mass_doc]
            #[inline]
            pub fn mass(&self, q: &#q) -> #nalgebra::SMatrix<T, #n, #n> { #mass }

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
            #[inline]
            pub fn kinetic_energy(&self, at: &#state) -> T { #kinetic }

            /// Potential energy of gravity (0 at the origin) and springs in J.
            #[inline]
            pub fn potential_energy(&self, at: &#state) -> T { #potential }
        }
    }
}

/// The implementation of the runtime's trait.
pub fn mechanism(model: &Model, equations: &Equations, plan: &Plan, names: &Names) -> TokenStream {
    let Names { mechanism, runtime, parameters, state, reactions, .. } = names;
    let (q, rows) = (&names.coordinates.of_t, &names.constraints.of_t);
    let (inputs, outputs) = (&names.inputs.of_t, &names.outputs.of_t);
    let fields = Fields::new(model);
    let info = info::emit(model, plan, names);
    let derivation = derivation::emit(model, equations, plan);
    let sketch = sketch::emit(&model.sketch, names);
    let points = Literal::usize_unsuffixed(model.sketch.points.len());
    let places = sketch::places(body(model, names, &plan.points, &Access::of_position()));
    let kernels = kernels(model, plan, names, &fields);
    let fused_step = step::choice(plan, names);
    let start = declared_start(model, plan, names, &fields);
    let worst_start_pivot = worst_pivot(model, names, &plan.start_pivots);
    let worst_pivot = worst_pivot(model, names, &plan.pivots);
    let output_values = {
        let Body { statements, outputs: values } = body(model, names, &plan.outputs, &Access::of_state());
        let output_fields: Vec<_> = model.outputs.iter().map(|output| field(&output.quantity.name)).collect();
        let value = vector(outputs, &output_fields, &values);
        quote!(#statements #value)
    };
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<T: #runtime::Real> #runtime::Mechanism for #mechanism<T> {
            type Real = T;
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
            fn declared_start(&self) -> #state { #start }
            #[inline]
            fn phi(&self, t: T, q: &#q) -> #rows {
                Self::phi(self, t, q)
            }
            #[inline]
            fn phi_dot(&self, at: &#state) -> #rows {
                Self::phi_dot(self, at)
            }
            #kernels
            #fused_step
            fn worst_pivot(&self, t: T, q: &#q) -> ::core::option::Option<(::core::primitive::usize, T)> { #worst_pivot }
            fn worst_start_pivot(&self, t: T, q: &#q) -> ::core::option::Option<(::core::primitive::usize, T)> { #worst_start_pivot }
            #[inline]
            fn kinetic_energy(&self, at: &#state) -> T {
                Self::kinetic_energy(self, at)
            }
            #[inline]
            fn potential_energy(&self, at: &#state) -> T {
                Self::potential_energy(self, at)
            }
            #[inline]
            fn outputs(&self, at: &#state, inputs: &#inputs, reactions: &#reactions) -> #outputs { #output_values }
            fn points(&self, t: T, q: &#q) -> [[T; 2]; #points] { #places }
        }
    }
}

/// The functions that solve the constrained system.
fn kernels(model: &Model, plan: &Plan, names: &Names, fields: &Fields) -> TokenStream {
    let Names { runtime, state, reactions, .. } = names;
    let (q, rows, inputs) = (&names.coordinates.of_t, &names.constraints.of_t, &names.inputs.of_t);
    let (n, m) = (fields.coordinates.len(), fields.rows.len());
    let split = |program: &Program, access: Access| {
        let Body { statements, outputs } = body(model, names, program, &access);
        let acceleration = vector(q, &fields.coordinates, &outputs[..n]);
        let growth = outputs.last().cloned();
        (statements, outputs, acceleration, growth)
    };
    let stabilized = {
        let (statements, outputs, acceleration, growth) = split(&plan.stabilized, Access::of_state());
        let feedback = vector(rows, &fields.rows, &outputs[n..n + m]);
        quote!(#statements #runtime::Stabilized { acceleration: #acceleration, feedback: #feedback, growth: #growth })
    };
    let accelerations = |program: &Program, access: Access| {
        let (statements, _, acceleration, growth) = split(program, access);
        quote!(#statements #runtime::Accelerations { acceleration: #acceleration, growth: #growth })
    };
    let constrained = accelerations(&plan.constrained, Access::of_state());
    let position_correction = accelerations(&plan.position_correction, Access::of_position());
    let velocity_correction = accelerations(&plan.velocity_correction, Access::of_position());
    let reactions_body = {
        let (statements, outputs, acceleration, growth) = split(&plan.reactions, Access::of_state());
        let multipliers = vector(rows, &fields.rows, &outputs[n..n + m]);
        quote!(#statements #runtime::Reactions { acceleration: #acceleration, multipliers: #multipliers, growth: #growth })
    };
    // Inlined into the step, what the step does not use of them disappears, and
    // both stages are scheduled together; large systems are left to the compiler.
    let inline = if n + m <= LARGEST_INLINED { quote!(#[inline(always)]) } else { quote!(#[inline]) };
    // Corrections call what they solve for a residual; programs know it as feedback.
    quote! {
        #inline
        fn stabilized(&self, at: &#state, inputs: &#inputs, gains: &#runtime::Gains<T>) -> #runtime::Stabilized<#q, #rows> { #stabilized }
        #inline
        fn constrained(&self, at: &#state, inputs: &#inputs, feedback: &#rows) -> #runtime::Accelerations<#q> { #constrained }
        #[inline]
        fn reactions(&self, at: &#state, inputs: &#inputs, feedback: &#rows) -> #reactions { #reactions_body }
        fn position_correction(&self, t: T, q: &#q, feedback: &#rows) -> #runtime::Accelerations<#q> { #position_correction }
        fn velocity_correction(&self, t: T, q: &#q, feedback: &#rows) -> #runtime::Accelerations<#q> { #velocity_correction }
    }
}

fn declared_start(model: &Model, plan: &Plan, names: &Names, fields: &Fields) -> TokenStream {
    let runtime = &names.runtime;
    let q = &names.coordinates.of_t;
    let Body { statements, outputs } = body(model, names, &plan.start, &Access::of_position());
    let (positions, velocities) = outputs.split_at(fields.coordinates.len());
    let (positions, velocities) =
        (vector(q, &fields.coordinates, positions), vector(q, &fields.coordinates, velocities));
    quote!(#statements #runtime::State { t: T::from_f64(0.0), q: #positions, v: #velocities })
}

fn worst_pivot(model: &Model, names: &Names, pivots: &Program) -> TokenStream {
    let runtime = &names.runtime;
    if pivots.outputs.is_empty() {
        return quote!(::core::option::Option::None);
    }
    let Body { statements, outputs } = body(model, names, pivots, &Access::of_position());
    quote!(#statements #runtime::__private::worst(&[#(#outputs),*]))
}
