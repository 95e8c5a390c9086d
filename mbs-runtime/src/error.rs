//! Errors at run time.

mod shown;

use core::fmt;

use shown::{Plain, Shown, Violated};

/// Why a mechanism could not be built, started or advanced.
///
/// Every variant names the thing in the words of the declaration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A parameter is not finite or violates a condition.
    Parameter {
        /// The parameter, or the body property computed from parameters.
        name: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// The condition on the value, in words.
        requirement: &'static str,
    },
    /// An input is not finite.
    Input {
        /// The input.
        name: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// A step that is not positive and finite.
    Step {
        /// The step in s.
        step: f64,
    },
    /// An end time that is not finite or lies before the current time.
    EndTime {
        /// The end time in s.
        end: f64,
        /// The current time in s.
        now: f64,
    },
    /// A time that is not finite, or at which a step is lost in rounding.
    Time {
        /// The time in s.
        t: f64,
        /// The step in s.
        step: f64,
    },
    /// A gain that is negative or not finite.
    Gain {
        /// `alpha` or `beta`.
        name: &'static str,
        /// Its value in 1/s.
        value: f64,
    },
    /// A tolerance that is not positive and finite, or smaller than rounding permits.
    Tolerance {
        /// `rtol` or `atol`.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The smallest value that can be asked for.
        least: f64,
    },
    /// A scheme that cannot tell the error of its steps, for a run to a tolerance.
    NoEstimate {
        /// Its word.
        scheme: &'static str,
    },
    /// No step is short enough for the tolerance.
    StepTooShort {
        /// When, in s.
        t: f64,
        /// The step in s that would have been tried next.
        step: f64,
    },
    /// A run to a tolerance took all the steps that it may take.
    TooManySteps {
        /// When, in s.
        t: f64,
        /// Number of steps that the run took.
        steps: u64,
    },
    /// A program turns a value around at its event, and the value is back there before it has left zero by
    /// more than rounding: impacts that follow each other faster and faster, or a state that nothing holds.
    EndlessEvents {
        /// When, in s.
        t: f64,
        /// The event that is declared; empty for a value of the program.
        name: &'static str,
        /// Its place among the events or values.
        index: usize,
    },
    /// The equations of a step, of an implicit method or those that keep positions on the constraints, have no
    /// solution that is found.
    NotConverged {
        /// When, in s.
        t: f64,
        /// The step in s.
        step: f64,
    },
    /// A force that depends on velocities or reactions, for a method that takes none.
    VelocityForce {
        /// A coordinate along which it acts.
        coordinate: &'static str,
    },
    /// Reduced states, for a method that integrates all coordinates.
    ReducedStates {
        /// Its word.
        method: &'static str,
    },
    /// A gain of feedback where the constraints are kept by projection.
    NoUseOfGain {
        /// `alpha` or `beta`.
        name: &'static str,
        /// Its value in 1/s.
        value: f64,
    },
    /// A scheme that this program cannot run.
    Scheme {
        /// Its word.
        name: &'static str,
    },
    /// Gains with which the constraint violation grows from step to step.
    UnstableGains {
        /// α in 1/s.
        alpha: f64,
        /// β in 1/s.
        beta: f64,
        /// The step in s.
        step: f64,
        /// `held` or `per-stage`.
        feedback: &'static str,
    },
    /// A pivot of the elimination vanished: constraints depend on each other
    /// in this position, or a massless coordinate is undetermined. Without
    /// names: friction jams, or no single pivot is to blame.
    Singular {
        /// When, in s.
        t: f64,
        /// The constraint of the pivot; empty for a pure mass pivot.
        constraint: &'static str,
        /// The coordinate of the pivot; empty for a pure constraint pivot.
        coordinate: &'static str,
        /// The pivot growth.
        growth: f64,
        /// `true` if the mechanism has redundant constraints. They take no part in the elimination, and might hold
        /// where the chosen ones depend on each other.
        has_redundant: bool,
    },
    /// A constraint that held cannot be met any more: a drive leads beyond what the
    /// dimensions allow, or a step is much too long for the motion.
    OutOfReach {
        /// When, in s: the end of the step that was refused.
        t: f64,
        /// The constraint.
        constraint: &'static str,
        /// By how much it stays violated at least, in its own SI unit.
        violation: f64,
    },
    /// A coordinate, its velocity or its acceleration became infinite or NaN.
    NonFinite {
        /// When, in s.
        t: f64,
        /// The coordinate.
        coordinate: &'static str,
    },
    /// A result that is not finite, though the motion is.
    Undefined {
        /// When, in s.
        t: f64,
        /// The kind of result: `the output`, `the multiplier of constraint`, …
        what: &'static str,
        /// Its name.
        name: &'static str,
        /// Infinite or NaN.
        value: f64,
    },
    /// A derivative in reverse of a mechanism that was compiled without transposed programs.
    NoTranspose {
        /// The mechanism.
        mechanism: &'static str,
    },
    /// Less memory than the states take of which a derivative in reverse goes back.
    Memory {
        /// How much may be taken, in bytes.
        allowed: usize,
        /// How much is needed.
        needed: usize,
    },
    /// A start that was given violates a constraint. [`start::project`](crate::start::project) makes one
    /// consistent that keeps no more coordinates than there are degrees of freedom.
    Inconsistent {
        /// When, in s.
        t: f64,
        /// The constraint that is violated most, measured by what is allowed.
        constraint: &'static str,
        /// Whether it is its rate Φ̇, and not Φ.
        is_rate: bool,
        /// By how much, in its own SI unit, for a rate per second.
        violation: f64,
        /// How much is allowed.
        allowed: f64,
    },
    /// A coordinate that was to be kept, but does not exist.
    NoCoordinate {
        /// Its name.
        name: &'static str,
    },
    /// A variable that a sum over a run was to be differentiated by, but does not exist.
    NoVariable {
        /// A parameter, a coordinate or an input.
        what: &'static str,
        /// Its name.
        name: &'static str,
    },
    /// A vector of the wrong length.
    Length {
        /// The vector, in words.
        what: &'static str,
        /// How many numbers were given.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// The positions could not be brought onto Φ = 0.
    NotAssembled {
        /// When, in s.
        t: f64,
        /// The constraint that is violated most.
        constraint: &'static str,
        /// By how much.
        violation: f64,
    },
    /// Kinematic analysis of a mechanism that the drives do not determine.
    NotDriven {
        /// Degrees of freedom that are left.
        dof: i32,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Parameter { name, value, requirement } => {
                write!(f, "`{name}` is {}, but {requirement}", Plain(value))
            }
            Self::Input { name, value } => {
                write!(f, "input `{name}` is {}, but it has to be finite", Plain(value))
            }
            Self::Step { step } => {
                write!(f, "the step is {} s, but it has to be positive and finite", Plain(step))
            }
            Self::EndTime { end, now } => write!(
                f,
                "the end time is {end} s, but it has to be finite and not before the current {now} s",
                now = Shown(now),
                end = Shown(end)
            ),
            Self::Time { t, step } => write!(
                f,
                "the time is {t} s, but it has to be finite and small enough for a step of {step} s to be more \
                 than its rounding",
                t = Shown(t),
                step = Plain(step)
            ),
            Self::Gain { name, value } => {
                write!(f, "the gain {name} is {} 1/s, but it has to be finite and not negative", Plain(value))
            }
            Self::Tolerance { name, value, least } => write!(
                f,
                "the tolerance {name} is {value:?}, but it has to be finite and at least {least:.1e}; \
                 the defaults are 1e-6 (rtol) and 1e-9 (atol)"
            ),
            Self::NoEstimate { scheme } => write!(
                f,
                "the scheme `{scheme}` cannot tell the error of its steps, which a run to a tolerance needs; \
                 take `bs3`, `dopri5` or `dop853`"
            ),
            Self::TooManySteps { t, steps } => write!(
                f,
                "the run came to t = {t} s in {steps} steps, and may take no more; end it earlier, take a larger \
                 tolerance or, if stiff forces make its steps short, softer ones",
                t = Shown(t)
            ),
            Self::StepTooShort { t, step } => write!(
                f,
                "the tolerance cannot be met at t = {t} s: the next step would be {step:.1e} s long; the motion \
                 has a jump there, or the tolerance is below the rounding of the forces",
                t = Shown(t)
            ),
            Self::EndlessEvents { t, name, index } => {
                match name {
                    "" => write!(f, "the event of the value {index}")?,
                    name => write!(f, "the event `{name}`")?,
                }
                write!(
                    f,
                    " follows itself without end at t = {t} s: it was turned around there, and is back before \
                     rounding can tell; end the run at an impact that is slow enough, or hold there what comes to rest",
                    t = Shown(t)
                )
            }
            Self::NotConverged { t, step } => write!(
                f,
                "the equations of the step from t = {t} s could not be solved; take a step shorter than {step} s; \
                 if none is short enough, a force has an infinite slope there",
                t = Shown(t),
                step = Plain(step)
            ),
            Self::VelocityForce { coordinate } => write!(
                f,
                "a force along `{coordinate}` depends on velocities or reactions, and RATTLE takes forces of \
                 positions, time and inputs alone; leave dampers and friction out, or take another method"
            ),
            Self::ReducedStates { method } => write!(
                f,
                "the method `{method}` integrates all coordinates; leave `states = reduced;` out of the \
                 declaration, or take another method"
            ),
            Self::NoUseOfGain { name, value } => write!(
                f,
                "the gain {name} is {} 1/s, but projection needs no gains; they belong to held or \
                 per-stage feedback",
                Plain(value)
            ),
            Self::Scheme { name } => {
                write!(f, "the scheme `{name}` has no type here; run the declaration as a text")
            }
            Self::UnstableGains { alpha, beta, step, feedback } => write!(
                f,
                "the gains alpha = {alpha} 1/s, beta = {beta} 1/s are unstable with {feedback} feedback \
                 and a step of {step} s: the constraint violation would grow; reduce them or the step, \
                 or leave both out, so that they are chosen for the step",
                alpha = Plain(alpha),
                beta = Plain(beta),
                step = Plain(step)
            ),
            Self::Singular { t, constraint, coordinate, growth, has_redundant } => {
                write!(f, "singular position at t = {t} s: ", t = Shown(t))?;
                match (constraint, coordinate) {
                    ("", "") => write!(
                        f,
                        "the constrained system has no unique solution: friction jams, or no single constraint is to blame"
                    )?,
                    (c, "") => write!(f, "constraint `{c}` depends on the others there")?,
                    ("", q) => write!(f, "nothing determines the acceleration of `{q}` there")?,
                    (c, q) => write!(f, "constraint `{c}` does not determine `{q}` there")?,
                }
                write!(f, " (pivot growth {growth:.1e})")?;
                if has_redundant && !constraint.is_empty() {
                    write!(
                        f,
                        "; of the constraints that repeat each other these are solved for, and they depend on \
                         each other there: declare others of them first, which are then taken in their place"
                    )?;
                }
                Ok(())
            }
            Self::OutOfReach { t, constraint, violation } => write!(
                f,
                "out of reach at t = {t} s: constraint `{constraint}` cannot be met there any more{}; check the \
                 dimensions and how far the drives go, or take a smaller step if the mechanism can get there",
                Violated(violation),
                t = Shown(t)
            ),
            Self::NonFinite { t, coordinate } => {
                match coordinate {
                    // all stages were finite, and their sum is not
                    "" => f.write_str("the motion")?,
                    _ => write!(f, "the motion of `{coordinate}`")?,
                }
                write!(
                    f,
                    " is no longer finite at t = {t} s; if the mechanism can reach \
                     that position at all, take a smaller step or smaller gains, or for stiff forces the \
                     method `trbdf2`",
                    t = Shown(t)
                )
            }
            Self::Undefined { t, what, name, value } => {
                let (value, t) = (Plain(value), Shown(t));
                write!(f, "{what} `{name}` is {value} at t = {t} s, but it has to be finite")
            }
            Self::Inconsistent { t, constraint, is_rate, violation, allowed } => {
                let (what, per_second) =
                    if is_rate { ("rate of constraint", "/s") } else { ("constraint", "") };
                write!(
                    f,
                    "the start at t = {t} s is not consistent: the {what} `{constraint}` is violated by \
                     {violation:.3e}{per_second}, and at most {allowed:.1e}{per_second} is kept as it is; \
                     give values for no more coordinates than there are degrees of freedom, so that the others \
                     can follow",
                    t = Shown(t)
                )
            }
            Self::NoTranspose { mechanism } => write!(
                f,
                "`{mechanism}` was compiled without transposed programs, so that a run of it cannot be \
                 differentiated in reverse; add `gradients = reverse;` to its declaration, or compile it with \
                 `Text::compile_with_transposes`"
            ),
            Self::Memory { allowed, needed } => write!(
                f,
                "going back through the run takes {needed} bytes for states, and {allowed} may be taken"
            ),
            Self::NoCoordinate { name } => write!(f, "there is no coordinate `{name}` to keep"),
            Self::NoVariable { what, name } => {
                write!(
                    f,
                    "there is no {what} `{name}` to differentiate by; check its name in the declaration"
                )
            }
            Self::Length { what, found, expected } => {
                write!(f, "{what} has room for {found} numbers, but there are {expected}")
            }
            Self::NotAssembled { t, constraint, violation } => write!(
                f,
                "the mechanism cannot be assembled at t = {t} s: constraint `{constraint}` cannot be met{}; check \
                 the dimensions, or start from a closer guess",
                Violated(violation),
                t = Shown(t)
            ),
            Self::NotDriven { dof } => write!(
                f,
                "the constraints leave {dof} degree{} of freedom, so they do not determine the motion; \
                 add drives or integrate the equations of motion",
                if dof == 1 { "" } else { "s" }
            ),
        }
    }
}

impl core::error::Error for Error {}
