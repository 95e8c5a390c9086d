//! `start { … }`: values, rates and first guesses of coordinates, and the time.

use mbs_symbolic::units::Dimension;

use super::hints::in_radians;
use super::known::Value;
use super::names::Place;
use super::resolver::Resolver;
use super::{Meaning, Start};
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::syntax;

impl Resolver<'_> {
    /// The position of a coordinate; one whose name is also that of something else, which
    /// is an error, is looked for among all.
    pub(super) fn coordinate_named(&self, name: &str) -> Option<usize> {
        match self.scope.values.get(name) {
            Some(Value::Symbol { symbol, .. }) => match self.scope.meaning(*symbol) {
                Meaning::Coordinate(at) => Some(at),
                _ => self.coordinates.iter().position(|c| c.quantity.name == name),
            },
            Some(Value::Definition(_)) => self.coordinates.iter().position(|c| c.quantity.name == name),
            Some(Value::Refused(_)) | None => None,
        }
    }

    pub(super) fn resolve_start(&mut self, entry: &syntax::StartEntry) {
        let text = entry.coordinate.to_string();
        if text == "t" && entry.prefix.is_empty() {
            self.resolve_start_time(entry);
            return;
        }
        let Some(coordinate) = self.coordinate_named(&text) else {
            if matches!(self.scope.values.get(&text), Some(Value::Refused(_))) {
                return;
            }
            let names: Vec<_> = self.coordinates.iter().map(|c| c.quantity.name.as_str()).collect();
            let hint = match nearest(&text, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the coordinates are {}", listing(&names)),
            };
            self.errors.push(
                Diagnostic::new(entry.coordinate.span(), format!("there is no coordinate `{text}`"))
                    .help(hint),
            );
            return;
        };
        if self.coordinates[coordinate].is_own() {
            return self.resolve_start_of_state(coordinate, entry);
        }
        let dimension = self.coordinates[coordinate].quantity.dimension;
        let dimension = if entry.is_rate { dimension.over(Dimension::TIME) } else { dimension };
        let what = if entry.is_rate {
            format!("the start velocity `der({text})`")
        } else {
            format!("the start of `{text}`")
        };
        let earlier = self.starts.iter().find(|s| s.coordinate == coordinate && s.is_rate == entry.is_rate);
        if let Some(earlier) = earlier {
            let earlier = earlier.span;
            self.repeated(&what, entry.coordinate.span(), earlier);
            return;
        }
        let is_angle = !entry.is_rate && dimension == Dimension::NONE;
        if is_angle && self.errors.take(in_radians(&entry.value)).is_none() {
            return;
        }
        let value =
            self.scope.formula_of(&entry.value, Place::Property, (&what, dimension), &mut self.errors);
        if let Some(value) = value {
            let (is_rate, is_guess, span) = (entry.is_rate, entry.is_guess, entry.coordinate.span());
            self.starts.push(Start { coordinate, is_rate, is_guess, value, span });
        }
    }

    /// `current = 1 [A];` in `start`.
    fn resolve_start_of_state(&mut self, state: usize, entry: &syntax::StartEntry) {
        let name = &entry.coordinate;
        if entry.is_rate || entry.is_guess {
            let message = match entry.is_rate {
                true => format!("the rate of the state `{name}` follows from its equation"),
                false => format!("the state `{name}` starts at a value: nothing corrects a guess of it"),
            };
            let help = format!("write `{name} = …;`, the value at the start");
            self.errors.push(Diagnostic::new(name.span(), message).help(help));
            return;
        }
        self.start_state(state, name, &entry.value);
    }

    /// `t = 1 [s];` in `start`.
    fn resolve_start_time(&mut self, entry: &syntax::StartEntry) {
        let span = entry.coordinate.span();
        if entry.is_rate || entry.is_guess {
            self.errors.push(
                Diagnostic::new(span, "the time of the start is a value")
                    .help("write `t = 1 [s];`, without `guess` or `der`"),
            );
            return;
        }
        if let Some((_, earlier)) = self.start_time {
            self.repeated("the time of the start", span, earlier);
            return;
        }
        let what = ("the time of the start", Dimension::TIME);
        let value = self.scope.formula_of(&entry.value, Place::Property, what, &mut self.errors);
        self.start_time = value.map(|value| (value, span));
    }
}
