//! The unit of mass: what all masses have as a factor.
//!
//! With M = μM′, the system M q̈ + Φ_qᵀλ = Q is M′q̈ + Φ_qᵀ(λ/μ) = Q/μ: in a
//! mechanism of equal parts most masses become 1, and products by them vanish.
//! Nothing is lost where μ is 0: a mechanism that can move has no accelerations
//! then anyway.
//!
//! Pivots are then numbers more often. With μ = 0 the motion is that of the limit instead of an error.
//!
//! The matrix may ask for another unit. Masses beyond 10^±60 are measured in a unit near them, so that their
//! products stay doubles.

use std::collections::BTreeMap;

use super::matrix::{Kkt, Unknown};
use crate::arena::{Arena, Expr, Node, Stage};

/// μ: what the masses share, times the unit that the matrix asks for.
pub(super) fn of_masses(arena: &mut Arena, matrix: &Kkt) -> Expr {
    let shared = shared(arena, matrix);
    match matrix.mass_unit() {
        Some(unit) => arena.scale(shared, unit),
        None => shared,
    }
}

/// 1 where the masses share nothing, or all motion is prescribed.
fn shared(arena: &mut Arena, matrix: &Kkt) -> Expr {
    let (coordinates, rows): (Vec<_>, Vec<_>) =
        matrix.unknowns().partition(|unknown| matches!(unknown, Unknown::Coordinate(_)));
    if coordinates.len() <= rows.len() {
        return arena.one();
    }
    let mut shared: Option<BTreeMap<Expr, i32>> = None;
    for mass in coordinates.into_iter().filter_map(|unknown| matrix.get(unknown, unknown)) {
        let factors = symbols(arena, mass);
        shared = Some(match shared {
            None => factors,
            Some(known) => known
                .into_iter()
                .filter_map(|(factor, exponent)| Some((factor, exponent.min(*factors.get(&factor)?))))
                .collect(),
        });
    }
    let factors: Vec<_> = shared.into_iter().flatten().collect();
    arena.product(&factors)
}

/// The parameters that a mass is a product of, with positive exponents.
fn symbols(arena: &Arena, mass: Expr) -> BTreeMap<Expr, i32> {
    let factors = match arena.node(mass) {
        Node::Product(factors) => factors.clone(),
        Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
            return symbols(arena, terms[0].0);
        }
        _ => vec![(mass, 1)],
    };
    let is_parameter = |factor: Expr| {
        matches!(arena.node(factor), Node::Symbol(_)) && arena.stage(factor) == Stage::Parameter
    };
    factors.into_iter().filter(|&(factor, exponent)| exponent > 0 && is_parameter(factor)).collect()
}
