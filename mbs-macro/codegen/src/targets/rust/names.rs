//! Names of the generated items and paths to the runtime.

use std::cell::RefCell;

use mbs_symbolic::Inconsistency;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::compiled::Compiled;

/// Names of the generated items.
pub struct Names {
    /// Path of the runtime crate.
    pub runtime: TokenStream,
    pub nalgebra: TokenStream,
    pub mechanism: Ident,
    pub parameters: Ident,
    /// Type of the inputs, with its argument `T`.
    pub inputs: Group,
    pub coordinates: Group,
    /// The coordinates that are integrated: all, unless some are left out.
    pub states: Group,
    pub constraints: Group,
    pub outputs: Group,
    /// Layouts that do not compute what their programs do, as the names are with every
    /// program that is written.
    pub faults: RefCell<Vec<Inconsistency>>,
    /// `State<…Coordinates<T>>`
    pub state: TokenStream,
    /// `State<…States<T>>`: what a step is given.
    pub stepped: TokenStream,
    /// `Reactions<…Coordinates<T>, …Constraints<T>>`
    pub reactions: TokenStream,
}

/// A generated vector with named components, or the runtime's empty one.
pub struct Group {
    /// The type, `…<T>`.
    pub of_t: TokenStream,
    /// The generated name; `None` where there are no components.
    pub name: Option<Ident>,
}

impl Names {
    pub fn new(compiled: &Compiled) -> Self {
        let runtime = compiled.written.runtime.clone();
        let group = |suffix: &str, is_empty: bool| {
            if is_empty {
                return Group { of_t: quote!(#runtime::NoComponents<T>), name: None };
            }
            let name = format_ident!("{}{suffix}", compiled.written.name);
            Group { of_t: quote!(#name<T>), name: Some(name) }
        };
        let coordinates = group("Coordinates", false);
        let states = if compiled.has_reduced_states() {
            group("States", compiled.states.is_empty())
        } else {
            Group { of_t: coordinates.of_t.clone(), name: None }
        };
        let constraints = group("Constraints", compiled.constraints.is_empty());
        let (q, s, rows) = (&coordinates.of_t, &states.of_t, &constraints.of_t);
        Self {
            faults: RefCell::default(),
            state: quote!(#runtime::State<#q>),
            stepped: quote!(#runtime::State<#s>),
            reactions: quote!(#runtime::Reactions<#q, #rows>),
            nalgebra: quote!(#runtime::__private::nalgebra),
            mechanism: compiled.written.name.clone(),
            parameters: format_ident!("{}Parameters", compiled.written.name),
            inputs: group("Inputs", compiled.inputs.is_empty()),
            outputs: group("Outputs", compiled.outputs.is_empty()),
            coordinates,
            states,
            constraints,
            runtime,
        }
    }
}

/// The fields of the vectors that most functions return.
pub struct Fields {
    pub coordinates: Vec<Ident>,
    pub states: Vec<Ident>,
    pub rows: Vec<Ident>,
}

impl Fields {
    pub fn new(compiled: &Compiled) -> Self {
        Self {
            coordinates: compiled.coordinates.iter().map(|c| field(&c.name)).collect(),
            states: compiled.states.iter().map(|&at| field(&compiled.coordinates[at].name)).collect(),
            rows: compiled.constraints.iter().map(|constraint| field(&constraint.name)).collect(),
        }
    }
}

/// A name of the declaration as an identifier of generated code.
pub fn field(name: &str) -> Ident {
    match name.strip_prefix("r#") {
        Some(raw) => Ident::new_raw(raw, Span::call_site()),
        None => Ident::new(name, Span::call_site()),
    }
}
