//! The equations and their elimination, for people to read: text and LaTeX.

use mbs_symbolic::{Expr, Unknown, latex_name};
use proc_macro2::TokenStream;
use quote::quote;

use super::docs::{self, LONGEST_FORMULA};
use crate::derive::Equations;
use crate::model::Model;
use crate::plan::Plan;

pub fn emit(model: &Model, equations: &Equations, plan: &Plan) -> TokenStream {
    let writer = Writer { model };
    let rows = |exprs: &[Expr]| {
        let rows = model.constraints.iter().zip(exprs);
        writer.list(rows.map(|(row, &expr)| (row.name.as_str(), "", expr)))
    };
    let coordinates = |exprs: &[Expr]| {
        let coordinates = model.coordinates.iter().zip(exprs);
        writer.list(coordinates.map(|(c, &expr)| (c.quantity.name.as_str(), "", expr)))
    };
    let phi_q = writer.list(model.constraints.iter().zip(&equations.phi_q).flat_map(|(row, entries)| {
        let column = |at: usize| model.coordinates[at].quantity.name.as_str();
        entries.iter().map(move |(&at, &entry)| (row.name.as_str(), column(at), entry))
    }));
    let (phi, phi_t) = (rows(&equations.phi), rows(&equations.phi_t));
    let (phi_dot, gamma) = (rows(&equations.phi_dot), rows(&equations.gamma));
    let (mass, forces) = (coordinates(&equations.mass), coordinates(&equations.forces));
    let kinetic = writer.formula("T", "", equations.kinetic_energy);
    let potential = writer.formula("V", "", equations.potential_energy);
    let strategy = docs::strategy(plan.strategy);
    let order = plan.order.iter().map(|step| {
        let unknowns = step.unknowns.iter().map(|&unknown| docs::unknown_name(model, unknown));
        let watched = step.unknowns.iter().any(|&unknown| writer.is_watched(plan, unknown));
        let (text, latex) = writer.texts(step.pivot);
        let runtime = &model.runtime;
        quote!(#runtime::Elimination { unknowns: &[#(#unknowns),*], pivot: #text, latex: #latex, is_watched: #watched })
    });
    let runtime = &model.runtime;
    quote! {
        #runtime::Derivation {
            phi: &[#(#phi),*], phi_q: &[#(#phi_q),*], phi_t: &[#(#phi_t),*], phi_dot: &[#(#phi_dot),*],
            gamma: &[#(#gamma),*], mass: &[#(#mass),*], forces: &[#(#forces),*],
            kinetic_energy: #kinetic, potential_energy: #potential,
            strategy: #strategy, order: &[#(#order),*],
        }
    }
}

struct Writer<'a> {
    model: &'a Model,
}

impl Writer<'_> {
    /// The formulas that are not 0.
    fn list<'b>(&self, entries: impl Iterator<Item = (&'b str, &'b str, Expr)>) -> Vec<TokenStream> {
        let entries = entries.filter(|(.., expr)| !self.model.arena.is_zero(*expr));
        entries.map(|(of, by, expr)| self.formula(of, by, expr)).collect()
    }

    fn formula(&self, of: &str, by: &str, expr: Expr) -> TokenStream {
        let runtime = &self.model.runtime;
        let (text, latex) = self.texts(expr);
        let (of_latex, by_latex) = (latex_name(of), latex_name(by));
        quote! {
            #runtime::Formula {
                of: #of, of_latex: #of_latex, by: #by, by_latex: #by_latex, text: #text, latex: #latex,
            }
        }
    }

    fn texts(&self, expr: Expr) -> (String, String) {
        let arena = &self.model.arena;
        (arena.display_within(expr, LONGEST_FORMULA), arena.latex_within(expr, LONGEST_FORMULA))
    }

    fn is_watched(&self, plan: &Plan, unknown: Unknown) -> bool {
        plan.pivot_names.iter().any(|&(row, coordinate)| match unknown {
            Unknown::Row(at) => row == Some(at),
            Unknown::Coordinate(at) => row.is_none() && coordinate == Some(at),
        })
    }
}
