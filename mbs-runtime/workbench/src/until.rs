//! `--until 'x3 > 200mm'`, `--until impact`: a value or an event at which a run ends.

use mbs_analysis::{Signal, Variable};
use mbs_runtime::{Dimension, Direction, Info, MOST_EVENTS, Measured, Threshold};

use crate::instant::Instant;
use crate::{Error, Unit, quantity};

/// The condition or the event that ends a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Until {
    /// As it was written.
    pub text: String,
    /// Its meaning.
    pub ending: Ending,
}

/// Where a run ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// Where a comparison becomes true.
    Threshold(Threshold),
    /// At the event of this index.
    Event(usize),
}

impl Until {
    /// The name of a declared event; that of a mode, a stop or friction that sticks, which ends the run where it is entered, is hit
    /// or begins to stick or slide; the condition of a `when`, as it is declared; or a condition
    /// of the form `x3 > 200mm`: a coordinate, the rate `der(…)` of one, an output, a memory, or the multiplier `lambda(…)`
    /// of a constraint, and a value with an optional unit.
    ///
    /// # Errors
    /// Another form, a name that the mechanism does not have, a value of another dimension.
    pub fn parse(info: &Info, text: &str) -> Result<Self, Error> {
        let text = text.trim();
        // stops, frictions that stick and conditions of `when` count down from the last one
        let mut events = (0..info.events.len()).chain((info.events.len()..MOST_EVENTS).rev());
        let wanted = plain(text);
        let named = |at| Some((at, info.event_name(at).filter(|name| plain(name) == wanted)?));
        if let Some((at, name)) = events.find_map(named) {
            // as it is told among the events
            return Ok(Self { text: name.to_owned(), ending: Ending::Event(at) });
        }
        if let Some(entered) = entered(info, of_mode(text)) {
            return Ok(Self { text: text.to_owned(), ending: Ending::Threshold(entered) });
        }
        let Some(at) = text.find(['<', '>']) else { return Err(no_condition(info, text)) };
        let (name, rest) = text.split_at(at);
        let direction = if rest.starts_with('>') { Direction::Rising } else { Direction::Falling };
        let value = rest.trim_start_matches(['<', '>', '=']).trim();
        let (measured, dimension, unit) = measured(info, name.trim())?;
        let value = quantity::parse_in(name.trim(), value, dimension, &unit)?;
        let holds_there = rest.get(1..).is_some_and(|it| it.starts_with('='));
        let value = match (measured, direction) {
            (Measured::Input(_), _) => beside(value, direction, holds_there),
            _ if holds_there => value,
            // a value that stands at the limit, such as an output that counts, does not meet it
            (_, Direction::Falling) => value.next_down(),
            _ => value.next_up(),
        };
        let threshold = Threshold { measured, value, direction };
        Ok(Self { text: text.to_owned(), ending: Ending::Threshold(threshold) })
    }

    /// The comparison that ends a run, if it is one.
    pub(crate) fn threshold(&self) -> Option<Threshold> {
        match self.ending {
            Ending::Threshold(threshold) => Some(threshold),
            Ending::Event(_) => None,
        }
    }

    /// How far a state is inside of it: positive where it is true. An event is never.
    pub(crate) fn margin(&self, now: &Instant) -> f64 {
        let Some(Threshold { measured, value, direction }) = self.threshold() else { return f64::NAN };
        let found = match measured {
            Measured::Position(at) => now.q.get(at),
            Measured::Velocity(at) => now.v.get(at),
            Measured::Output(at) => now.outputs.get(at),
            Measured::Multiplier(at) => now.multipliers.get(at),
            Measured::Input(at) => now.inputs.get(at),
        };
        found.map_or(f64::NAN, |found| match direction {
            Direction::Falling => value - found,
            Direction::Rising | Direction::Either => found - value,
        })
    }
}

/// A name or a condition without blanks, and with the names of parts as they are told: `s[2]` is `s_2`, `left.end` `left_end`.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        let digits = rest.find(']').map(|end| &rest[..end]).filter(|digits| {
            letter == '[' && !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit())
        });
        match digits {
            Some(digits) => {
                plain += "_";
                plain += digits;
                rest = &rest[digits.len() + 1..];
            }
            None if letter.is_whitespace() => {}
            // no point of a number
            None if letter == '.' && rest.starts_with(char::is_alphabetic) => plain.push('_'),
            None => plain.push(letter),
        }
    }
    plain
}

/// A limit that a memory does not jump to but passes, beside one of a comparison: `n > 2` becomes true with 3.
fn beside(value: f64, direction: Direction, holds_there: bool) -> f64 {
    let little = (1e-12 * value.abs()).max(f64::MIN_POSITIVE);
    let is_above = (direction == Direction::Rising) != holds_there;
    if is_above { value + little } else { value - little }
}

/// The name behind `mode =`, which may be left out.
fn of_mode(text: &str) -> &str {
    let named = text.strip_prefix("mode").and_then(|rest| rest.trim_start().strip_prefix('='));
    named.map_or(text, str::trim)
}

/// Where a mode of this name is entered, if there is one.
fn entered(info: &Info, name: &str) -> Option<Threshold> {
    let mode = info.modes.modes.iter().find(|mode| mode.name == name)?;
    let (measured, direction) = (Measured::Input(mode.memory), Direction::Rising);
    Some(Threshold { measured, value: 0.5, direction })
}

/// Why a text without a comparison ends no run.
fn no_condition(info: &Info, text: &str) -> Error {
    let events = info.events.iter().map(|event| event.name);
    let names = events.chain(info.stops.iter().map(|stop| stop.name));
    let names = names.chain(info.frictions.iter().map(|friction| friction.name));
    let names = names.chain(info.modes.modes.iter().map(|mode| mode.name));
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    let declared = match &names[..] {
        [] => String::new(),
        names => format!(", or what is declared so ({})", names.join(", ")),
    };
    let is_name = text.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
    let soft = if is_name {
        "; a contact, or a stop that gives way, ends a run by an output of its force"
    } else {
        ""
    };
    let expected = "a condition is expected, for instance 'x3 > 200mm' or 'der(theta) < 0'";
    Error::Name { name: text.to_owned(), reason: format!("{expected}{declared}{soft}") }
}

/// The quantity called so, its dimension, and the unit of a bare number.
fn measured(info: &Info, name: &str) -> Result<(Measured, Dimension, Unit), Error> {
    let wanted: String = name.chars().filter(|letter| !letter.is_whitespace()).collect();
    let known = [Signal::observable(info), Signal::memories(info)].concat();
    let found = known.iter().find_map(|signal| {
        let measured = match signal.variable {
            Variable::Coordinate(at) => Measured::Position(at),
            Variable::Velocity(at) => Measured::Velocity(at),
            Variable::Output(at) => Measured::Output(at),
            Variable::Multiplier(at) => Measured::Multiplier(at),
            Variable::Input(at) => Measured::Input(at),
            Variable::Parameter(_) => return None,
        };
        (signal.name == wanted).then(|| (measured, signal.dimension, Unit::of_signal(info, signal)))
    });
    let names = known.iter().map(|signal| signal.name.as_str());
    found.ok_or_else(|| Error::unknown("coordinate, rate, output or multiplier", name, names))
}

/// Something that happened during a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    /// The name of the event, or the condition that ended the run.
    pub name: String,
    /// When, in s.
    pub t: f64,
    /// True if its value became positive.
    pub is_rising: bool,
}

/// A condition that was to end a run and did not.
#[derive(Clone, Debug, PartialEq)]
pub struct Unmet {
    /// As it was written.
    pub condition: String,
    /// True if it was true from the start, so that it could not become true.
    pub holds_at_start: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    mbs_runtime::mechanism! {
        Door {
            dof = 1;
            body leaf (angle = theta) { inertia = 2 [kg*m^2]; }
            body latch (x) { mass = 1 [kg]; }
            coupler rod: x = 0.1 [m]*theta;
            event open: theta = 90 [deg] rising;
            mode held { constraint catch: theta = 1; }
            mode bolted { constraint bolt: theta = 0; }
            when theta > 1 { enter held; }
            when t > 9 [s] { leave held; enter bolted; }
            start { der(theta) = 1 [rad/s]; }
            output opening [mm] = x;
            output held = held;
        }
    }

    fn read(text: &str) -> Result<Ending, Error> {
        Until::parse(<Door as mbs_runtime::Mechanism>::INFO, text).map(|until| until.ending)
    }

    #[test]
    fn conditions_have_names_directions_and_units() {
        let is = |text: &str, measured, value: f64, direction| {
            let Ok(Ending::Threshold(found)) = read(text) else { panic!("{text} is a comparison") };
            assert_eq!((found.measured, found.direction), (measured, direction), "{text}");
            assert!((found.value - value).abs() < 1e-15, "{text}: {}", found.value);
        };
        is("theta > 90deg", Measured::Position(0), std::f64::consts::FRAC_PI_2, Direction::Rising);
        is("theta<1.5", Measured::Position(0), 1.5, Direction::Falling);
        is("x >= 20 mm", Measured::Position(1), 0.02, Direction::Rising);
        is("der(x) < -5 mm/s", Measured::Velocity(1), -0.005, Direction::Falling);
        is("der(theta) > 60rpm", Measured::Velocity(0), std::f64::consts::TAU, Direction::Rising);
        // of a `when` it is the event where that begins to hold
        for text in ["theta > 1", "theta>1", "t > 9[s]"] {
            assert!(matches!(read(text), Ok(Ending::Event(_))), "{text}: {:?}", read(text));
        }
        assert_eq!(plain("force(l.s[12]) > 5.2 [N]"), "force(l_s_12)>5.2[N]");
        // a bare number is in the unit that tables show
        is("opening > 20", Measured::Output(0), 0.02, Direction::Rising);
        is("lambda(rod) > 3N", Measured::Multiplier(0), 3.0, Direction::Rising);
    }

    #[test]
    fn a_declared_event_goes_by_its_name() {
        assert_eq!(read(" open ").ok(), Some(Ending::Event(0)));
    }

    #[test]
    fn a_mode_is_entered() {
        for text in ["held", "mode=held", "mode = held"] {
            let Ok(Ending::Threshold(found)) = read(text) else { panic!("{text} is a mode") };
            let held = <Door as mbs_runtime::Mechanism>::INFO.modes.modes[0].memory;
            assert_eq!((found.measured, found.direction), (Measured::Input(held), Direction::Rising));
        }
    }

    #[test]
    fn other_conditions_are_refused() {
        for (text, part) in [
            ("opens", "or what is declared so (`open`, `held`, `bolted`)"),
            ("x = 3", "x3 > 200mm"),
            ("y > 3", "theta"),
            ("x > 20 deg", "20 deg"),
            ("x > much", "much"),
            ("der(y) > 1", "der(theta)"),
        ] {
            let message = read(text).expect_err(text).to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
    }
}
