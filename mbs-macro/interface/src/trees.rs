//! Conditions of order, from all rooted trees.

extern crate std;

use std::vec;
use std::vec::Vec;

use crate::{Row, Tableau};

/// A rooted tree: the places of the subtrees at its root in the list of all trees.
pub struct Tree {
    pub order: u32,
    subtrees: Vec<usize>,
    pub density: f64,
}

/// All rooted trees with at most so many nodes, the smaller ones first.
pub fn trees(most: u32) -> Vec<Tree> {
    let mut all = vec![Tree { order: 1, subtrees: vec![], density: 1.0 }];
    for order in 2..=most {
        let mut forests = vec![];
        grow(&all, order - 1, 0, &mut vec![], &mut forests);
        let tree = |subtrees: Vec<usize>| {
            let product: f64 = subtrees.iter().map(|&at| all[at].density).product();
            Tree { order, subtrees, density: f64::from(order) * product }
        };
        let new: Vec<Tree> = forests.into_iter().map(tree).collect();
        all.extend(new);
    }
    all
}

/// All ways to spend so many nodes on trees, from the tree `first` on.
fn grow(all: &[Tree], nodes: u32, first: usize, forest: &mut Vec<usize>, found: &mut Vec<Vec<usize>>) {
    if nodes == 0 {
        found.push(forest.clone());
    }
    for at in (first..all.len()).filter(|&at| all[at].order <= nodes) {
        forest.push(at);
        grow(all, nodes - all[at].order, at, forest, found);
        forest.pop();
    }
}

/// The rows of all slopes but the first: those of the stages, and of the end of the step.
pub fn rows(scheme: &Tableau) -> Vec<Row> {
    scheme.stages.iter().chain([&scheme.update]).copied().collect()
}

/// The weight of a slope in a row.
pub fn weight(row: &Row, at: usize) -> f64 {
    row.weights.get(at).map_or(0.0, |weight| row.share * weight)
}

/// The elementary weights of all trees at every slope, the first one at the start and the others where
/// their rows lead, with coefficients as they are or their magnitudes.
fn elementary(rows: &[Row], trees: &[Tree], coefficient: fn(f64) -> f64) -> Vec<Vec<f64>> {
    let a = |i: usize, j: usize| i.checked_sub(1).map_or(0.0, |row| coefficient(weight(&rows[row], j)));
    let mut weights: Vec<Vec<f64>> = vec![];
    for tree in trees {
        let through = |i: usize, subtree: usize| {
            let below: &Vec<f64> = &weights[subtree];
            (0..rows.len()).map(|j| a(i, j) * below[j]).sum::<f64>()
        };
        let of = |i: usize| tree.subtrees.iter().map(|&subtree| through(i, subtree)).product();
        weights.push((0..=rows.len()).map(of).collect());
    }
    weights
}

/// Up to which order Σ wᵢ Φᵢ(τ) is `expected` for every tree τ, of a row w: to the rounding of its
/// terms, and of weights that are known to so many roundings.
pub fn order(rows: &[Row], row: &Row, roundings: f64, expected: impl Fn(&Tree) -> f64) -> u32 {
    let trees = trees(9);
    let [signed, sizes] = [|x| x, f64::abs].map(|of: fn(f64) -> f64| elementary(rows, &trees, of));
    let sum = |values: &[f64], of: fn(f64) -> f64| -> f64 {
        values.iter().enumerate().map(|(i, value)| of(weight(row, i)) * value).sum()
    };
    let is_met = |(at, tree): (usize, &Tree)| {
        let rounding = roundings * f64::EPSILON * sum(&sizes[at], f64::abs);
        (sum(&signed[at], |x| x) - expected(tree)).abs() <= rounding
    };
    let broken = trees.iter().enumerate().find(|&condition| !is_met(condition));
    broken.map_or(9, |(_, tree)| tree.order - 1)
}
