//! What can go wrong in an analysis.

/// Why an analysis has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// What the mechanism said.
    #[error("{0}")]
    Mechanism(#[from] mbs_runtime::Error),
    /// A mechanism whose motion is prescribed.
    #[error(
        "`{mechanism}` has no degree of freedom: its drives and constraints determine where it is; \
         take a drive away to ask where it rests"
    )]
    NoFreedom {
        /// The name of the mechanism.
        mechanism: &'static str,
    },
    /// No position near the given one at which nothing moves.
    #[error(
        "no equilibrium was found in {iterations} iterations: `{coordinate}` still accelerates with \
         {acceleration:.3e} (SI) at the best position; check that a spring, a stop or gravity holds it, \
         or begin nearer to where it rests"
    )]
    NoEquilibrium {
        /// The coordinate that accelerates most, measured by the scale of the mechanism.
        coordinate: &'static str,
        /// Its acceleration in SI units.
        acceleration: f64,
        /// The iterations that were made.
        iterations: u32,
    },
    /// A vector of the wrong length.
    #[error("{what} are {found} numbers, but the mechanism has {expected}")]
    Length {
        /// What it is.
        what: &'static str,
        /// How many numbers were given.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
}
