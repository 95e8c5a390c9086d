//! The system of an implicit stage, for stiff forces.
//!
//! In a stage of a diagonally implicit scheme positions and velocities depend on the acceleration a
//! that is sought, with s the share of the step that the stage has of its own slope:
//!
//! ```text
//! v = v₀ + s a,  q = q₀ + s v,    M a + Φ_qᵀ λ = Q(q, v),  Φ_q a = γ
//! ```
//!
//! One step of Newton's method from a predicted acceleration p, with q and v those that p leads to,
//! is the same system with other masses and forces:
//!
//! ```text
//! (M + D) a + Φ_qᵀ λ = Q + D p,  Φ_q a = γ,    D = −s ∂Q/∂v − s² ∂Q/∂q
//! ```
//!
//! Own states z have the mass 1 and no constraints. With J = −D, split into rows and columns of lines l and own
//! states o, their rates follow from the others, and are eliminated first:
//!
//! ```text
//! ż = p_o + E⁻¹ (Q_o − p_o + J_ol (a_l − p_l)),    E = 1 − J_oo
//! D_ll = −J_ll − J_lo E⁻¹ J_ol,    Q_l + D_ll p_l + J_lo E⁻¹ (Q_o − p_o) on the right
//! ```
//!
//! J_oo, J_ol and J_lo need not be symmetric, so that what drives a motor and what it induces are both there.
//!
//! M, Φ_q and γ are taken where p leads to: what they change with a is of the order of s², and
//! has no stiffness. D is made symmetric, as the elimination is; forces between two bodies have a
//! symmetric D, and of others (a follower, a force on one body by the position of another) the
//! antisymmetric part is left out of Newton's matrix. Loads that depend on reactions are taken at
//! p, too.
//!
//! # How it is used
//!
//! The elimination of the accelerations solves this system too, in the order that was cheapest there.
//! `Implicit` is a function of its own. Rust code has it where forces depend on positions or velocities. C
//! does not print it. The derivatives of the constraints are left out of the matrix, since they are not
//! stiff.

use std::collections::BTreeMap;

use mbs_symbolic::{Arena, Expr, Kkt, Number, Unknown};

use crate::derive::Equations;
use crate::inputs::{Input, Inputs};
use crate::model::Model;
use crate::reduction::Reduction;

/// The terms that an implicit stage adds to the equations of motion.
pub struct Stiffness {
    /// D over pairs of coordinates, the first one not behind the second.
    entries: BTreeMap<(usize, usize), Expr>,
    /// Q + D p, and what own states add to it.
    pub forces: Vec<Expr>,
    /// How the rates of own states follow.
    pub rates: Vec<Rate>,
}

/// The rate of an own state in an implicit stage, a function of the accelerations of lines.
pub struct Rate {
    /// Which state it is.
    pub state: usize,
    /// Its value at the accelerations that were predicted.
    pub predicted: Expr,
    /// By how much it changes with each acceleration, beside the predicted acceleration.
    pub slopes: Vec<(usize, Expr, Expr)>,
}

/// A matrix whose entries that are 0 are left out, row by row.
type Sparse = Vec<BTreeMap<usize, Expr>>;

impl Stiffness {
    /// That of a mechanism: without entries if no force depends on positions or velocities.
    pub fn new(model: &mut Model, equations: &Equations, inputs: &Inputs, reduction: &Reduction) -> Self {
        let terms = terms(model, equations, inputs);
        let predicted = reduction.predicted(model, inputs);
        let lines = model.line_count();
        let mut entries: BTreeMap<(usize, usize), Expr> = BTreeMap::new();
        for (i, row) in terms.iter().enumerate().take(lines) {
            for &(j, entry) in row.iter().filter(|(j, _)| *j < lines) {
                add_symmetric(&mut model.arena, &mut entries, (i, j), entry);
            }
        }
        let jacobian = summed(&mut model.arena, &terms);
        let own = OwnStates::new(model, &jacobian, &equations.forces, &predicted);
        let arena = &mut model.arena;
        // J_lo E⁻¹ J_ol
        for (i, row) in product(arena, &own.on_lines, &own.response).into_iter().enumerate() {
            for (j, entry) in row {
                add_symmetric(arena, &mut entries, (i, j), entry);
            }
        }
        entries.retain(|_, entry| !arena.is_zero(*entry));
        entries.values_mut().for_each(|entry| *entry = arena.share(*entry));
        let mut forces = equations.forces.clone();
        for (&(i, j), &entry) in &entries {
            let mut add = |to: usize, by: usize| {
                let product = arena.mul(entry, predicted[by]);
                forces[to] = arena.add(forces[to], product);
            };
            add(i, j);
            if i != j {
                add(j, i);
            }
        }
        for (force, row) in forces.iter_mut().zip(&own.on_lines) {
            for (&at, &entry) in row {
                let product = arena.mul(entry, own.changes[at]);
                *force = arena.add(*force, product);
            }
        }
        let rates = own.rates(arena, &predicted);
        Self { entries, forces, rates }
    }

    /// True if the stage is that of an explicit scheme.
    pub fn is_none(&self) -> bool {
        self.entries.is_empty() && self.rates.is_empty()
    }

    /// Adds D to the masses.
    pub fn add_to(&self, model: &mut Model, kkt: &mut Kkt) {
        for (&(i, j), &entry) in &self.entries {
            let [a, b] = [i, j].map(Unknown::Coordinate);
            let sum = match kkt.get(a, b) {
                Some(mass) => model.arena.add(mass, entry),
                None => entry,
            };
            let sum = model.arena.share(sum);
            kkt.set(&model.arena, a, b, sum);
        }
    }
}

/// Own states in an implicit stage.
struct OwnStates {
    /// E⁻¹ (Q_o − p_o)
    changes: Vec<Expr>,
    /// E⁻¹ J_ol
    response: Sparse,
    /// J_lo
    on_lines: Sparse,
    /// True if a rate is not what an explicit stage makes it.
    are_implicit: bool,
}

impl OwnStates {
    fn new(model: &mut Model, jacobian: &Sparse, rates: &[Expr], predicted: &[Expr]) -> Self {
        let (lines, all) = (model.line_count(), model.coordinates.len());
        // the rate of a state that depends on reactions is not known before they are
        let reacts = |&(coordinate, _): &(usize, Expr)| coordinate >= lines;
        let is_known = !model.reactive_loads.iter().any(|load| load.work.along.iter().any(reacts));
        let arena = &mut model.arena;
        let part = |rows: &[BTreeMap<usize, Expr>], from: usize, to: usize| -> Sparse {
            let of_row = |row: &BTreeMap<usize, Expr>| {
                row.range(from..to).map(|(&at, &entry)| (at - from, entry)).collect()
            };
            rows.iter().map(of_row).collect()
        };
        let (of_lines, of_states) = jacobian.split_at(lines);
        let among = part(of_states, lines, all);
        let on_lines = if is_known { part(of_lines, lines, all) } else { vec![BTreeMap::new(); lines] };
        // the columns of J_ol, and behind them Q_o − p_o
        let mut right = part(of_states, 0, lines);
        let are_implicit = [&among, &right, &on_lines].into_iter().flatten().any(|row| !row.is_empty());
        for (row, (&rate, &predicted)) in right.iter_mut().zip(rates.iter().zip(predicted).skip(lines)) {
            let behind = arena.sub(rate, predicted);
            row.insert(lines, arena.share(behind));
        }
        let mut response = solved(arena, &among, right);
        let zero = arena.zero();
        let changes = response.iter_mut().map(|row| row.remove(&lines).unwrap_or(zero)).collect();
        Self { changes, response, on_lines, are_implicit }
    }

    /// The rates of all states, if some is not what an explicit stage makes it.
    fn rates(self, arena: &mut Arena, predicted: &[Expr]) -> Vec<Rate> {
        if !self.are_implicit {
            return Vec::new();
        }
        let lines = predicted.len() - self.changes.len();
        let rate = |(at, (change, response)): (usize, (Expr, BTreeMap<usize, Expr>))| {
            let slopes = response.into_iter().map(|(line, slope)| (line, slope, predicted[line])).collect();
            Rate { state: lines + at, predicted: arena.add(predicted[lines + at], change), slopes }
        };
        self.changes.into_iter().zip(self.response).enumerate().map(rate).collect()
    }
}

/// x − a b, of entries that may be left out.
fn less_product(arena: &mut Arena, x: Option<Expr>, a: Expr, b: Expr) -> Expr {
    let product = arena.mul(a, b);
    let rest = match x {
        Some(x) => arena.sub(x, product),
        None => arena.neg(product),
    };
    arena.share(rest)
}

/// The terms of J = s ∂Q/∂v + s² ∂Q/∂q, row by row, each with its column.
fn terms(model: &mut Model, equations: &Equations, inputs: &Inputs) -> Vec<Vec<(usize, Expr)>> {
    let shift = model.arena.variable(inputs.shift);
    let square = model.arena.powi(shift, 2);
    let mut rows = Vec::new();
    for &force in &equations.forces {
        let mut row = Vec::new();
        for symbol in model.arena.symbols_in(force) {
            let (j, factor) = match inputs.of(symbol) {
                Some(Input::Position(at)) => (at, square),
                Some(Input::Velocity(at)) => (at, shift),
                _ => continue,
            };
            let slope = model.arena.partial(force, symbol);
            let slope = model.arena.share(slope);
            row.push((j, model.arena.mul(slope, factor)));
        }
        rows.push(row);
    }
    rows
}

/// The matrix of some terms.
fn summed(arena: &mut Arena, terms: &[Vec<(usize, Expr)>]) -> Sparse {
    let of_row = |terms: &Vec<(usize, Expr)>| {
        let mut row: BTreeMap<usize, Expr> = BTreeMap::new();
        for &(column, term) in terms {
            let known = row.get(&column).copied().unwrap_or(arena.zero());
            row.insert(column, arena.add(known, term));
        }
        row.retain(|_, entry| !arena.is_zero(*entry));
        row
    };
    terms.iter().map(of_row).collect()
}

/// Takes an entry of J from the symmetric part of D.
fn add_symmetric(
    arena: &mut Arena,
    entries: &mut BTreeMap<(usize, usize), Expr>,
    (i, j): (usize, usize),
    entry: Expr,
) {
    // the symmetric part has half of what stands on either side
    let share = if i == j { Number::MINUS_ONE } else { Number::ratio(-1, 2) };
    let product = arena.scale(entry, share);
    let place = (i.min(j), i.max(j));
    let known = entries.get(&place).copied().unwrap_or(arena.zero());
    entries.insert(place, arena.add(known, product));
}

/// A B
fn product(arena: &mut Arena, a: &Sparse, b: &Sparse) -> Sparse {
    let of_row = |row: &BTreeMap<usize, Expr>| {
        let mut sums: BTreeMap<usize, Expr> = BTreeMap::new();
        for (&at, &factor) in row {
            for (&column, &entry) in &b[at] {
                let product = arena.mul(factor, entry);
                let known = sums.get(&column).copied().unwrap_or(arena.zero());
                sums.insert(column, arena.add(known, product));
            }
        }
        sums.into_iter().map(|(column, sum)| (column, arena.share(sum))).collect()
    };
    a.iter().map(of_row).collect()
}

/// The solution of (1 − J) X = R by Gauss's elimination in the order of the states, so that a chain of states takes
/// as many operations as it has links. With steps that become shorter 1 − J comes near to 1, so that a pivot that
/// vanishes asks for a shorter step.
fn solved(arena: &mut Arena, jacobian: &Sparse, mut right: Sparse) -> Sparse {
    let mut rows = Sparse::new();
    for (at, row) in jacobian.iter().enumerate() {
        let mut entries: BTreeMap<usize, Expr> =
            row.iter().map(|(&column, &entry)| (column, arena.neg(entry))).collect();
        let diagonal = entries.get(&at).copied().unwrap_or(arena.zero());
        entries.insert(at, arena.add(diagonal, arena.one()));
        rows.push(entries);
    }
    let mut inverses = Vec::new();
    for at in 0..rows.len() {
        let pivot = arena.share(rows[at][&at]);
        let inverse = arena.powi(pivot, -1);
        let inverse = arena.share(inverse);
        inverses.push(inverse);
        let (above, below) = rows.split_at_mut(at + 1);
        let (right_above, right_below) = right.split_at_mut(at + 1);
        for (row, right) in below.iter_mut().zip(right_below) {
            let Some(entry) = row.remove(&at) else { continue };
            let factor = arena.mul(entry, inverse);
            let factor = arena.share(factor);
            for (&column, &entry) in above[at].range(at + 1..) {
                row.insert(column, less_product(arena, row.get(&column).copied(), factor, entry));
            }
            for (&column, &entry) in &right_above[at] {
                right.insert(column, less_product(arena, right.get(&column).copied(), factor, entry));
            }
        }
    }
    for at in (0..rows.len()).rev() {
        let (above, below) = right.split_at_mut(at + 1);
        for (&column, &entry) in rows[at].range(at + 1..) {
            for (&of, &solved) in &below[column - at - 1] {
                above[at].insert(of, less_product(arena, above[at].get(&of).copied(), entry, solved));
            }
        }
        for entry in above[at].values_mut() {
            let scaled = arena.mul(*entry, inverses[at]);
            *entry = arena.share(scaled);
        }
    }
    right
}
