//! Errors at run time.

mod message;
mod shown;

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
    /// A force jumps where a value passes a knot of its law, and leads the value back from both sides, as
    /// `-f*sign(der(x))` does where x comes to rest: there is no motion beyond.
    Sliding {
        /// When, in s.
        t: f64,
        /// The value, as people read it.
        name: &'static str,
    },
    /// A law jumps with a value that is held at the jump, but for rounding.
    Undecided {
        /// When, in s.
        t: f64,
        /// The value, as people read it.
        name: &'static str,
    },
    /// A step of which no whole number leads to a sample of a clock, or from one to the next.
    Period {
        /// A memory that the clock sets.
        memory: &'static str,
        /// The period in s.
        period: f64,
        /// The offset in s.
        offset: f64,
        /// The time of the start in s.
        start: f64,
        /// A step that leads to the samples, in s; 0 where none of many does.
        better: f64,
        /// The step in s.
        step: f64,
    },
    /// A memory that a sample has set to no finite number.
    Sample {
        /// Its name.
        memory: &'static str,
        /// Infinite or NaN.
        value: f64,
    },
    /// Memories, for what knows no clocks.
    Clocks {
        /// Its name in a sentence.
        what: &'static str,
        /// A memory.
        memory: &'static str,
    },
    /// The equations of a step, of an implicit method or those that keep positions on the constraints, have no
    /// solution that is found.
    NotConverged {
        /// When, in s.
        t: f64,
        /// The step in s.
        step: f64,
    },
    /// Stops, for what sees no impact.
    Stops {
        /// The name of a method or an analysis.
        what: &'static str,
        /// The first stop.
        stop: &'static str,
    },
    /// Friction that sticks, for what does not see it.
    Sticks {
        /// The name of a method or an analysis.
        what: &'static str,
        /// The first friction.
        friction: &'static str,
    },
    /// Friction that neither sticks nor slides.
    Jammed {
        /// The time in s.
        t: f64,
        /// The friction.
        friction: &'static str,
    },
    /// Constraints that come and go, for what does not see it.
    Modes {
        /// The name of a method or an analysis.
        what: &'static str,
        /// The first mode, or the condition of the first transition.
        mode: &'static str,
    },
    /// A mode that holds where its constraints do not.
    Apart {
        /// The time in s.
        t: f64,
        /// The constraint.
        constraint: &'static str,
        /// Φ in SI units.
        by: f64,
    },
    /// A constraint of a mode that holds against others.
    Contradiction {
        /// The time in s.
        t: f64,
        /// The constraint.
        constraint: &'static str,
        /// Φ̇ in SI units, which cannot become 0.
        rate: f64,
    },
    /// Transitions that follow each other at one moment without an end.
    Endless {
        /// The time in s.
        t: f64,
        /// One of their conditions.
        condition: &'static str,
    },
    /// A state behind a stop.
    Behind {
        /// The time in s.
        t: f64,
        /// The stop.
        stop: &'static str,
        /// Its gap in SI units.
        gap: f64,
        /// The unit of it; empty for a bare number.
        unit: &'static str,
    },
    /// An impact that no impulses answer.
    Impact {
        /// The time in s.
        t: f64,
        /// One of the stops that are hit.
        stop: &'static str,
    },
    /// Impacts that follow each other at one moment without an end.
    EndlessImpacts {
        /// The time in s.
        t: f64,
        /// One of the stops that are hit.
        stop: &'static str,
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
    /// An equation between rates, for a method that knows equations between positions alone.
    Rates {
        /// The word of the method, or what it is.
        method: &'static str,
        /// The name of the equation.
        constraint: &'static str,
    },
    /// A state of the mechanism's own, where the motion is to follow from constraints alone.
    OwnState {
        /// Its name.
        state: &'static str,
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
        /// True if it is its rate Φ̇, and not Φ.
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

impl core::error::Error for Error {}
