//! The span over which a declaration promises to close, followed by continuation.

use super::start::value;
use crate::diagnostics::{Diagnostic, joined};
use crate::independence::assembly::{Assembly, Closing, Position};
use crate::independence::words::{Part, unit};
use crate::model::{Closes, Model};

/// Steps over the whole span.
const STEPS: f64 = 180.0;

/// A step is halved as often as this before the span counts as left: the place is
/// told to that share of a step.
const HALVINGS: u32 = 30;

/// Steps that are tried before the span counts as too long: more than a thousand turns.
const MOST_STEPS: usize = 30_000;

/// How far a step may move the mechanism, in radians or typical lengths; what moves
/// farther has jumped to another branch.
const LARGEST_MOVE: f64 = 0.3;

/// The mechanism closes everywhere in the declared span, on the branch of its start.
///
/// # Errors
/// Where it does not, and which constraint keeps it from that.
pub fn check_span(
    model: &Model,
    assembly: &Assembly<'_>,
    rows: &[usize],
    start: &Position,
) -> Result<(), Diagnostic> {
    let Some(closes) = &model.closes else { return Ok(()) };
    let ends = model.arena.evaluate(&[closes.from, closes.to], &model.values(|_| f64::NAN));
    let [from, to] = [ends[0], ends[1]];
    if !(from.is_finite() && to.is_finite() && from < to) {
        return Err(Diagnostic::new(closes.span, "this span is empty at the declared parameters")
            .help("its first end has to be the smaller one, and both finite"));
    }
    let path = Path { model, assembly, rows, closes, stride: (to - from) / STEPS };
    let begin = match closes.coordinate {
        Some(at) => start.q[at],
        None => start.t,
    };
    path.follow(start, begin, from)?;
    path.follow(start, begin, to)
}

struct Path<'a> {
    model: &'a Model,
    assembly: &'a Assembly<'a>,
    rows: &'a [usize],
    closes: &'a Closes,
    stride: f64,
}

impl Path<'_> {
    /// From an assembled position to the end `to`: every round halves the step, no more than
    /// `HALVINGS` times in a row, or advances by it, and a step that was accepted is doubled only
    /// as far as the stride.
    fn follow(&self, start: &Position, begin: f64, to: f64) -> Result<(), Diagnostic> {
        let direction = (to - begin).signum();
        let (mut at, mut here, mut before) = (start.clone(), begin, None);
        let mut halvings = 0_u32;
        for _ in 0..MOST_STEPS {
            if (to - here) * direction <= 0.0 {
                return Ok(());
            }
            let step = self.stride / f64::from(1_u32 << halvings);
            let next = if (to - here).abs() <= step { to } else { here + direction * step };
            match self.close(&at, before.as_ref(), here, next) {
                Ok(closed) => {
                    before = Some((here, std::mem::replace(&mut at, closed)));
                    here = next;
                    halvings = halvings.saturating_sub(1);
                }
                Err(_) if halvings < HALVINGS => halvings += 1,
                Err(open) => return Err(self.ends(here, &open)),
            }
        }
        Err(self.too_long(here))
    }

    /// The position at `next`, near the one that the last two lead to.
    fn close(
        &self,
        at: &Position,
        before: Option<&(f64, Position)>,
        here: f64,
        next: f64,
    ) -> Result<Position, Closing> {
        let mut guess = at.clone();
        if let Some((earlier, position)) = before {
            let ratio = (next - here) / (here - earlier);
            let slopes = at.q.iter().zip(&position.q).map(|(q, before)| q + ratio * (q - before));
            guess.q = slopes.collect();
        }
        match self.closes.coordinate {
            Some(coordinate) => guess.q[coordinate] = next,
            None => guess.t = next,
        }
        let closing = self.assembly.close_with(self.rows, &guess, self.closes.coordinate.as_slice());
        let is_near = self.assembly.distance(&closing.at, at) <= LARGEST_MOVE;
        if closing.is_closed && is_near { Ok(closing.at) } else { Err(closing) }
    }

    /// A value of what is followed.
    fn place(&self, here: f64) -> String {
        match self.closes.coordinate {
            Some(at) => {
                format!("{} = {}", self.model.coordinates[at].quantity.name, value(self.model, at, here))
            }
            None => format!("t = {here:.6} s"),
        }
    }

    fn too_long(&self, here: f64) -> Diagnostic {
        let place = self.place(here);
        let message =
            format!("this span is too long to be followed: {MOST_STEPS} steps lead as far as {place}");
        Diagnostic::new(self.closes.span, message)
            .help("name a span after which the motion repeats itself, such as one turn, `0 .. 360 [deg]`")
    }

    fn ends(&self, here: f64, open: &Closing) -> Diagnostic {
        let place = self.place(here);
        let message = format!("the mechanism does not close over this span: it ends at {place}");
        let error = Diagnostic::new(self.closes.span, message)
            .help("change the lengths such that the links reach each other everywhere, or the span");
        match self
            .assembly
            .worst(self.rows, open)
            .and_then(|row| Some((row, self.model.constraints.get(row)?)))
        {
            Some((row, constraint)) => {
                let unit = unit(constraint.dimension);
                let what = joined(Part::of(self.model, [row]));
                error.note(
                    constraint.span,
                    format!("beyond, {what} cannot be met{}", violation(open, row, unit)),
                )
            }
            None => error,
        }
    }
}

fn violation(open: &Closing, row: usize, unit: &str) -> String {
    let violation = open.phi.get(row).copied().unwrap_or_default().abs();
    if violation > 1e-6 { format!(" (violated by {violation:.1e}{unit})") } else { String::new() }
}
