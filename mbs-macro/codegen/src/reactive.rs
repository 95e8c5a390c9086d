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

use std::collections::{BTreeMap, HashMap};

use mbs_symbolic::{Expr, Factorization, Function, Node, Number, Symbol, Unknown};

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
    /// What a jam adds to the growth of the solution; 0 without such loads.
    pub growth: Expr,
}

/// A load that changes its own reactions by its size or more, everywhere: by
/// its position.
#[derive(Debug)]
pub struct Circular(pub usize);

/// Solves for the loads that depend on multipliers.
///
/// # Errors
/// A load that nothing determines.
pub fn forces(
    model: &mut Model,
    equations: &Equations,
    factorization: &Factorization,
) -> Result<Forces, Circular> {
    let mut values = equations.forces.clone();
    if model.reactive_loads.is_empty() {
        return Ok(Forces { values, growth: model.arena.zero() });
    }
    let without = reactions_without(model, equations, factorization);
    let responses: Vec<_> =
        (0..model.reactive_loads.len()).map(|at| response(model, factorization, at)).collect();
    let mut system = System { model, without, responses };
    let mut solution = vec![system.model.arena.zero(); system.responses.len()];
    let mut least = system.model.arena.one();
    for _ in 0..system.steps() {
        solution = system.step(&solution, &mut least)?;
    }
    let solved = system.is_solved(&solution);
    let positive = model.arena.call2(Function::Max, least, model.arena.zero());
    let positive = model.arena.mul(positive, solved);
    let growth = model.arena.powi(positive, -1);
    for (at, force) in solution.into_iter().enumerate() {
        for (coordinate, slope) in model.reactive_loads[at].work.along.clone() {
            let value = model.arena.mul(force, slope);
            values[coordinate] = model.arena.add(values[coordinate], value);
        }
    }
    Ok(Forces { values, growth })
}

/// Every multiplier that a load depends on, with its value.
type Multipliers = BTreeMap<Symbol, Expr>;

struct System<'m> {
    model: &'m mut Model,
    /// λ₀
    without: Multipliers,
    /// G Dᵢ
    responses: Vec<Multipliers>,
}

impl System<'_> {
    /// As many steps as the loads can need.
    fn steps(&mut self) -> usize {
        let ([load], [response]) = (self.model.reactive_loads.as_slice(), self.responses.as_slice()) else {
            return STEPS;
        };
        let force = load.work.force;
        let arena = &mut self.model.arena;
        let direction = response.iter().map(|(&s, &e)| (s, e)).collect();
        let slope = arena.derivative(force, &direction);
        let curvature = arena.derivative(slope, &direction);
        if !arena.is_zero(curvature) {
            return STEPS;
        }
        let has_kink = |node: &Expr| {
            let is_kinked = match arena.node(*node) {
                Node::Call(function, _) | Node::Call2(function, ..) => function.row().is_piecewise,
                _ => false,
            };
            is_kinked && arena.symbols_in(*node).iter().any(|symbol| response.contains_key(symbol))
        };
        let kinks = arena.reachable(&[force]).iter().filter(|node| has_kink(node)).count();
        STEPS.min(1 + kinks)
    }

    /// One step of Newton's method for r(f) = f − f(λ₀ + G f) = 0; `least` is
    /// the smallest pivot so far.
    fn step(&mut self, at: &[Expr], least: &mut Expr) -> Result<Vec<Expr>, Circular> {
        let count = at.len();
        let multipliers = self.multipliers(at);
        let mut rows = Vec::new();
        for row in 0..count {
            let load = self.model.reactive_loads[row].work.force;
            let arena = &mut self.model.arena;
            // (1 − f′ G) f⁺ = f(λ) − f′ G f, with λ and f of before the step
            let mut right = vec![(arena.substitute(load, &multipliers), Number::ONE)];
            let mut entries = Vec::new();
            for (column, (response, &force)) in self.responses.iter().zip(at).enumerate() {
                let direction = response.iter().map(|(&s, &e)| (s, e)).collect();
                let slope = arena.derivative(load, &direction);
                let slope = arena.substitute(slope, &multipliers);
                let slope = arena.share(slope);
                right.push((arena.mul(slope, force), Number::MINUS_ONE));
                let identity = if row == column { arena.one() } else { arena.zero() };
                entries.push(arena.sub(identity, slope));
            }
            entries.push(arena.sum(&right));
            rows.push(entries);
        }
        self.eliminate(rows, least)
    }

    /// 1 if every load is what its law says of the reactions that it leaves, else 0.
    fn is_solved(&mut self, solution: &[Expr]) -> Expr {
        let multipliers = self.multipliers(solution);
        let mut solved = self.model.arena.one();
        for (row, &force) in solution.iter().enumerate() {
            let law = self.model.reactive_loads[row].work.force;
            let arena = &mut self.model.arena;
            let lawful = arena.substitute(law, &multipliers);
            let rest = arena.sub(force, lawful);
            if arena.is_zero(rest) {
                continue;
            }
            // |fᵢ| + Σ |f′ Gⱼ fⱼ|: at a reaction that vanishes the terms that cancel
            let mut terms = vec![(arena.call(Function::Abs, force), Number::ONE)];
            terms.push((arena.call(Function::Abs, lawful), Number::ONE));
            for (response, &other) in self.responses.iter().zip(solution) {
                let direction = response.iter().map(|(&s, &e)| (s, e)).collect();
                let slope = arena.derivative(law, &direction);
                let slope = arena.substitute(slope, &multipliers);
                let change = arena.mul(slope, other);
                terms.push((arena.call(Function::Abs, change), Number::ONE));
            }
            let size = arena.sum(&terms);
            let tolerance = arena.number(Number::ratio(TOLERANCE.0, TOLERANCE.1));
            let allowed = arena.mul(tolerance, size);
            let rest = arena.call(Function::Abs, rest);
            let is_off = arena.call2(Function::Greater, rest, allowed);
            let one = arena.one();
            let is_met = arena.sub(one, is_off);
            solved = arena.mul(solved, is_met);
        }
        solved
    }

    /// λ₀ + Σ Gⱼ fⱼ
    fn multipliers(&mut self, at: &[Expr]) -> HashMap<Symbol, Expr> {
        let arena = &mut self.model.arena;
        let mut multipliers = HashMap::new();
        for (&symbol, &without) in &self.without {
            let mut terms = vec![(without, Number::ONE)];
            for (response, &force) in self.responses.iter().zip(at) {
                terms.push((arena.mul(response[&symbol], force), Number::ONE));
            }
            let value = arena.sum(&terms);
            multipliers.insert(symbol, arena.share(value));
        }
        multipliers
    }

    /// Gauss–Jordan on rows with their right sides, in the order in which they
    /// stand: diagonally dominant rows need no other.
    fn eliminate(&mut self, mut rows: Vec<Vec<Expr>>, least: &mut Expr) -> Result<Vec<Expr>, Circular> {
        let count = rows.len();
        let arena = &mut self.model.arena;
        for at in 0..count {
            let pivot = arena.share(rows[at][at]);
            if arena.as_number(pivot).is_some_and(|pivot| pivot.is_zero() || pivot.is_negative()) {
                return Err(Circular(at));
            }
            *least = arena.call2(Function::Min, *least, pivot);
            let inverse = arena.powi(pivot, -1);
            let inverse = arena.share(inverse);
            for entry in &mut rows[at][at..] {
                let scaled = arena.mul(*entry, inverse);
                *entry = arena.share(scaled);
            }
            let scaled = rows[at].clone();
            for row in rows.iter_mut().enumerate().filter(|(other, _)| *other != at).map(|(_, row)| row) {
                let factor = row[at];
                for (entry, &scaled) in row.iter_mut().zip(&scaled).skip(at) {
                    let product = arena.mul(factor, scaled);
                    let updated = arena.sub(*entry, product);
                    *entry = arena.share(updated);
                }
            }
        }
        Ok(rows.iter().map(|row| row[count]).collect())
    }
}

/// λ₀: the multipliers without the loads that depend on them.
fn reactions_without(model: &mut Model, equations: &Equations, factorization: &Factorization) -> Multipliers {
    let forces = equations.forces.iter().enumerate();
    let mut rhs: BTreeMap<Unknown, Expr> = forces.map(|(at, &f)| (Unknown::Coordinate(at), f)).collect();
    rhs.extend(equations.gamma.iter().enumerate().map(|(at, &gamma)| (Unknown::Row(at), gamma)));
    multipliers_for(model, factorization, &rhs)
}

/// G Dᵢ: the multipliers for the load i alone, of size 1.
fn response(model: &mut Model, factorization: &Factorization, load: usize) -> Multipliers {
    let along = model.reactive_loads[load].work.along.iter();
    let rhs = along.map(|&(at, slope)| (Unknown::Coordinate(at), slope)).collect();
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
