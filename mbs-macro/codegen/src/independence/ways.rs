//! Positions that a mechanism reaches from its start.
//!
//! One way leads on in the direction in which it began, with time where the mechanism is driven. On each other way one
//! coordinate moves as far as the constraints let it, and the coordinates that are independent of it stay. `between` gives a
//! position in the middle of two.

use super::assembly::{Assembly, Closing, Position};
use super::echelon::free_columns;
use super::manifold::{SAME, STRIDE, interval, stride};
use super::samples::Generator;
use crate::model::Model;

/// Positions of a way: at 0.3 rad each, somewhat more than a turn.
const POSITIONS: usize = 24;

/// Ways along which one coordinate moves, for mechanisms of many degrees of freedom.
const MOST: usize = 8;

/// The share of other directions on a way.
const SWERVE: f64 = 0.3;

/// Ways from a start where all constraints are met.
pub fn ways(model: &Model, assembly: &Assembly<'_>, start: &Position) -> Vec<Vec<Position>> {
    let mut ways = vec![onward(assembly, start)];
    let independent = independent(model, assembly, start);
    for &along in independent.iter().take(MOST) {
        let forth = alone(assembly, start, &independent, along, STRIDE);
        // where it comes to an end, the rest of a turn may lie in the other direction
        if forth.len() < POSITIONS {
            ways.push(alone(assembly, start, &independent, along, -STRIDE));
        }
        ways.push(forth);
    }
    ways
}

/// A position between two others of a way, if the way leads through it.
pub fn between(assembly: &Assembly<'_>, a: &Position, b: &Position) -> Option<Position> {
    let all: Vec<usize> = (0..assembly.rows()).collect();
    let q = a.q.iter().zip(&b.q).map(|(a, b)| 0.5 * (a + b)).collect();
    let closing = assembly.close(&all, &Position { q, t: 0.5 * (a.t + b.t) });
    let apart = assembly.distance(a, b);
    let is_between = [a, b].iter().all(|end| assembly.distance(&closing.at, end) <= apart);
    (closing.is_closed && is_between).then_some(closing.at)
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
    let mut way = vec![start.clone()];
    while let Some(from) = way.last().filter(|_| way.len() < POSITIONS) {
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
