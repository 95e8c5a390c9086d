//! A text as sources for others: C, functional mock-up units, WebAssembly.

use mbs_codegen::targets::{self, CSources, Experiment, Fmu, Scalar, Wasm};

use crate::Text;
use crate::error::Error;

impl Text {
    /// Compiles the declaration to C99: a header, a source, an example and a page.
    ///
    /// # Errors
    /// As [`compile`](Self::compile).
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Scalar, Text};
    ///
    /// let text = "Slider { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }";
    /// let sources = Text::declaration("slider.mbs", text).c(Scalar::Float)?;
    /// assert!(sources.source.text.contains("slider_step"));
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    pub fn c(&self, scalar: Scalar) -> Result<CSources, Error> {
        self.make(move |_, compiled| targets::c(compiled, scalar))
    }

    /// Compiles the declaration to the files of a functional mock-up unit: descriptions for importers,
    /// and C code with the functions of the standard.
    ///
    /// # Errors
    /// As [`compile`](Self::compile).
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Experiment, Text};
    ///
    /// let text = "Slider { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }";
    /// let fmu = Text::declaration("slider.mbs", text).fmu(Experiment { step: 1e-3, end: 1.0 })?;
    /// assert!(fmu.sources.iter().any(|file| file.text.contains("fmi3DoStep")));
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    pub fn fmu(&self, experiment: Experiment) -> Result<Fmu, Error> {
        self.make(move |_, compiled| targets::fmi(compiled, experiment))
    }

    /// Compiles the declaration to a WebAssembly module, with the tables that the script of its runs
    /// reads.
    ///
    /// # Errors
    /// As [`compile`](Self::compile).
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let text = "Slider { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }";
    /// let slider = Text::declaration("slider.mbs", text).wasm()?;
    /// assert!(slider.module.starts_with(b"\0asm") && slider.module.len() < 20_000);
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    pub fn wasm(&self) -> Result<Wasm, Error> {
        self.make(|_, compiled| targets::wasm(compiled))
    }
}
