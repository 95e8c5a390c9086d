//! Loads that depend on the reactions that they change, such as the friction in
//! a guide: M q̈ + Φ_qᵀ λ = Q₀ + Σ Dᵢ fᵢ(λ).
//!
//! The system is linear in the numbers fᵢ once they are known. With the
//! multipliers λ₀ without these loads and the responses G Dᵢ to each of them,
//! what is left are as many equations as there are loads,
//!
//! ```text
//! fᵢ = fᵢ(λ₀ + Σ Gⱼ fⱼ)
//! ```
//!
//! solved by a fixed number of Newton's steps from f = 0, so without a branch.
//! Let L bound how much the right-hand side changes with f (friction coefficient
//! times geometry; forces and torques in whatever units make it smallest). L < 1
//! makes the solution unique, and the matrices of the steps diagonally dominant,
//! so that they are eliminated as they stand. The steps give the solution
//!
//! * exactly, after the first one, while loads follow |λ| and turn no λ around;
//! * for a single load, which is monotone and convex or concave in f, whatever
//!   turns around: exactly, after one step per |…| and another one, so that no
//!   more are taken; or quadratically for √(λ_x² + λ_y²);
//! * for several loads that turn reactions around with an error that falls by
//!   2L/(1 − L) a step at least, if L < 1/3.
//!
//! Beyond L = 1 a real guide may jam. If a pivot is not positive, in whatever
//! step, or if the last step leaves loads that are not those of their reactions, the
//! growth becomes infinite and the integrator stops.
//!
//! The reactions are those without feedback terms. So the loads are functions
//! of the state, the same in every generated function, and second order stays
//! second order: corrections of the violation cause no friction.
//!
//! Each response G Dᵢ is one more solution with the factorization of the step.

use std::collections::BTreeMap;

use mbs_symbolic::{Algebra, Expr, Factorization, Node, Number, Pieces, Scalar, Symbol, Unknown};
use rustc_hash::FxHashMap as HashMap;

use crate::derive::Equations;
use crate::model::{Meaning, Model};

/// Newton's steps, at most.
const STEPS: usize = 4;

/// How far a load may be from what its law says, as a share of what it is made of. The
/// steps are exact or converge quadratically, so that most are right to rounding, and
/// those without a solution are off by much.
const TOLERANCE: (i64, i64) = (1, 1_000_000);

/// Q as a function of the state.
pub struct Forces {
    pub values: Vec<Expr>,
    /// The term that a jam adds to the growth of the solution; 0 without such loads.
    pub growth: Expr,
}

/// A load that changes its own reactions by its size or more, everywhere: by
/// its position.
#[derive(Debug)]
pub struct Circular(pub usize);

/// A contact that changes the reactions on which a load depends, while its impulses or forces hold: by their positions.
/// Runs find those forces by the responses of the mechanism to them, behind the loads.
#[derive(Debug)]
pub struct Unsettled {
    pub contact: usize,
    pub load: usize,
}

/// Looks for contacts that change the reactions on which loads depend.
///
/// Friction that sticks has the direction 0. So friction that follows a reaction does not change it while it sticks.
///
/// # Errors
/// The first one of them.
pub fn settle(model: &mut Model, factorization: &Factorization) -> Result<(), Unsettled> {
    let slopes: Vec<_> = model.contacts().map(|contact| contact.slopes.clone()).collect();
    let stops = model.stops.len();
    for (contact, slopes) in slopes.iter().enumerate() {
        let response = response(model, factorization, slopes);
        let direction = contact.checked_sub(stops).and_then(|at| Some(model.frictions.get(at)?.memory));
        for load in 0..model.reactive_loads.len() {
            let law = model.reactive_loads[load].work.force;
            let slope = model.arena.derivative(law, &along(&response));
            let symbols = model.arena.symbols_in(slope).into_iter();
            let is_direction = |symbol: &Symbol| matches!(model.meanings[symbol.index()], Meaning::Input(at) if Some(at) == direction);
            let at_rest = symbols.filter(is_direction).map(|symbol| (symbol, model.arena.zero())).collect();
            let slope = model.arena.substitute(slope, &at_rest);
            if !model.arena.is_zero(slope) {
                return Err(Unsettled { contact, load });
            }
        }
    }
    Ok(())
}

/// Solves for the loads that depend on multipliers, beside all `others`.
///
/// # Errors
/// A load that nothing determines.
pub fn forces(
    model: &mut Model,
    others: &[Expr],
    equations: &Equations,
    factorization: &Factorization,
) -> Result<Forces, Circular> {
    let mut values = others.to_vec();
    if model.reactive_loads.is_empty() {
        return Ok(Forces { values, growth: model.arena.zero() });
    }
    let without = reactions_without(model, others, equations, factorization);
    let slopes: Vec<_> = model.reactive_loads.iter().map(|load| load.work.along.clone()).collect();
    let responses: Vec<_> = slopes.iter().map(|slopes| response(model, factorization, slopes)).collect();
    let steps = steps(model, &responses);
    let algebra = &Algebra::new(&mut model.arena);
    let laws = model.reactive_loads.iter().map(|load| algebra.scalar(load.work.force)).collect();
    let system = System { algebra, laws, without, responses };
    let mut solution = vec![algebra.number(0); system.laws.len()];
    let mut least = algebra.number(1);
    for _ in 0..steps {
        solution = system.step(&solution, &mut least)?;
    }
    let solved = system.is_solved(&solution);
    let growth = (least.max(algebra.number(0)) * solved).powi(-1).expr();
    for (load, force) in model.reactive_loads.iter().zip(solution) {
        for &(coordinate, slope) in &load.work.along {
            let value = force * algebra.scalar(slope);
            values[coordinate] = (algebra.scalar(values[coordinate]) + value).expr();
        }
    }
    Ok(Forces { values, growth })
}

/// Every multiplier that a load depends on, with its value.
type Multipliers = BTreeMap<Symbol, Expr>;

/// As many steps as the loads can need.
fn steps(model: &mut Model, responses: &[Multipliers]) -> usize {
    let ([load], [response]) = (model.reactive_loads.as_slice(), responses) else { return STEPS };
    let (law, arena) = (load.work.force, &mut model.arena);
    let direction = along(response);
    let slope = arena.derivative(law, &direction);
    let curvature = arena.derivative(slope, &direction);
    if !arena.is_zero(curvature) {
        return STEPS;
    }
    let has_kink = |node: &Expr| {
        let is_kinked = match arena.node(*node) {
            Node::Call(function, _) => function.row().pieces != Pieces::One,
            _ => false,
        };
        is_kinked && arena.symbols_in(*node).iter().any(|symbol| response.contains_key(symbol))
    };
    let kinks = arena.reachable(&[law]).iter().filter(|node| has_kink(node)).count();
    STEPS.min(1 + kinks)
}

/// The direction in which multipliers respond.
fn along(response: &Multipliers) -> HashMap<Symbol, Expr> {
    response.iter().map(|(&symbol, &expr)| (symbol, expr)).collect()
}

struct System<'a> {
    algebra: &'a Algebra<'a>,
    /// fᵢ(λ)
    laws: Vec<Scalar<'a>>,
    /// λ₀
    without: Multipliers,
    /// G Dᵢ
    responses: Vec<Multipliers>,
}

impl<'a> System<'a> {
    /// One step of Newton's method for r(f) = f − f(λ₀ + G f) = 0; `least` is
    /// the smallest pivot so far.
    fn step(&self, at: &[Scalar<'a>], least: &mut Scalar<'a>) -> Result<Vec<Scalar<'a>>, Circular> {
        let multipliers = self.multipliers(at);
        let mut rows = Vec::new();
        for (row, law) in self.laws.iter().enumerate() {
            // (1 − f′ G) f⁺ = f(λ) − f′ G f, with λ and f of before the step
            let mut right = vec![law.substitute(&multipliers)];
            let mut entries = Vec::new();
            for (column, (response, &force)) in self.responses.iter().zip(at).enumerate() {
                let slope = law.derivative(&along(response)).substitute(&multipliers).shared();
                right.push(-(slope * force));
                entries.push(i64::from(row == column) - slope);
            }
            entries.push(self.algebra.sum(right));
            rows.push(entries);
        }
        eliminate(rows, least)
    }

    /// 1 if every load is what its law says of the reactions that it leaves, else 0.
    fn is_solved(&self, solution: &[Scalar<'a>]) -> Scalar<'a> {
        let multipliers = self.multipliers(solution);
        let mut solved = self.algebra.number(1);
        for (law, &force) in self.laws.iter().zip(solution) {
            let lawful = law.substitute(&multipliers);
            let rest = force - lawful;
            if rest.is_zero() {
                continue;
            }
            // |fᵢ| + Σ |f′ Gⱼ fⱼ|: at a reaction that vanishes the terms that cancel
            let mut terms = vec![force.abs(), lawful.abs()];
            for (response, &other) in self.responses.iter().zip(solution) {
                let slope = law.derivative(&along(response)).substitute(&multipliers);
                terms.push((slope * other).abs());
            }
            let size = self.algebra.sum(terms);
            let allowed = Number::ratio(TOLERANCE.0, TOLERANCE.1) * size;
            let is_off = rest.abs().greater(allowed);
            solved = solved * (1 - is_off);
        }
        solved
    }

    /// λ₀ + Σ Gⱼ fⱼ
    fn multipliers(&self, at: &[Scalar<'a>]) -> HashMap<Symbol, Expr> {
        let algebra = self.algebra;
        let mut multipliers = HashMap::default();
        for (&symbol, &without) in &self.without {
            let mut terms = vec![algebra.scalar(without)];
            for (response, &force) in self.responses.iter().zip(at) {
                terms.push(algebra.scalar(response[&symbol]) * force);
            }
            multipliers.insert(symbol, algebra.sum(terms).shared().expr());
        }
        multipliers
    }
}

/// Gauss–Jordan on rows with their right sides, in the order in which they
/// stand: diagonally dominant rows need no other.
fn eliminate<'a>(
    mut rows: Vec<Vec<Scalar<'a>>>,
    least: &mut Scalar<'a>,
) -> Result<Vec<Scalar<'a>>, Circular> {
    let count = rows.len();
    for at in 0..count {
        let pivot = rows[at][at].shared();
        if pivot.number().is_some_and(|pivot| pivot.is_zero() || pivot.is_negative()) {
            return Err(Circular(at));
        }
        *least = least.min(pivot);
        let inverse = pivot.powi(-1).shared();
        for entry in &mut rows[at][at..] {
            *entry = (*entry * inverse).shared();
        }
        let scaled = rows[at].clone();
        for row in rows.iter_mut().enumerate().filter(|(other, _)| *other != at).map(|(_, row)| row) {
            let factor = row[at];
            for (entry, &scaled) in row.iter_mut().zip(&scaled).skip(at) {
                *entry = (*entry - factor * scaled).shared();
            }
        }
    }
    Ok(rows.iter().map(|row| row[count]).collect())
}

/// λ₀: the multipliers without the loads that depend on them.
fn reactions_without(
    model: &mut Model,
    others: &[Expr],
    equations: &Equations,
    factorization: &Factorization,
) -> Multipliers {
    let forces = others.iter().enumerate();
    let mut rhs: BTreeMap<Unknown, Expr> = forces.map(|(at, &f)| (Unknown::Coordinate(at), f)).collect();
    rhs.extend(equations.gamma.iter().enumerate().map(|(at, &gamma)| (Unknown::Row(at), gamma)));
    multipliers_for(model, factorization, &rhs)
}

/// G D: the multipliers for a load of size 1 alone, with its slopes D.
fn response(model: &mut Model, factorization: &Factorization, slopes: &[(usize, Expr)]) -> Multipliers {
    let rhs = slopes.iter().map(|&(at, slope)| (Unknown::Coordinate(at), slope)).collect();
    multipliers_for(model, factorization, &rhs)
}

fn multipliers_for(
    model: &mut Model,
    factorization: &Factorization,
    rhs: &BTreeMap<Unknown, Expr>,
) -> Multipliers {
    let solution = factorization.solve(&mut model.arena, rhs);
    let mut multipliers = Multipliers::new();
    for load in &model.reactive_loads {
        for symbol in model.arena.symbols_in(load.work.force) {
            if let Meaning::Multiplier(row) = model.meanings[symbol.index()] {
                let value = solution.get(&Unknown::Row(row)).copied().unwrap_or(model.arena.zero());
                multipliers.insert(symbol, model.arena.share(value));
            }
        }
    }
    multipliers
}
