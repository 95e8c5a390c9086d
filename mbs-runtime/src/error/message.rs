//! Errors in words.

use core::fmt;

use super::Error;
use super::shown::{Plain, Shown, Violated};

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
                 the defaults are 1e-6 (rtol) and a thousandth of rtol (atol)"
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
            Self::Sliding { t, name } => write!(
                f,
                "no motion goes on from t = {t} s: a law jumps with `{name}`, and leads it back to the jump from both sides; \
                 give the jump a slope, as `tanh(v/v0)` in the place of `sign(v)`; dry friction is the element `friction`",
                t = Shown(t)
            ),
            Self::Undecided { t, name } => write!(
                f,
                "at t = {t} s a law jumps with `{name}`, which rests at the jump, so that rounding decides on which side it \
                 is; leave the jump out, or put it where the value does not rest, as in `if x > 1e-6 [m]` for `if x > 0 [m]`",
                t = Shown(t)
            ),
            Self::Period { memory, period, offset, start, step, better } => {
                write!(f, "the clock of `{memory}` samples every {} s", Plain(period))?;
                if offset != 0.0 {
                    write!(f, " from {} s on", Plain(offset))?;
                }
                write!(f, ", and no whole number of steps of {} s leads there", Plain(step))?;
                if start != 0.0 {
                    write!(f, " from the start at {} s", Plain(start))?;
                }
                match better > 0.0 {
                    true => write!(f, "; take steps of {} s, or ", Plain(better))?,
                    false => f.write_str("; no constant step leads to the samples of all clocks: take ")?,
                }
                f.write_str("a run to a tolerance, whose steps end at samples")
            }
            Self::Sample { memory, value } => write!(
                f,
                "a sample has set the memory `{memory}` to {}; check the divisors and functions of its `set`",
                Plain(value)
            ),
            Self::Clocks { what, memory } => write!(
                f,
                "{what} knows no clocks, and one sets the memory `{memory}`; simulate the mechanism"
            ),
            Self::NotConverged { t, step } => write!(
                f,
                "the equations of the step from t = {t} s could not be solved; take a step shorter than {step} s; \
                 if none is short enough, a force has an infinite slope there",
                t = Shown(t),
                step = Plain(step)
            ),
            Self::Stops { what, stop } => write!(
                f,
                "{what} does not see the impacts of the stop `{stop}`; runs to a tolerance by an explicit pair do, as with \
                 `--rtol 1e-8`"
            ),
            Self::Sticks { what, friction } => write!(
                f,
                "{what} does not see where the friction `{friction}` sticks; runs do, with constant steps and to a tolerance by \
                 an explicit pair"
            ),
            Self::Jammed { t, friction } => write!(
                f,
                "at t = {t} s the friction `{friction}` neither sticks nor slides: several that press on each other, or one \
                 that jams, as its coefficient times its reaction grows with itself",
                t = Shown(t)
            ),
            Self::Modes { what, mode } => write!(
                f,
                "{what} does not see what `{mode}` changes; runs do, with constant steps and to a tolerance by an explicit pair"
            ),
            Self::Apart { t, constraint, by } => write!(
                f,
                "at t = {t} s a mode holds whose constraint `{constraint}` is off by {} in SI units: enter it where its joints \
                 close, or take a `rate` for what holds anywhere",
                Shown(by),
                t = Shown(t)
            ),
            Self::Contradiction { t, constraint, rate } => write!(
                f,
                "at t = {t} s the constraint `{constraint}` of a mode contradicts what else holds, another mode, a drive or a joint: \
                 its rate stays at {} in SI units; leave one of them before",
                Shown(rate),
                t = Shown(t)
            ),
            Self::Endless { t, condition } => write!(
                f,
                "at t = {t} s what `{condition}` sets lets conditions begin to hold anew, and has no end: let a condition that \
                 enters be another one than that which leaves",
                t = Shown(t)
            ),
            Self::Behind { t, stop, gap, unit } => write!(
                f,
                "at t = {t} s this position is behind the stop `{stop}`: its gap is {gap}{space}{unit}; a mechanism starts \
                 and rests before its stops: check the values, and on which side of `<=` they are",
                t = Shown(t),
                gap = Shown(gap),
                space = if unit.is_empty() { "" } else { " " }
            ),
            Self::Impact { t, stop } => write!(
                f,
                "at t = {t} s no impulses answer the impact at the stop `{stop}`: stops that contradict each other, a \
                 drive that pushes against one, friction that jams what slides, or steps longer than the way between two",
                t = Shown(t)
            ),
            Self::EndlessImpacts { t, stop } => write!(
                f,
                "at t = {t} s impacts at the stop `{stop}` and others follow each other without an end: stops close on what is \
                 between them; end the run before, or let one of them give way by a `stiffness`",
                t = Shown(t)
            ),
            Self::VelocityForce { coordinate } => write!(
                f,
                "the force along, or the rate of `{coordinate}` depends on velocities or reactions, and RATTLE takes forces of positions, time and inputs alone; leave dampers, friction and particles beside the \
                 centre of a body out, or take another method"
            ),
            Self::ReducedStates { method } => write!(
                f,
                "the method `{method}` integrates all coordinates; leave `states = reduced;` out of the \
                 declaration, or take another method"
            ),
            Self::Rates { method, constraint } => write!(
                f,
                "{method} knows equations between positions alone, and `{constraint}` is one between rates; take another \
                 method"
            ),
            Self::OwnState { state } => write!(
                f,
                "the state `{state}` follows from its equation over time, and not from the constraints; simulate the \
                 mechanism"
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
                        "; constraints repeat each other, and the compiler chose what is left out by following the mechanism \
                         from its start: if others hold it here, declare those first"
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
                     that position at all, take a smaller step or smaller gains, or for stiff forces a run to a \
                     tolerance by `esdirk4`",
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
