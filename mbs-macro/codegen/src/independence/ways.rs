//! Positions that a mechanism reaches from its start.
//!
//! One way leads on in the direction in which it began, with time where the mechanism is driven. Along others one coordinate
//! moves alone, as far as the constraints let it, and those that are independent of it stay.

use super::assembly::{Assembly, Closing, Position};
use super::echelon::free_columns;
use super::manifold::{SAME, STRIDE, interval, stride};
use super::samples::Generator;
use crate::model::Model;

/// Positions of a way: at 0.3 rad each, somewhat more than a turn.
const POSITIONS: usize = 24;

/// Ways along which one coordinate moves, for mechanisms of many degrees of freedom.
const MOST: usize = 8;

/// How much of other directions there is on a way.
const SWERVE: f64 = 0.3;

/// Positions on ways from a start where all constraints are met, and the start.
pub fn positions(model: &Model, assembly: &Assembly<'_>, start: &Position) -> Vec<Position> {
    let mut positions = onward(assembly, start);
    let independent = independent(model, assembly, start);
    for &along in independent.iter().take(MOST) {
        let forth = alone(assembly, start, &independent, along, STRIDE);
        // where it comes to an end, the rest of a turn may lie in the other direction
        if forth.len() < POSITIONS {
            positions.extend(alone(assembly, start, &independent, along, -STRIDE));
        }
        positions.extend(forth);
    }
    positions
}

/// A way that leads on as it began, twice as long.
fn onward(assembly: &Assembly<'_>, start: &Position) -> Vec<Position> {
    let all: Vec<usize> = (0..assembly.rows()).collect();
    let mut generator = Generator::new();
    let mut way = vec![start.clone()];
    let mut heading = vec![0.0; assembly.units.len()];
    let interval = interval(assembly, start);
    for _ in 0..2 * POSITIONS {
        let Some(from) = way.last() else { break };
        let next = stride(assembly, &all, from, from.t + interval, &mut || {
            heading.iter().map(|along| along + SWERVE * generator.symmetric()).collect()
        });
        let Some(Closing { at, .. }) = next else {
            heading.fill(0.0);
            continue;
        };
        let apart = at.q.iter().zip(&from.q).zip(&assembly.units);
        let moved: Vec<f64> = apart.map(|((next, from), unit)| (next - from) / unit).collect();
        let size = moved.iter().fold(0.0_f64, |size, moved| size.max(moved.abs()));
        heading = moved.iter().map(|moved| if size > SAME { moved / size } else { 0.0 }).collect();
        way.push(at);
    }
    way
}

/// Coordinates that can be held at the start without a change of the others, angles before lengths.
fn independent(model: &Model, assembly: &Assembly<'_>, start: &Position) -> Vec<usize> {
    let (angles, lengths): (Vec<usize>, Vec<usize>) =
        (0..assembly.units.len()).partition(|&at| model.coordinates[at].is_angle());
    free_columns(&assembly.jacobian(start).0, &[angles, lengths].concat())
}

/// A way along which one of the independent coordinates moves by strides, and the others stay.
fn alone(
    assembly: &Assembly<'_>,
    start: &Position,
    independent: &[usize],
    along: usize,
    stride: f64,
) -> Vec<Position> {
    let all: Vec<usize> = (0..assembly.rows()).collect();
    let mut way: Vec<Position> = Vec::new();
    while way.len() < POSITIONS {
        let from = way.last().unwrap_or(start);
        let mut guess = from.clone();
        guess.q[along] += stride * assembly.units[along];
        let closing = assembly.close_with(&all, &guess, independent);
        // not on another branch
        if !closing.is_closed || assembly.distance(&closing.at, from) > 4.0 * STRIDE {
            break;
        }
        way.push(closing.at);
    }
    way
}
