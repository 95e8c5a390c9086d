//! The data that the functions of a long program share, and the parts of such a function.

use mbs_symbolic::layout::Layout;
use mbs_symbolic::{Program, SinCos};
use proc_macro2::{Ident, TokenStream};

use crate::compiled::{Compiled, Vector};
use crate::targets::rust::access::{Access, Argument};
use crate::targets::rust::names::Names;

/// The data that the functions of a program share.
pub struct Context<'a> {
    pub compiled: &'a Compiled,
    pub names: &'a Names,
    pub program: &'a Program,
    /// How symbols are read within the functions.
    pub access: &'a Access,
    pub pairs: &'a SinCos,
    pub layout: &'a Layout<Vector>,
}

/// The statements of a function, and what it takes.
pub struct Definition {
    pub name: Ident,
    pub doc: Option<String>,
    pub statements: TokenStream,
    pub arguments: Vec<Argument>,
}
