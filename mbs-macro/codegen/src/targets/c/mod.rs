//! C99: a header, a source, an example, a page that explains them, and what builds and installs
//! them as a library. The code allocates
//! nothing, has no variables at file level, and needs `math.h` alone.
//!
//! Structs have a member per name of the declaration. Kernels, the functions that one
//! program each computes, are printed by `kernels`; long ones as `loops`. The C text in `text`
//! makes a run of them. It is the same for every mechanism.
//!
//! In double precision the results are those of the Rust target to the bit, where a
//! compiler neither contracts products and sums (`-ffp-contract=off`) nor uses registers that
//! are wider (x87), as far as the functions of `math.h` agree with Rust's: `sqrt` does
//! always; sines and cosines are printed with the code.

mod docs;
mod header;
mod instructions;
mod kernels;
mod loops;
mod names;
mod source;
mod target;

use std::cell::RefCell;

use mbs_symbolic::Inconsistency;

use crate::compiled::Compiled;
use crate::diagnostics::{Diagnostic, Diagnostics};
use names::Names;
use target::Target;

pub(super) use source::beginning;
pub use target::Scalar;

/// A file with its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its name, without a folder.
    pub name: String,
    /// Its text, in UTF-8.
    pub text: String,
}

/// A mechanism in C.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CSources {
    /// The beginning of every name at file level.
    pub prefix: String,
    /// The types and functions.
    pub header: File,
    /// The code.
    pub source: File,
    /// A program that runs the mechanism and prints a table.
    pub example: File,
    /// How to compile and use them.
    pub readme: File,
    /// A `CMakeLists.txt`, a `Makefile`, and what both make the file of `pkg-config` of.
    pub build: [File; 3],
}

impl CSources {
    /// All files.
    pub fn files(&self) -> impl Iterator<Item = &File> {
        [&self.header, &self.source, &self.example, &self.readme].into_iter().chain(&self.build)
    }

    /// Those that are called so for every mechanism; the first line of each has the name of its own.
    pub fn named_alike(&self) -> impl Iterator<Item = &File> {
        let [cmake, make, _] = &self.build;
        [&self.example, &self.readme, cmake, make].into_iter()
    }
}

/// The C sources of a mechanism.
///
/// # Example
/// ```
/// use mbs_codegen::targets::{Scalar, c};
///
/// let declaration = "Pendulum {
///     dof = 1;
///     param length = 1 [m];
///     gravity = (0, -9.81) [m/s^2];
///     body bob (x, y) { mass = 2 [kg]; }
///     constraint rod: x^2 + y^2 = length^2;
///     start { x = length; guess y = 0; }
/// }";
/// let sources = c(&mbs_codegen::analyse(declaration.parse()?)?, Scalar::Double)?;
/// assert_eq!(sources.header.name, "pendulum.h");
/// assert!(sources.header.text.contains("int pendulum_step(struct pendulum_run *run);"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A program that would be written in another way than it was checked in, which is a mistake of the compiler.
pub fn c(compiled: &Compiled, scalar: Scalar) -> Result<CSources, Diagnostics> {
    printed(compiled, scalar, false)
}

/// The C sources of a mechanism, with functions that give exact derivatives along a direction: of
/// accelerations, reactions, outputs and events by the state and the inputs.
///
/// # Errors
/// As [`c`].
pub fn c_with_tangents(compiled: &Compiled, scalar: Scalar) -> Result<CSources, Diagnostics> {
    printed(compiled, scalar, true)
}

fn printed(compiled: &Compiled, scalar: Scalar, has_tangents: bool) -> Result<CSources, Diagnostics> {
    let names = Names::new(compiled);
    let target = Target { compiled, names: &names, scalar, faults: RefCell::default() };
    let internal = |fault: Inconsistency| Diagnostic::internal(compiled.written.name.span(), fault);
    let mut kernels = kernels::all(&target).map_err(internal)?;
    if has_tangents {
        kernels.extend(kernels::tangents(&target).map_err(internal)?);
    }
    let fused = kernels::fused(&target);
    if let Some(fault) = target.faults.take().into_iter().next() {
        return Err(internal(fault).into());
    }
    let file = |name: String, text| File { name, text };
    Ok(CSources {
        header: file(format!("{}.h", names.prefix), header::header(&target, &kernels)),
        source: file(format!("{}.c", names.prefix), source::source(&target, &kernels, &fused)),
        example: file("main.c".to_owned(), source::example(&target)),
        readme: file("README.md".to_owned(), docs::readme(&target)),
        build: [
            file("CMakeLists.txt".to_owned(), docs::build(&target, include_str!("text/CMakeLists.txt"))),
            file("Makefile".to_owned(), docs::build(&target, include_str!("text/Makefile"))),
            file(format!("{}.pc.in", names.prefix), docs::build(&target, include_str!("text/package.pc.in"))),
        ],
        prefix: names.prefix,
    })
}
