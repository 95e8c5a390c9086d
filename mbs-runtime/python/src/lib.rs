//! Mechanisms in Python: what the package `mbs` stands on.
//!
//! The package itself is Python, in the folder `mbs`: names, units, arrays and pictures are put together there. This
//! library compiles and runs, without the interpreter's lock, and hands over numbers. Both read the same texts as the
//! command line, and give the same numbers to the bit.
//!
//! # Mechanisms of a program
//!
//! A crate with mechanisms of `mechanism!` becomes a Python module by one line of [`module!`]: its runs are compiled
//! by rustc, and used as those of a text.
//!
//! ```text
//! mbs_runtime::mechanism! {
//!     pub Pendulum { … }
//! }
//! mbs_python::module!(pendulums: Pendulum);
//! ```
//!
//! Built by `maturin` as a `cdylib` called `pendulums`, `import pendulums` gives `pendulums.Pendulum`, an
//! `mbs.Mechanism`. The crate needs `mbs-runtime` with its macro and this one.
#![forbid(unsafe_code)]

mod analysis;
mod asked;
mod derivatives;
mod error;
mod fit;
mod linear;
mod mechanism;
mod recording;
mod simulation;
mod simulations;
mod stepped;
mod sweep;
mod synthesis;
mod watched;

#[doc(hidden)]
pub use pyo3;

pub use mechanism::Mechanism;

use mbs_workbench::{Model, Settings, model};
use pyo3::prelude::*;

/// The part of the package `mbs` that is not Python.
#[pymodule(gil_used = false)]
mod _native {
    #[pymodule_export]
    use crate::linear::Linear;
    #[pymodule_export]
    use crate::mechanism::{Mechanism, compile};
    #[pymodule_export]
    use crate::recording::Recording;
    #[pymodule_export]
    use crate::simulation::Simulation;
    #[pymodule_export]
    use crate::simulations::Simulations;

    #[pymodule_init]
    fn versioned(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        pyo3::types::PyModuleMethods::add(module, "__version__", env!("CARGO_PKG_VERSION"))
    }
}

/// A Python module with mechanisms that `mechanism!` compiled: `module!(name: Type, …);`.
#[macro_export]
macro_rules! module {
    ($name:ident: $($mechanism:ty),+ $(,)?) => {
        #[$crate::pyo3::pymodule]
        #[pyo3(crate = "::mbs_python::pyo3")]
        fn $name(module: &$crate::pyo3::Bound<'_, $crate::pyo3::types::PyModule>) -> $crate::pyo3::PyResult<()> {
            $($crate::add::<$mechanism>(module)?;)+
            Ok(())
        }
    };
}

/// Adds a mechanism to a module, under its name.
#[doc(hidden)]
pub fn add<M: mbs_runtime::Mechanism<Real = f64>>(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let model: Box<dyn Model> = model::differentiated::<M>(Settings::default());
    let name = model.info().name;
    let native = Py::new(module.py(), Mechanism::of(model))?;
    let mechanism = module.py().import("mbs")?.getattr("Mechanism")?.call1((native,))?;
    module.add(name, mechanism)
}
