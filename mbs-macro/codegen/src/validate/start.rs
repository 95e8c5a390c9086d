//! The declared start, against the one that the constraints allow.

use mbs_symbolic::units::Dimension;

use super::programs::{Declared, Programs};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::independence::assembly::Position;
use crate::model::{Block, Meaning, Model, Start};
use crate::quantity::Quantity;

/// The deviation that a declared value may have, as a share of the size of the mechanism, or
/// in radians; that of a rate is a share of the fastest one. Published starts are printed to
/// four digits and are corrected by less.
const SHARE: f64 = 1e-3;

/// Values and rates that are no guesses start as they are declared.
///
/// # Errors
/// Those that cannot be kept.
pub fn check_kept(
    model: &Model,
    programs: &Programs<'_>,
    declared: &Declared,
    at: &Position,
    beyond_dead_centre: impl FnOnce() -> Option<String>,
) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::default();
    let positions = programs.units.iter().map(|unit| SHARE * unit).collect::<Vec<_>>();
    let lost = not_kept_of(model, false, &declared.at.q, &at.q, &positions);
    match lost.first().and_then(|lost| Some((lost, beyond_dead_centre()?))) {
        Some((lost, guess)) => errors.push(dead_centre(model, lost, &guess)),
        None => lost.iter().for_each(|lost| errors.push(not_kept(model, lost))),
    }
    if let Some(velocities) = programs.velocities(at, &declared.velocities) {
        let fastest = programs.size(&declared.velocities).max(programs.size(&velocities));
        let rates = programs.units.iter().map(|unit| SHARE * unit * fastest).collect::<Vec<_>>();
        let lost = not_kept_of(model, true, &declared.velocities, &velocities, &rates);
        lost.iter().for_each(|lost| errors.push(not_kept(model, lost)));
    }
    errors.finish(())
}

/// A declared value, or rate, that the constraints change.
struct Lost<'a> {
    start: &'a Start,
    /// True if it is the first of its kind that is declared.
    is_first: bool,
    declared: f64,
    becomes: f64,
}

fn not_kept_of<'a>(
    model: &'a Model,
    is_rate: bool,
    declared: &[f64],
    kept: &[f64],
    limits: &[f64],
) -> Vec<Lost<'a>> {
    let values = model.start.iter().filter(|start| start.is_rate == is_rate && !start.is_guess);
    let lost = values.enumerate().filter_map(|(place, start)| {
        let at = start.coordinate;
        let is_kept = (kept[at] - declared[at]).abs() <= limits[at];
        // what is left of rounding is 0
        let becomes = if kept[at].abs() < 1e-6 * limits[at] { 0.0 } else { kept[at] };
        (!is_kept).then_some(Lost { start, is_first: place == 0, declared: declared[at], becomes })
    });
    lost.collect()
}

/// A declared value that is left from guesses at a dead centre.
fn dead_centre(model: &Model, lost: &Lost<'_>, guess: &str) -> Diagnostic {
    let name = &model.coordinates[lost.start.coordinate].quantity.name;
    let [declared, becomes] =
        [lost.declared, lost.becomes].map(|found| value(model, lost.start.coordinate, found));
    Diagnostic::new(
        lost.start.span,
        format!(
            "`{name}` cannot start at {declared} from these guesses, which are a dead centre: what would have to \
             move does not move the constraints there, and they make it {becomes}"
        ),
    )
    .help(format!("guess a position on the side that is meant, for example with `{guess}`"))
}

fn not_kept(model: &Model, lost: &Lost<'_>) -> Diagnostic {
    let start = lost.start;
    let name = &model.coordinates[start.coordinate].quantity.name;
    let (what, of) = if start.is_rate {
        (format!("der({name})"), rate as fn(&Model, usize, f64) -> String)
    } else {
        (name.clone(), value as fn(&Model, usize, f64) -> String)
    };
    let [declared, kept] = [lost.declared, lost.becomes].map(|value| of(model, start.coordinate, value));
    let (with, or_others) = match lost.is_first {
        true => ("", ""),
        false => (" and the values before it", ", or make guesses of the others"),
    };
    let message = format!("`{what}` cannot start at {declared}: the constraints{with} make it {kept}");
    Diagnostic::new(start.span, message).help(format!(
        "write `{what} = {kept};`, or `guess {what} = {declared};` if it is a first guess{or_others}"
    ))
}

/// The error for a particle whose place has no value at the start.
pub fn without_place(model: &Model, at: &Position) -> Option<Diagnostic> {
    let symbols = model.values(|meaning| match meaning {
        Meaning::Coordinate(coordinate) => at.q.get(coordinate).copied().unwrap_or(f64::NAN),
        _ => f64::NAN,
    });
    model.particles.iter().zip(&model.particle_names).find_map(|(particle, name)| {
        let place = model.arena.evaluate(&particle.place.components(), &symbols);
        let wrong = place.iter().zip(["x", "y"]).find(|(x, _)| !x.is_finite());
        wrong.map(|(value, axis)| {
            Diagnostic::new(name.span(), format!("the place of `{name}` has no value at the start: its {axis} is {value}"))
                .help("declare a start at which the formula of its point, its roots, quotients and tables have a value")
        })
    })
}

/// The error for a start in a singular position.
pub fn singular(
    model: &Model,
    (row, coordinate): (Option<usize>, Option<usize>),
    elsewhere: Option<String>,
) -> Diagnostic {
    let constraint = row.and_then(|row| model.constraints.get(row));
    let coordinate = coordinate.and_then(|at| model.coordinates.get(at));
    let (span, what) = match (constraint, coordinate) {
        (Some(constraint), Some(coordinate)) => (
            constraint.span,
            format!("{} does not determine `{}`", constraint.source, coordinate.quantity.name),
        ),
        (Some(constraint), None) => {
            (constraint.span, format!("{} depends on the other constraints", constraint.source))
        }
        (None, Some(coordinate)) => (
            coordinate.span,
            format!("nothing determines the acceleration of `{}`", coordinate.quantity.name),
        ),
        (None, None) => (model.name.span(), "the equations of motion have no unique solution".to_owned()),
    };
    let help = match elsewhere {
        Some(guess) => format!("start in another position, for example with `{guess}`"),
        None => "declare a start in another position, or give massless parts a mass".to_owned(),
    };
    Diagnostic::new(span, format!("the declared start is a singular position: {what} there")).help(help)
}

/// A value of a coordinate as it is written in a declaration.
pub fn value(model: &Model, coordinate: usize, value: f64) -> String {
    if let Some(unit) = own_unit(model, coordinate) {
        return format!("{} [{}]", rounded(value / unit.scale), unit.unit);
    }
    if is_length(model, coordinate) {
        format!("{} [m]", rounded(value))
    } else {
        format!("{} [deg]", rounded(value.to_degrees()))
    }
}

fn rate(model: &Model, coordinate: usize, value: f64) -> String {
    if let Some(unit) = own_unit(model, coordinate) {
        return format!("{} [{}/s]", rounded(value / unit.scale), unit.unit);
    }
    let unit = if is_length(model, coordinate) { "[m/s]" } else { "[rad/s]" };
    format!("{} {unit}", rounded(value))
}

/// The quantity of a coordinate of its own, whose unit is declared.
fn own_unit(model: &Model, coordinate: usize) -> Option<&Quantity> {
    let coordinate = &model.coordinates[coordinate];
    (coordinate.block == Block::Free).then_some(&coordinate.quantity)
}

fn is_length(model: &Model, coordinate: usize) -> bool {
    model.coordinates[coordinate].quantity.dimension == Dimension::LENGTH
}

/// To six digits, as short as that goes.
pub fn rounded(value: f64) -> String {
    let short = format!("{value:.5e}").parse().unwrap_or(value);
    // what a reader counts the zeros of is written with a power of ten
    if short == 0.0 || (1e-4..1e7).contains(&short.abs()) { format!("{short}") } else { format!("{short:e}") }
}
