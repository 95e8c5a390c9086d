//! Rows that are left out because they repeat others, and sets of rows of which one is spare in every position.
//!
//! Rows repeat each other where Σ nᵣ Φ_q,ᵣ = 0. A row may be left out if its nᵣ is not 0. Where n changes with the
//! position, that of a row may vanish: the others then depend on each other, and a motion would end there. So a set of
//! rows is looked for whose parts of n never vanish together. The elimination takes all rows of a set and finds
//! what is spare among them (`eliminate/deflation.rs` in mbs-symbolic).
//!
//! # How it works
//!
//! Along ways from the start (`ways`) all n are computed, an orthonormal basis of them at each position. A row or a set takes
//! one dimension away: what is left are the n that are 0 on it. The one that is taken first is eliminated last.
//!
//! # Limits
//!
//! Ways do not see all positions of a mechanism of several degrees of freedom. A set has four rows at most, those of two pins.

use super::assembly::{Assembly, Position};
use super::echelon::null_vectors;
use super::manifold::Manifold;
use super::rows::Rows;
use super::sparse::SparseRow;
use super::ways::{between, ways};
use crate::model::Model;

/// A part of n that never falls below this share of its largest value stays away from 0.
const STEADY: f64 = 0.3;

/// A set is worth its operations if its part of n stays this much larger than that of a row alone.
const WORTH: f64 = 2.0;

/// The most rows of a set: minors of three rows are cheap, and keep their digits.
const LARGEST: usize = 4;

/// From one position to the next n turns by less than this; a part of n that passes 0 is then seen below 0.05.
const LARGEST_TURN: f64 = 0.1;

/// Steps of a way are halved so often at most.
const MOST_HALVINGS: u32 = 8;

/// Squares of parts below this are what rounding left of 0.
const NONE: f64 = 1e-12;

/// An orthonormal basis of all n at a position.
type Basis = Vec<Vec<f64>>;

/// Finds the rows that are left out, and the sets.
pub fn find(model: &Model, assembly: &Assembly<'_>, manifold: &Manifold, rows: &mut Rows) {
    let count = rows.redundant.len();
    let mut bases = Vec::new();
    for way in ways(model, assembly, manifold.start()) {
        along(assembly, way, count, &mut bases);
    }
    let mut sources: Vec<Vec<usize>> = Vec::new();
    for row in 0..assembly.rows() {
        let is_of = |set: &&mut Vec<usize>| model.constraints[set[0]].source == model.constraints[row].source;
        match sources.iter_mut().find(is_of) {
            Some(set) => set.push(row),
            None => sources.push(vec![row]),
        }
    }
    let mut single = rows.redundant.clone();
    let (mut left_out, mut sets) = (Vec::new(), Vec::new());
    for dimension in (1..=count).rev() {
        if single.is_empty() {
            single = sources.concat();
        }
        let alone = single.iter().map(|&row| (row, part(&bases, &[row])));
        let steadiest = alone.max_by(|a, b| a.1.steadiness().total_cmp(&b.1.steadiness()));
        let Some((row, of_row)) = steadiest else { break };
        let set = if of_row.is_steady() { None } else { best_set(&bases, &sources, &single) };
        let taken = match set.filter(|set| part(&bases, set).least > WORTH * of_row.least) {
            Some(set) => set,
            None => vec![row],
        };
        match taken[..] {
            [row] => left_out.push(row),
            _ => sets.push(taken.clone()),
        }
        single.retain(|row| !taken.contains(row));
        sources.iter_mut().for_each(|source| source.retain(|row| !taken.contains(row)));
        sources.retain(|source| !source.is_empty());
        bases.iter_mut().for_each(|basis| restrict(basis, &taken));
        bases.retain(|basis| basis.len() == dimension - 1);
    }
    sets.reverse();
    left_out.sort_unstable();
    (rows.left_out, rows.sets) = (left_out, sets);
}

/// The bases of all n along a way, of so many dimensions, with more positions where they turn fast.
fn along(assembly: &Assembly<'_>, way: Vec<Position>, count: usize, bases: &mut Vec<Basis>) {
    let basis_at = |at: &Position| {
        Some(orthonormal(null_vectors(assembly.jacobian(at).0), assembly.rows()))
            .filter(|basis| basis.len() == count)
    };
    let mut left: Vec<(Position, u32)> = way.into_iter().rev().map(|at| (at, 0)).collect();
    let mut last: Option<(Position, Basis)> = None;
    while let Some((next, halvings)) = left.pop() {
        let Some(basis) = basis_at(&next) else { continue };
        if let Some((at, before)) = &last
            && halvings < MOST_HALVINGS
            && turn(before, &basis) > LARGEST_TURN
            && let Some(middle) = between(assembly, at, &next)
        {
            left.push((next, halvings + 1));
            left.push((middle, halvings + 1));
            continue;
        }
        bases.push(basis.clone());
        last = Some((next, basis));
    }
}

/// The sine of the angle by which a space is turned out of another one.
fn turn(before: &Basis, after: &Basis) -> f64 {
    let rest = |n: &Vec<f64>| {
        let mut rest = n.clone();
        for other in before {
            let along: f64 = other.iter().zip(n).map(|(a, b)| a * b).sum();
            rest.iter_mut().zip(other).for_each(|(rest, other)| *rest -= along * other);
        }
        rest.iter().map(|x| x * x).sum::<f64>()
    };
    after.iter().map(rest).fold(0.0, f64::max).sqrt()
}

/// Of every set the direction, over its rows, in which it says nothing at a position; `None` if more or fewer rows are
/// spare there.
pub fn spare(jacobian: &[SparseRow<f64>], rows: &Rows) -> Option<Vec<Vec<f64>>> {
    let taken: Vec<usize> = rows.eliminated().collect();
    let vectors = null_vectors(taken.iter().map(|&row| jacobian[row].clone()).collect());
    let of_all = vectors.into_iter().map(|vector| vector.into_iter().map(|(at, n)| (taken[at], n)).collect());
    let mut basis = orthonormal(of_all.collect(), rows.count);
    if basis.len() != rows.sets.len() {
        return None;
    }
    let mut directions = Vec::new();
    for set in rows.sets.iter().rev() {
        let row = largest(&basis, set)?;
        let along = set.iter().map(|&other| basis.iter().map(|n| n[other] * n[row]).sum::<f64>());
        let along: Vec<f64> = along.collect();
        let size = along.iter().map(|x| x * x).sum::<f64>().sqrt();
        directions.push(along.into_iter().map(|x| x / size).collect());
        restrict(&mut basis, set);
    }
    directions.reverse();
    Some(directions)
}

/// A set of which one row is spare: the rows of a joint, and of more joints as long as its part of n becomes steadier. It begins
/// with a redundant row if it can: what is spare is often a light link, which answers alone best.
fn best_set(bases: &[Basis], sources: &[Vec<usize>], redundant: &[usize]) -> Option<Vec<usize>> {
    let is_of = |source: &&Vec<usize>| source.iter().any(|row| redundant.contains(row));
    let grown = |set: &Vec<usize>| grown(bases, sources, set.clone());
    let of_redundant = steadiest(bases, &mut sources.iter().filter(is_of).filter_map(grown));
    let found = match of_redundant.filter(|(part, _)| part.is_steady()) {
        Some(found) => Some(found),
        None => steadiest(bases, &mut sources.iter().cloned())
            .and_then(|(_, set)| grown(&set))
            .map(|set| (part(bases, &set), set)),
    };
    found.map(|(_, set)| set)
}

/// The steadiest of sets of which one row is spare.
fn steadiest(
    bases: &[Basis],
    candidates: &mut dyn Iterator<Item = Vec<usize>>,
) -> Option<(Part, Vec<usize>)> {
    let is_one_spare =
        |set: &Vec<usize>| set.len() <= LARGEST && bases.iter().all(|basis| is_one(basis, set));
    let rated = candidates.filter(is_one_spare).map(|set| (part(bases, &set), set));
    rated.max_by(|a, b| a.0.steadiness().total_cmp(&b.0.steadiness()))
}

/// A set with the rows of more joints, as long as it becomes steadier.
fn grown(bases: &[Basis], sources: &[Vec<usize>], set: Vec<usize>) -> Option<Vec<usize>> {
    let (mut of_set, mut set) = steadiest(bases, &mut std::iter::once(set))?;
    while !of_set.is_steady() {
        let more = sources.iter().filter(|more| !set.contains(&more[0]));
        let more = steadiest(bases, &mut more.map(|more| [set.as_slice(), more].concat()));
        match more.filter(|(of_more, _)| of_more.steadiness() > of_set.steadiness()) {
            Some(more) => (of_set, set) = more,
            None => break,
        }
    }
    set.sort_unstable();
    Some(set)
}

/// The size of the part of n on some rows, over all positions.
#[derive(Clone, Copy)]
struct Part {
    least: f64,
    most: f64,
}

impl Part {
    fn steadiness(self) -> f64 {
        if self.most > NONE.sqrt() { self.least / self.most } else { 0.0 }
    }

    fn is_steady(self) -> bool {
        self.steadiness() >= STEADY
    }
}

fn part(bases: &[Basis], rows: &[usize]) -> Part {
    let square =
        |basis: &Basis| basis.iter().flat_map(|n| rows.iter().map(|&row| n[row].powi(2))).sum::<f64>();
    bases.iter().map(|basis| square(basis).sqrt()).fold(
        Part { least: f64::INFINITY, most: 0.0 },
        |part, size| Part { least: part.least.min(size), most: part.most.max(size) },
    )
}

/// True if all n have parallel parts on these rows, so that one of them is spare and not two.
fn is_one(basis: &Basis, rows: &[usize]) -> bool {
    let dot = |a: usize, b: usize| basis.iter().map(|n| n[a] * n[b]).sum::<f64>();
    rows.iter().all(|&a| rows.iter().all(|&b| dot(a, a) * dot(b, b) - dot(a, b).powi(2) < NONE))
}

/// The row on which the n are largest.
fn largest(basis: &Basis, rows: &[usize]) -> Option<usize> {
    let square = |row: usize| basis.iter().map(|n| n[row].powi(2)).sum::<f64>();
    rows.iter().copied().max_by(|&a, &b| square(a).total_cmp(&square(b)))
}

/// Keeps the n that are 0 on these rows, on which all have parallel parts.
fn restrict(basis: &mut Basis, rows: &[usize]) {
    let Some(row) = largest(basis, rows) else { return };
    let along: Vec<f64> = basis.iter().map(|n| n[row]).collect();
    let square: f64 = along.iter().map(|x| x * x).sum();
    let without = (0..basis.len()).map(|at| {
        let mut n = basis[at].clone();
        for (other, of_other) in basis.iter().zip(&along) {
            n.iter_mut().zip(other).for_each(|(n, other)| *n -= along[at] * of_other / square * other);
        }
        n
    });
    let without: Vec<Vec<f64>> = without.collect();
    *basis = gram_schmidt(without);
}

fn orthonormal(vectors: Vec<Vec<(usize, f64)>>, count: usize) -> Basis {
    let dense = vectors.into_iter().map(|vector| {
        let mut dense = vec![0.0; count];
        vector.into_iter().for_each(|(row, factor)| dense[row] = factor);
        dense
    });
    gram_schmidt(dense.collect())
}

/// An orthonormal basis of what vectors span, the largest rest first.
fn gram_schmidt(mut vectors: Vec<Vec<f64>>) -> Basis {
    let square = |vector: &Vec<f64>| vector.iter().map(|x| x * x).sum::<f64>();
    let mut basis = Basis::new();
    while let Some(at) =
        (0..vectors.len()).max_by(|&a, &b| square(&vectors[a]).total_cmp(&square(&vectors[b])))
    {
        let mut next = vectors.swap_remove(at);
        let size = square(&next).sqrt();
        if !(size * size > NONE && size.is_finite()) {
            break;
        }
        next.iter_mut().for_each(|x| *x /= size);
        for vector in &mut vectors {
            let along: f64 = vector.iter().zip(&next).map(|(x, n)| x * n).sum();
            vector.iter_mut().zip(&next).for_each(|(x, n)| *x -= along * n);
        }
        basis.push(next);
    }
    basis
}
