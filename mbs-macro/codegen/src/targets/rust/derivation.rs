//! The equations and their elimination as a constant, for people to read.

use proc_macro2::TokenStream;
use quote::quote;

use crate::compiled::{Compiled, Derivation, Elimination, Formula};

pub fn emit(compiled: &Compiled) -> TokenStream {
    let runtime = &compiled.written.runtime;
    let Derivation { phi, phi_q, phi_t, phi_dot, gamma, mass, forces, .. } = &compiled.derivation;
    let Derivation { rates, keeps_energy, kinetic_energy, potential_energy, strategy, order, .. } =
        &compiled.derivation;
    let [phi, phi_q, phi_t, phi_dot, gamma, mass, forces, rates] =
        [phi, phi_q, phi_t, phi_dot, gamma, mass, forces, rates].map(|formulas| {
            let formulas = formulas.iter().filter(|formula| !formula.is_zero);
            let formulas = formulas.map(|it| formula(it, runtime));
            quote!(#(#formulas),*)
        });
    let [kinetic, potential] = [kinetic_energy, potential_energy].map(|energy| formula(energy, runtime));
    let given = compiled.derivation.given.iter().map(|it| formula(it, runtime));
    let samples = compiled.derivation.samples.iter().map(|it| formula(it, runtime));
    let order = order.iter().map(|step| {
        let Elimination { unknowns, pivot, latex, is_watched, .. } = step;
        quote!(#runtime::Elimination { unknowns: &[#(#unknowns),*], pivot: #pivot, latex: #latex, is_watched: #is_watched })
    });
    quote! {
        #runtime::Derivation {
            given: &[#(#given),*],
            phi: &[#phi], phi_q: &[#phi_q], phi_t: &[#phi_t], phi_dot: &[#phi_dot],
            gamma: &[#gamma], mass: &[#mass], forces: &[#forces], rates: &[#rates],
            samples: &[#(#samples),*],
            keeps_energy: #keeps_energy, kinetic_energy: #kinetic, potential_energy: #potential,
            strategy: #strategy, order: &[#(#order),*],
        }
    }
}

fn formula(formula: &Formula, runtime: &TokenStream) -> TokenStream {
    let Formula { of, of_latex, by, by_latex, text, latex, .. } = formula;
    quote! {
        #runtime::Formula {
            of: #of, of_latex: #of_latex, by: #by, by_latex: #by_latex, text: #text, latex: #latex,
        }
    }
}
