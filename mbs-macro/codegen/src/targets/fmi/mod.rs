//! The functional mock-up interface, versions 2.0 and 3.0: the descriptions of a mechanism for
//! importers, and the functions of the standard around its C code, for model exchange and for
//! co-simulation.
//!
//! [`Fmu`] has the files that are packed into an FMU. One binary serves both versions, since their
//! functions have different names.
//!
//! # How it works
//!
//! * `text` has the functions of the standard. Both versions ask for most of them, and these are written
//!   once. `fmi2.c` and `fmi3.c` translate.
//! * `variables` is the list of variables. The place of a variable is its value reference in code and
//!   descriptions.
//! * `structure` finds dependencies by `Program::reads`.
//! * The C code of the mechanism has tangents, for directional derivatives.
//!
//! `fmu` of the workbench compiles and packs the files.
//!
//! # Source
//! Functional Mock-up Interface for Model Exchange and Co-Simulation, 2.0.4 (2022) and 3.0.2 (2024),
//! Modelica Association, <https://fmi-standard.org>.

mod code;
mod description;
mod structure;
mod units;
mod variables;
mod xml;

use description::Description;
use variables::References;

use super::c::{File, Scalar, c_with_tangents};
use crate::compiled::Compiled;
use crate::diagnostics::Diagnostics;

/// A version of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// 2.0
    V2,
    /// 3.0
    V3,
}

impl Version {
    /// As descriptions write it.
    pub fn number(self) -> &'static str {
        match self {
            Self::V2 => "2.0",
            Self::V3 => "3.0",
        }
    }
}

/// The experiment that is proposed to an importer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Experiment {
    /// The step of co-simulation in s: a communication step is divided into steps of this length, or a
    /// little shorter.
    pub step: f64,
    /// How long to simulate, in s.
    pub end: f64,
}

/// The files of a functional mock-up unit, without binaries and pictures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fmu {
    /// The name of the binary, without its ending.
    pub identifier: String,
    /// `modelDescription.xml` of each version.
    pub descriptions: [(Version, String); 2],
    /// The C code, in the folder `sources`; the last file includes what it needs of the others.
    pub sources: Vec<File>,
    /// `sources/buildDescription.xml` of version 3.0.
    pub build: String,
    /// `terminalsAndIcons/terminalsAndIcons.xml` of version 3.0.
    pub terminals: String,
}

/// The files of a mechanism as a functional mock-up unit.
///
/// # Example
/// ```
/// use mbs_codegen::targets::{Experiment, fmi};
///
/// let declaration = "Block { dof = 1; param k = 4 [N/m]; input push [N];
///     body block (x) { mass = 2 [kg]; } force spring on x = push - k*x; start { x = 1 [m]; } }";
/// let compiled = mbs_codegen::analyse(declaration.parse()?)?;
/// let fmu = fmi(&compiled, Experiment { step: 1e-3, end: 1.0 })?;
/// assert_eq!(fmu.identifier, "block");
/// for (_, description) in &fmu.descriptions {
///     assert!(description.contains(r#"name="der(x,2)""#));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A program that would be written in another way than it was checked in, which is a mistake
/// of the compiler.
pub fn fmi(compiled: &Compiled, experiment: Experiment) -> Result<Fmu, Diagnostics> {
    let c = c_with_tangents(compiled, Scalar::Double)?;
    let references = References::new(compiled);
    let variables = variables::all(compiled, &references);
    let code = code::source(compiled, &c.prefix, &references, experiment);
    let names = [c.source.name.clone(), format!("{}_fmi.c", c.prefix)];
    let sources = names.each_ref().map(String::as_str);
    let mut description = Description {
        compiled,
        references: &references,
        variables: &variables,
        identifier: &c.prefix,
        token: code::TOKEN,
        experiment,
        sources: &sources,
    };
    // the token is that of everything but itself
    let versions = [Version::V2, Version::V3];
    let texts = versions.map(|version| description.document(version));
    let token = token([&c.header.text, &c.source.text, &code].into_iter().chain(&texts));
    description.token = &token;
    let descriptions = versions.map(|version| (version, description.document(version)));
    let fmi = File { name: names[1].clone(), text: code.replace(code::TOKEN, &token) };
    Ok(Fmu {
        descriptions,
        build: description::build(&c.prefix, &sources),
        terminals: description::terminals(&variables),
        identifier: c.prefix,
        sources: vec![c.header, c.source, fmi],
    })
}

/// 128 bits of these texts, in the form of a GUID (FNV-1a).
fn token<'a>(texts: impl Iterator<Item = &'a String>) -> String {
    const PRIME: u128 = (1 << 88) + 0x13b;
    let bytes = texts.flat_map(|text| text.bytes());
    let hash = bytes.fold(0x6c62272e07bb014262b821756295c58d_u128, |hash, byte| {
        (hash ^ u128::from(byte)).wrapping_mul(PRIME)
    });
    let digits = format!("{hash:032x}");
    let (a, rest) = digits.split_at(8);
    let (b, rest) = rest.split_at(4);
    let (c, rest) = rest.split_at(4);
    let (d, e) = rest.split_at(4);
    format!("{{{a}-{b}-{c}-{d}-{e}}}")
}
