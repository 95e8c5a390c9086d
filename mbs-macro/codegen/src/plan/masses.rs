//! The entries of M, and the coordinates whose mass is positive by declaration.

use std::collections::BTreeSet;

use mbs_symbolic::{Expr, Stage};

use crate::derive::Equations;
use crate::model::Model;

/// A pivot of this share of the diagonal entry that it was, or less, is not taken for positive.
const SMALLEST_PIVOT: f64 = 1e-8;

/// More coordinates than these that are coupled with each other are not asked whether their masses are definite.
const MOST_COUPLED: usize = 128;

/// The entries of M that need not be 0: the diagonal, and behind it the others, each once.
pub fn places(equations: &Equations) -> Vec<(usize, usize)> {
    (0..equations.mass.len()).map(|at| (at, at)).chain(equations.couplings.keys().copied()).collect()
}

/// Their values.
pub fn entries(equations: &Equations) -> Vec<Expr> {
    equations.mass.iter().chain(equations.couplings.values()).copied().collect()
}

/// p = M v, 0 of own states, which have no momentum.
pub fn momentum(model: &mut Model, equations: &Equations) -> Vec<Expr> {
    let mut momentum = vec![model.arena.zero(); model.coordinates.len()];
    for ((i, j), entry) in places(equations).into_iter().zip(entries(equations)) {
        if model.coordinates[i].is_own() {
            continue;
        }
        let mut add = |to: usize, of: usize| {
            let velocity = model.arena.variable(model.coordinates[of].velocity);
            let product = model.arena.mul(entry, velocity);
            momentum[to] = model.arena.add(momentum[to], product);
        };
        add(i, j);
        if i != j {
            add(j, i);
        }
    }
    momentum
}

/// Coordinates over which M is positive definite in every position.
///
/// A body has a mass of its own along its coordinates, and what particles add is never negative. So M is
/// definite over these. It is so over the others beside them whose entries among each other depend on
/// parameters alone, if that part of M is definite, which the declared parameters decide.
pub fn positive(model: &Model, equations: &Equations) -> BTreeSet<usize> {
    let arena = &model.arena;
    let of_bodies = model.inertias.iter().enumerate().filter(|(_, inertia)| !arena.is_zero(inertia.mass));
    let mut positive: BTreeSet<usize> = of_bodies.map(|(at, _)| at).collect();
    let is_known = |entry: &Expr| arena.stage(*entry) <= Stage::Parameter;
    let others = (0..equations.mass.len()).filter(|at| !positive.contains(at));
    let mut known: BTreeSet<usize> =
        others.filter(|&at| !arena.is_zero(equations.mass[at]) && is_known(&equations.mass[at])).collect();
    let others =
        equations.couplings.iter().filter(|((i, j), _)| !positive.contains(i) && !positive.contains(j));
    for (&(i, j), entry) in others {
        if !is_known(entry) {
            known.remove(&i);
            known.remove(&j);
        }
    }
    while let Some(part) = coupled(equations, &mut known) {
        if part.len() <= MOST_COUPLED && is_definite(model, equations, &part) {
            positive.extend(part);
        }
    }
    positive
}

/// Takes coordinates out that entries of M couple with each other, directly or by others; `None` if none are left.
fn coupled(equations: &Equations, left: &mut BTreeSet<usize>) -> Option<Vec<usize>> {
    let mut part = vec![left.pop_first()?];
    let mut seen = 0;
    while let Some(&at) = part.get(seen) {
        seen += 1;
        let others = left.iter().copied();
        let is_coupled = |other: &usize| equations.couplings.contains_key(&(at.min(*other), at.max(*other)));
        let found: Vec<usize> = others.filter(is_coupled).collect();
        found.iter().for_each(|other| {
            left.remove(other);
        });
        part.extend(found);
    }
    Some(part)
}

/// True if M is positive definite over these coordinates at the declared parameters, by elimination.
fn is_definite(model: &Model, equations: &Equations, coordinates: &[usize]) -> bool {
    let entry = |i: usize, j: usize| match i == j {
        true => equations.mass[i],
        false => equations.couplings.get(&(i.min(j), i.max(j))).copied().unwrap_or(model.arena.zero()),
    };
    let n = coordinates.len();
    let pairs = coordinates.iter().flat_map(|&i| coordinates.iter().map(move |&j| entry(i, j)));
    let mut matrix = model.arena.evaluate(&pairs.collect::<Vec<_>>(), &model.values(|_| f64::NAN));
    let diagonal: Vec<f64> = (0..n).map(|at| matrix[at * n + at]).collect();
    for at in 0..n {
        let pivot = matrix[at * n + at];
        // NaN is no mass
        if !(pivot > SMALLEST_PIVOT * diagonal[at] && pivot.is_finite()) {
            return false;
        }
        for row in at + 1..n {
            let factor = matrix[row * n + at] / pivot;
            for column in at..n {
                matrix[row * n + column] -= factor * matrix[at * n + column];
            }
        }
    }
    true
}
