//! Rows that are left out because they repeat others, and sets of rows of which one is spare in every position.
//!
//! Rows repeat each other where Φ_q has a left null vector, Φ_qᵀ n = 0. A row may be left out while its entry of n is not 0.
//! Entries change with the position, and one that vanishes ends a motion: the other rows depend on each other there. So a
//! set of rows is looked for whose entries never vanish together. The elimination takes all rows of a set, and finds the
//! spare one among them (`eliminate/deflation.rs` in mbs-symbolic).
//!
//! # How it works
//!
//! `ways` leads along ways from the start. At each position an orthonormal basis of the null vectors is computed. A row, or a
//! set, takes one dimension of it away: the null vectors that are 0 on its rows are left. The first one that is taken is
//! eliminated last.
//!
//! # Limits
//!
//! A mechanism of several degrees of freedom has positions that no way leads to. A set has four rows at most, those of two
//! pins.

use super::assembly::{Assembly, Position};
use super::echelon::null_vectors;
use super::manifold::Manifold;
use super::rows::Rows;
use super::sparse::SparseRow;
use super::ways::{between, ways};
use crate::model::Model;

/// Entries of null vectors stay away from 0 if they never fall below this share of their largest size.
const STEADY: f64 = 0.3;

/// A set is worth its operations if its entries stay so many times larger than that of a row alone.
const WORTH: f64 = 2.0;

/// The most rows of a set: minors of three rows are cheap, and keep their digits.
const LARGEST: usize = 4;

/// Null vectors turn by less than this from one position to the next. An entry that passes 0 is seen below half of it.
const LARGEST_TURN: f64 = 0.1;

/// Steps of a way are halved so often at most.
const MOST_HALVINGS: u32 = 8;

/// The square of an entry that rounding left of 0 is below this.
const NONE: f64 = 1e-12;

/// An orthonormal basis of the left null vectors of Φ_q at a position.
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

/// Bases of so many null vectors along a way. Where they turn fast, positions between those of the way are added.
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

/// The entries of a null vector on the rows of every set, of size 1; `None` if more or fewer rows are spare at the position.
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

/// A set of which one row is spare: the rows of a joint, and those of others as long as the set becomes steadier. It begins
/// with a redundant row if it can. A spare link is often light, and a set of its own two rows keeps all digits.
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

/// The size of the entries of null vectors on some rows, over all positions.
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

/// True if one of these rows is spare and not two: the entries of all null vectors are parallel on them.
fn is_one(basis: &Basis, rows: &[usize]) -> bool {
    let dot = |a: usize, b: usize| basis.iter().map(|n| n[a] * n[b]).sum::<f64>();
    rows.iter().all(|&a| rows.iter().all(|&b| dot(a, a) * dot(b, b) - dot(a, b).powi(2) < NONE))
}

/// The row on which the null vectors are largest.
fn largest(basis: &Basis, rows: &[usize]) -> Option<usize> {
    let square = |row: usize| basis.iter().map(|n| n[row].powi(2)).sum::<f64>();
    rows.iter().copied().max_by(|&a, &b| square(a).total_cmp(&square(b)))
}

/// Keeps the null vectors that are 0 on these rows, of which one is spare.
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
