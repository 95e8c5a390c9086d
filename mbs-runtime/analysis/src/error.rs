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
         take a drive away to ask where it rests or how it vibrates"
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
    /// A name that nothing has.
    #[error("unknown {kind} `{name}`; the mechanism has {}", listed(.known))]
    Unknown {
        /// What kind of thing was looked for.
        kind: &'static str,
        /// The name that was given.
        name: String,
        /// The names that exist.
        known: Vec<String>,
    },
    /// A state that the constraints do not allow.
    #[error(
        "the state is not on the constraints: {}`{constraint}` is violated by {violation:.3e} (SI); make it \
         consistent first, by `start::project` or as the state of a run",
        if *.is_rate { "the rate of " } else { "" }
    )]
    OffConstraints {
        /// The constraint that is violated most.
        constraint: &'static str,
        /// Whether it is its rate Φ̇, and not Φ.
        is_rate: bool,
        /// By how much, in its own SI unit.
        violation: f64,
    },
    /// Coordinates that do not determine the position.
    #[error(
        "{} cannot be the states: the mechanism has {dof} degree(s) of freedom, and as many coordinates \
         that move independently of each other at this position are needed; leave the choice out to have it \
         made",
        listed(.coordinates)
    )]
    Dependent {
        /// The coordinates that were asked for.
        coordinates: Vec<String>,
        /// The degrees of freedom.
        dof: i32,
    },
    /// Parameters that change, of a mechanism that was given without its family.
    #[error(
        "`{parameter}` can be an input where the mechanism can be made with other parameters; set \
         `Ports::family`, for instance to `of_type::<M>()`"
    )]
    NoFamily {
        /// The parameter.
        parameter: String,
    },
    /// Accelerations that are no numbers.
    #[error(
        "the acceleration of `{coordinate}` is no number at the operating point: the position is singular, or \
         a force is not defined there; choose another one"
    )]
    Undefined {
        /// The coordinate.
        coordinate: &'static str,
    },
    /// A frequency or a time that has no response.
    #[error("{what} = {value} {unit} has no response: it has to be finite and above 0")]
    Range {
        /// What it is.
        what: &'static str,
        /// What was given.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// Eigenvalues that were not found.
    #[error(
        "the eigenvalues of the linear system were not found: its entries span {decades:.0} decades; check \
         the units of masses and stiffnesses"
    )]
    Eigenvalues {
        /// Decades between the largest and the smallest entry that is not 0.
        decades: f64,
    },
}

fn listed(names: &[String]) -> String {
    if names.is_empty() {
        return "none".into();
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
