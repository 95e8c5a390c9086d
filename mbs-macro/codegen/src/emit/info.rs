//! The constant that describes a mechanism to tools.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Block, Operations, Program};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::docs;
use super::long;
use super::names::Names;
use crate::model::{Model, Quantity};
use crate::plan::Plan;

pub fn emit(model: &Model, plan: &Plan, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    let (name, doc) = (names.mechanism.to_string(), model.doc.as_str());
    let dof = Literal::i32_unsuffixed((model.coordinates.len() as i32) - (plan.rows.basis.len() as i32));
    let redundant = plan.rows.redundant.iter().map(|&row| Literal::usize_unsuffixed(row));
    let parameters = model.parameters.iter().map(|p| quantity(&p.quantity, p.value, runtime));
    let inputs = model.inputs.iter().map(|input| quantity(input, 0.0, runtime));
    let start = plan.start.evaluate(&model.values(|_| 0.0), &[]);
    let coordinates =
        model.coordinates.iter().zip(start).map(|(c, start)| quantity(&c.quantity, start, runtime));
    let outputs = model.outputs.iter().map(|output| quantity(&output.quantity, 0.0, runtime));
    let constraints = model.constraints.iter().map(|constraint| {
        let (name, doc) = (&constraint.name, &constraint.doc);
        let formula = docs::formula(model, constraint.phi);
        let (is_drive, dimension) = (constraint.is_drive, dimension(constraint.dimension, runtime));
        quote!(#runtime::Constraint { name: #name, doc: #doc, formula: #formula, is_drive: #is_drive, dimension: #dimension })
    });
    let start_pivots = pivots(model, &plan.start_pivot_names, runtime);
    let pivots = pivots(model, &plan.pivot_names, runtime);
    let functions = function_counts(plan).into_iter().map(|function| {
        let FunctionCount { name, operations, watch, program } = function;
        let Operations { mul, add, div, sin_cos, other } = operations;
        let blocks = long::blocks(model, program);
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
            &[#(#parameters),*], &[#(#inputs),*], &[#(#coordinates),*], &[#(#outputs),*],
            &[#(#constraints),*], &[#(#redundant),*], #pivots, #start_pivots, &[#(#functions),*],
        )
    }
}

/// A list of pivots by the names of what they pair.
fn pivots(model: &Model, names: &[(Option<usize>, Option<usize>)], runtime: &TokenStream) -> TokenStream {
    let pivots = names.iter().map(|(row, coordinate)| {
        let row = row.map_or("", |at| model.constraints[at].name.as_str());
        let coordinate = coordinate.map_or("", |at| model.coordinates[at].quantity.name.as_str());
        quote!(#runtime::Pivot { constraint: #row, coordinate: #coordinate })
    });
    quote!(&[#(#pivots),*])
}

/// A generated function, and what it takes.
pub struct FunctionCount<'a> {
    pub name: &'static str,
    pub operations: Operations,
    /// Operations that watch pivots, counted in none of the others.
    pub watch: u32,
    pub program: &'a Program,
}

pub fn function_counts(plan: &Plan) -> Vec<FunctionCount<'_>> {
    fn whole<'a>(name: &'static str, program: &'a Program) -> FunctionCount<'a> {
        FunctionCount { name, operations: program.operations(), watch: 0, program }
    }
    // The last output of a solving function is the pivot growth.
    fn solved<'a>(name: &'static str, program: &'a Program) -> FunctionCount<'a> {
        let operations = program.operations_for(program.outputs.len().saturating_sub(1));
        let watch = program.operations_for(program.outputs.len()).total() - operations.total();
        FunctionCount { name, operations, watch, program }
    }
    vec![
        whole("new", &plan.prepare),
        whole("phi", &plan.phi),
        whole("phi_dot", &plan.phi_dot),
        whole("phi_q", &plan.phi_q),
        whole("phi_t", &plan.phi_t),
        whole("gamma", &plan.gamma),
        whole("baumgarte_rhs", &plan.baumgarte_rhs),
        whole("mass", &plan.mass),
        whole("forces", &plan.forces),
        whole("kinetic_energy", &plan.kinetic_energy),
        whole("potential_energy", &plan.potential_energy),
        solved("stabilized", &plan.stabilized),
        solved("constrained", &plan.constrained),
        solved("reactions", &plan.reactions),
        solved("position_correction", &plan.position_correction),
        solved("velocity_correction", &plan.velocity_correction),
        whole("outputs", &plan.outputs),
    ]
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
    let [mass, length, time] = dimension.exponents().unwrap_or_default();
    quote!(#runtime::Dimension { mass: #mass, length: #length, time: #time })
}
