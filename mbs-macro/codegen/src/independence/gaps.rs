//! Springs whose places coincide where the motion starts.

use mbs_symbolic::units::Dimension;

use super::Samples;
use super::assembly::Assembly;
use super::rows::Rows;
use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::model::{Meaning, Model};

/// Places that are closer than this share of the free length coincide.
const COINCIDENT: f64 = 1e-9;
/// Places also coincide within this share of the largest position, because positions are rounded.
const ROUNDED: f64 = 1e-13;

/// A spring with a free length has a direction at the start.
pub fn check_gaps(
    model: &Model,
    equations: &Equations,
    samples: &Samples,
    rows: &Rows,
    errors: &mut Diagnostics,
) {
    if model.gaps.is_empty() {
        return;
    }
    let assembly = Assembly::new(model, equations);
    let closing = assembly.close(&rows.basis, &samples.start_position(model));
    // what does not close has an error of its own
    if !closing.is_closed {
        return;
    }
    let values = model.values(|meaning| match meaning {
        Meaning::Time => closing.at.t,
        Meaning::Coordinate(at) => closing.at.q[at],
        _ => f64::NAN,
    });
    let is_length = |at: &usize| model.coordinates[*at].quantity.dimension == Dimension::LENGTH;
    let positions = (0..model.coordinates.len()).filter(is_length).map(|at| closing.at.q[at].abs());
    let largest = positions.fold(0.0, f64::max);
    for gap in &model.gaps {
        let found = model.arena.evaluate(&[gap.distance, gap.free], &values);
        if found[0] <= COINCIDENT * found[1].abs() + ROUNDED * largest {
            let name = &gap.name;
            let message =
                format!("the places of `{name}` coincide at the start, so that it has no direction");
            let error = Diagnostic::new(name.span(), message).help(
                "declare a start where they are apart; a spring without a free length, `length = 0`, has no such position",
            );
            errors.push(error);
        }
    }
}
