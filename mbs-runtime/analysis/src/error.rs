//! Errors of analyses.

/// Why an analysis has no result.
///
/// # Example
/// ```
/// use mbs_analysis::{Error, Search, equilibrium};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     pub Fall {
///         dof = 1;
///         gravity = (0, -9.81) [m/s^2];
///         body ball (y) { mass = 1 [kg]; }
///     }
/// }
///
/// // nothing holds the ball
/// let error = equilibrium(&Fall::declared(), &Search::default()).err();
/// assert!(matches!(error, Some(Error::NoEquilibrium { coordinate: "y", .. })));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An error of the mechanism.
    #[error("{0}")]
    Mechanism(#[from] mbs_runtime::Error),
    /// A mechanism whose motion is prescribed.
    #[error(
        "`{mechanism}` has no degree of freedom here: drives, joints, stops that it rests on and modes that hold \
         determine where it is; ask without one of them how it vibrates"
    )]
    NoFreedom {
        /// The name of the mechanism.
        mechanism: &'static str,
    },
    /// A mechanism that forces lead away from the stop on which it was to rest.
    #[error(
        "nothing holds this mechanism at the stop `{stop}`: forces lead it away, and a stop does not pull; \
         start the search where it may rest, or change its forces"
    )]
    Pulls {
        /// The name of the stop.
        stop: &'static str,
    },
    /// A linear system by parameters about a position that a stop or a mode holds.
    #[error(
        "at this point `{holds}` holds the mechanism, and a linear system by parameters is that of the motion without it; \
         leave the parameters out, or take the difference of two systems"
    )]
    ByParameters {
        /// The name of the stop or of the mode.
        holds: &'static str,
    },
    /// An analysis that does not know states of a declaration's own.
    #[error(
        "`{mechanism}` has a state of its own (`{state}`), and {what} knows positions and velocities alone; \
         simulate it, or leave the state out"
    )]
    OwnStates {
        /// What was asked for, in words.
        what: &'static str,
        /// The name of the mechanism.
        mechanism: &'static str,
        /// The first of its states.
        state: &'static str,
    },
    /// An analysis that does not know equations between rates.
    #[error(
        "`{constraint}` of `{mechanism}` is an equation between rates, and {what} knows those between positions alone; \
         simulate it, or leave the equation out"
    )]
    Rates {
        /// The analysis that was asked for, in words.
        what: &'static str,
        /// The name of the mechanism.
        mechanism: &'static str,
        /// The first of its equations between rates.
        constraint: &'static str,
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
    /// No values of own states were found at which they keep them.
    #[error(
        "no equilibrium was found in {iterations} iterations: the state `{state}` changes by {rate:.3e} (SI) a second at \
         the best position; a state rests where its rate is 0: check that the rate depends on it, or begin nearer to \
         where it rests"
    )]
    NoRest {
        /// The state whose rate is largest, measured by its scale.
        state: &'static str,
        /// Its rate in SI units.
        rate: f64,
        /// The iterations that were made.
        iterations: u32,
    },
    /// A vector of the wrong length.
    #[error("{what} are {found} numbers, but the mechanism has {expected}")]
    Length {
        /// The vector, in words.
        what: &'static str,
        /// The number of values that were given.
        found: usize,
        /// The number of values that are needed.
        expected: usize,
    },
    /// A name that nothing has.
    #[error("unknown {kind} `{name}`; the mechanism has {}", listed(.known))]
    Unknown {
        /// The kind of thing that was looked for.
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
        /// True if it is its rate Φ̇, and not Φ.
        is_rate: bool,
        /// The violation, in the SI unit of the constraint or of its rate.
        violation: f64,
    },
    /// Coordinates that do not determine the position.
    #[error(
        "{} cannot be the states: the mechanism has {}, and as many coordinates that move independently of \
         each other at this position are needed; leave the choice out to have it made",
        listed(.coordinates), degrees(*.dof)
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
    /// A mechanism whose equations cannot be had over duals.
    #[error(
        "`{mechanism}` was compiled without derivatives; give it as `Differentiated(…)`, or its declaration as \
         a text"
    )]
    NoDerivatives {
        /// The name of the mechanism.
        mechanism: String,
    },
    /// Accelerations that are no numbers.
    #[error(
        "the acceleration of `{coordinate}` is no number at this position: the position is singular, or a \
         force is not defined there; choose another one"
    )]
    Undefined {
        /// The coordinate.
        coordinate: &'static str,
    },
    /// A derivative that is no number.
    #[error(
        "{of} has no derivative at this position: a formula is 0/0 or has an infinite slope there, as \
         sqrt(x) has at x = 0; choose another position"
    )]
    Slope {
        /// The quantity without a derivative: "the acceleration of `x`", "the output `y`".
        of: String,
    },
    /// A number that has to be positive.
    #[error("{what} = {value} {unit}: it has to be finite and above 0")]
    Range {
        /// The quantity, in words.
        what: &'static str,
        /// The value that was given.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// A measured sample that cannot be used.
    #[error("sample {} of `{name}` cannot be used: {reason}", index + 1)]
    Sample {
        /// The measured quantity.
        name: String,
        /// The number of the sample, from 0 on.
        index: usize,
        /// Why the sample cannot be used.
        reason: &'static str,
    },
    /// Data from before the run.
    #[error(
        "`{name}` was measured at {t} s, but the run starts at {start} s; leave out the samples before that, or \
         count the time of the data from the start of the motion"
    )]
    BeforeStart {
        /// The measured quantity.
        name: String,
        /// When, in s.
        t: f64,
        /// The time of the start in s.
        start: f64,
    },
    /// Fewer samples than something can be found from.
    #[error(
        "{samples} samples do not determine {unknowns} unknowns: there has to be an unknown, and more samples \
         than unknowns"
    )]
    FewSamples {
        /// The samples of all quantities.
        samples: usize,
        /// The number of unknowns.
        unknowns: usize,
    },
    /// A standard deviation that is none.
    #[error("the standard deviation of `{name}` is {value} (SI), but it has to be finite and above 0")]
    Deviation {
        /// The measured quantity.
        name: String,
        /// The value that was given.
        value: f64,
    },
    /// A probability that is none.
    #[error("the confidence is {value}, but it has to be between 0 and 1, such as 0.95")]
    Confidence {
        /// The value that was given.
        value: f64,
    },
    /// Something that is looked for twice.
    #[error("`{name}` is looked for twice; name it once")]
    Twice {
        /// Its name.
        name: String,
    },
    /// Bounds that do not contain the value from which a quantity is looked for.
    #[error(
        "`{name}` is looked for from {guess} (SI), which does not lie within its bounds {low} to {high}; begin \
         within them, or widen them"
    )]
    Bounds {
        /// The quantity.
        name: String,
        /// The value from which it is looked for.
        guess: f64,
        /// The smallest value that it may have.
        low: f64,
        /// The largest value that it may have.
        high: f64,
    },
    /// A mechanism that does not move in one way.
    #[error(
        "`{mechanism}` has {dof} degrees of freedom, but one that passes positions has 1: {}",
        if *.dof < 1 {
            "take the drive away, whose motion is found from the positions"
        } else {
            "take joints or constraints in until one coordinate determines the others"
        }
    )]
    Freedom {
        /// The name of the mechanism.
        mechanism: &'static str,
        /// Its degrees of freedom.
        dof: i32,
    },
    /// A quantity that is looked for anywhere.
    #[error("`{name}` has no bounds; give the smallest and the largest value that it may have")]
    NoBounds {
        /// Its name.
        name: String,
    },
    /// No positions to pass.
    #[error(
        "{positions} positions cannot be passed: there have to be two or more, with finite values, of which some \
         may be free"
    )]
    NoPositions {
        /// Their number.
        positions: usize,
    },
    /// Unknowns that the data do not determine.
    #[error("{}", undetermined(.along))]
    Undetermined {
        /// Changes of the unknowns, relative to their values, along which the data stay the same.
        along: Vec<(String, f64)>,
    },
    /// A measured quantity that is not defined along any motion that was tried.
    #[error(
        "what was measured is not defined along the motion from any start; begin nearer to what was measured, or \
         leave out samples at which the mechanism is singular"
    )]
    NoPrediction,
    /// Eigenvalues that were not found.
    #[error(
        "the eigenvalues of the linear system were not found: its entries span {decades:.0} decades; check \
         the units of masses and stiffnesses"
    )]
    Eigenvalues {
        /// Decades between the largest and the smallest entry that is not 0.
        decades: f64,
    },
    /// A motion of another number of coordinates than the mechanism has degrees of freedom.
    #[error(
        "{}, but the mechanism has {}: prescribe as many coordinates as that, each once; the others follow",
        prescribed(.coordinates), degrees(*.dof)
    )]
    Prescribed {
        /// The coordinates that are prescribed.
        coordinates: Vec<String>,
        /// The degrees of freedom.
        dof: i32,
    },
    /// Samples through which no curve leads.
    #[error("no curve leads through the samples: {reason}")]
    Samples {
        /// The reason.
        reason: &'static str,
    },
    /// A prescribed position to which the mechanism cannot be led.
    #[error(
        "{}: the mechanism can be led to {place}; there `{coordinate}` can move while what is prescribed stands \
         still (a dead centre or a change point), so that `{constraint}` can be met no further, or on several \
         branches; prescribe a motion that ends before, or another coordinate",
        reached(*.sample)
    )]
    Unreachable {
        /// Which sample of the motion, counted from 1; 0 for the position from which it begins.
        sample: usize,
        /// The last place to which it can be led, in words.
        place: String,
        /// The constraint that ties what is prescribed.
        constraint: &'static str,
        /// The coordinate that can move.
        coordinate: &'static str,
    },
    /// Inputs that cannot produce a motion.
    #[error(
        "sample {sample} (t = {t:.6} s) takes {effort:.6e} (SI) along `{coordinate}` more than {} can produce \
         there; take inputs that act along it, or prescribe a motion that they can make",
        listed(.inputs)
    )]
    Unproducible {
        /// Which sample of the motion, counted from 1.
        sample: usize,
        /// When, in s.
        t: f64,
        /// The coordinate along which most is missing.
        coordinate: &'static str,
        /// The force or torque that is missing there, in SI units.
        effort: f64,
        /// The inputs that there are.
        inputs: Vec<String>,
    },
    /// A mechanism whose motion no input can change.
    #[error(
        "`{mechanism}` has no inputs that could produce a motion; declare one, such as `input torque [N*m];`, or \
         ask for the forces along the prescribed coordinates themselves"
    )]
    NoInputs {
        /// The name of the mechanism.
        mechanism: &'static str,
    },
    /// Coordinates that rest nowhere near while others are led.
    #[error(
        "sample {sample} of the travel: {} no equilibrium near the one before, at {place}; the mechanism snaps \
         through there, or nothing holds {}",
        if .coordinates.len() == 1 { format!("{} finds", listed(.coordinates)) }
        else { format!("{} find", listed(.coordinates)) },
        if .coordinates.len() == 1 { "it" } else { "them" }
    )]
    Snap {
        /// Which sample, counted from 1.
        sample: usize,
        /// The coordinates that are not led.
        coordinates: Vec<String>,
        /// The last place to which the mechanism was led, in words.
        place: String,
    },
    /// Somebody ended a search before it found anything.
    #[error("interrupted before there was a result")]
    Interrupted,
    /// A drive that does nothing, or is none.
    #[error("`{name}` is not a drive that moves: a mechanism is led along a coordinate, or a drive of it")]
    NoDrive {
        /// The constraint that was named.
        name: String,
    },
}

fn reached(sample: usize) -> String {
    if sample == 0 {
        return "the motion cannot begin".into();
    }
    format!("sample {sample} of the motion cannot be reached")
}

impl Error {
    /// Refuses a mechanism with own states where an analysis does not know them.
    pub(crate) fn refuse_states(info: &mbs_runtime::Info, what: &'static str) -> Result<(), Self> {
        match info.coordinates.get(info.lines) {
            Some(state) => Err(Self::OwnStates { what, mechanism: info.name, state: state.name }),
            None => Ok(()),
        }
    }

    /// Refuses a mechanism with equations between rates where an analysis does not know them.
    pub(crate) fn refuse_rates(info: &mbs_runtime::Info, what: &'static str) -> Result<(), Self> {
        match info.constraints.iter().find(|row| row.is_rate) {
            Some(row) => Err(Self::Rates { what, mechanism: info.name, constraint: row.name }),
            None => Ok(()),
        }
    }
}

fn listed(names: &[String]) -> String {
    if names.is_empty() {
        return "none".into();
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// `1 degree of freedom`, `2 degrees of freedom`.
fn degrees(dof: i32) -> String {
    format!("{dof} degree{} of freedom", if dof == 1 { "" } else { "s" })
}

fn prescribed(names: &[String]) -> String {
    if names.is_empty() {
        return "no motion is prescribed".into();
    }
    format!("the motion of {} is prescribed", listed(names))
}

fn undetermined(along: &[(String, f64)]) -> String {
    if let [(name, _)] = along {
        return format!(
            "the data do not determine `{name}`: they do not depend on it; do not look for it, or measure \
             something that it changes"
        );
    }
    let names: Vec<String> = along.iter().map(|(name, _)| name.clone()).collect();
    let percent =
        |change: &f64| format!("{change:+.2}").trim_end_matches('0').trim_end_matches('.').to_owned();
    let changes = along.iter().map(|(name, change)| format!("`{name}` by {} %", percent(change)));
    format!(
        "the data do not determine {} together: a change of {} at once leaves them the same; hold one of them, or \
         measure something else",
        listed(&names),
        changes.collect::<Vec<_>>().join(", ")
    )
}
