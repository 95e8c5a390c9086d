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
        let own = OwnStates::new(model, &jacobian);
        let arena = &mut model.arena;
        for (i, row) in own.felt.iter().enumerate() {
            for (&j, &entry) in row {
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
        let rates = own.rates(arena, &equations.forces, &predicted, &mut forces);
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
    /// How many coordinates stand before them.
    lines: usize,
    /// E⁻¹
    inverse: Sparse,
    /// E⁻¹ J_ol
    response: Sparse,
    /// J_lo E⁻¹
    pull: Sparse,
    /// J_lo E⁻¹ J_ol
    felt: Sparse,
}

impl OwnStates {
    fn new(model: &mut Model, jacobian: &Sparse) -> Self {
        let (lines, count) = (model.line_count(), model.coordinates.len() - model.line_count());
        // the rate of a state that depends on reactions is not known before they are
        let reacts = |&(coordinate, _): &(usize, Expr)| coordinate >= lines;
        let is_known = !model.reactive_loads.iter().any(|load| load.work.along.iter().any(reacts));
        let arena = &mut model.arena;
        let part = |row: &BTreeMap<usize, Expr>, from: usize, to: usize| -> BTreeMap<usize, Expr> {
            row.range(from..to).map(|(&at, &entry)| (at - from, entry)).collect()
        };
        let (of_lines, of_states) = jacobian.split_at(lines);
        let on_states: Sparse = of_states.iter().map(|row| part(row, 0, lines)).collect();
        let among: Sparse = of_states.iter().map(|row| part(row, lines, lines + count)).collect();
        let on_lines: Sparse = match is_known {
            true => of_lines.iter().map(|row| part(row, lines, lines + count)).collect(),
            false => vec![BTreeMap::new(); lines],
        };
        let inverse = inverse(arena, &among);
        let response = product(arena, &inverse, &on_states);
        let pull = product(arena, &on_lines, &inverse);
        let felt = product(arena, &on_lines, &response);
        Self { lines, inverse, response, pull, felt }
    }

    /// The rates of all states, of which some is not what an explicit stage makes it; adds to the forces along
    /// lines what states change of them.
    fn rates(self, arena: &mut Arena, own: &[Expr], predicted: &[Expr], forces: &mut [Expr]) -> Vec<Rate> {
        let is_identity = |(at, row): (usize, &BTreeMap<usize, Expr>)| {
            row.len() == 1 && row.get(&at).is_some_and(|&entry| entry == arena.one())
        };
        let is_explicit = self.inverse.iter().enumerate().all(is_identity);
        if is_explicit && self.response.iter().chain(&self.pull).all(BTreeMap::is_empty) {
            return Vec::new();
        }
        let lines = self.lines;
        let behind: Vec<Expr> = (own.iter().zip(predicted).skip(lines))
            .map(|(&rate, &predicted)| {
                let behind = arena.sub(rate, predicted);
                arena.share(behind)
            })
            .collect();
        for (force, row) in forces.iter_mut().zip(&self.pull) {
            *force = plus_products(arena, *force, row.iter().map(|(&at, &entry)| (entry, behind[at])));
        }
        let rate = |(at, (inverse, response)): (usize, (&BTreeMap<usize, Expr>, &BTreeMap<usize, Expr>))| {
            let state = lines + at;
            let terms = inverse.iter().map(|(&of, &entry)| (entry, behind[of]));
            let value = plus_products(arena, predicted[state], terms);
            let slopes = response.iter().map(|(&line, &slope)| (line, slope, predicted[line]));
            Rate { state, predicted: value, slopes: slopes.collect() }
        };
        self.inverse.iter().zip(&self.response).enumerate().map(rate).collect()
    }
}

/// x + Σ a b
fn plus_products(arena: &mut Arena, x: Expr, terms: impl Iterator<Item = (Expr, Expr)>) -> Expr {
    terms.fold(x, |sum, (a, b)| {
        let product = arena.mul(a, b);
        arena.add(sum, product)
    })
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

/// (1 − J)⁻¹ by Gauss and Jordan, in the order of the states. With steps that become shorter 1 − J comes near to 1,
/// so that a pivot that vanishes asks for a shorter step.
fn inverse(arena: &mut Arena, jacobian: &Sparse) -> Sparse {
    let count = jacobian.len();
    let mut rows: Sparse = Sparse::new();
    for (at, row) in jacobian.iter().enumerate() {
        let mut entries: BTreeMap<usize, Expr> =
            row.iter().map(|(&column, &entry)| (column, arena.neg(entry))).collect();
        let diagonal = entries.get(&at).copied().unwrap_or(arena.zero());
        let (one, diagonal) = (arena.one(), arena.add(diagonal, arena.one()));
        entries.insert(at, diagonal);
        entries.insert(count + at, one);
        rows.push(entries);
    }
    for at in 0..count {
        let pivot = arena.share(rows[at][&at]);
        let inverse = arena.powi(pivot, -1);
        let inverse = arena.share(inverse);
        for entry in rows[at].values_mut() {
            let scaled = arena.mul(*entry, inverse);
            *entry = arena.share(scaled);
        }
        let scaled = rows[at].clone();
        for row in rows.iter_mut().enumerate().filter(|(other, _)| *other != at).map(|(_, row)| row) {
            let Some(factor) = row.remove(&at) else { continue };
            for (&column, &entry) in scaled.range(at + 1..) {
                let product = arena.mul(factor, entry);
                let known = row.get(&column).copied().unwrap_or(arena.zero());
                let rest = arena.sub(known, product);
                row.insert(column, arena.share(rest));
            }
        }
    }
    let right = |row: BTreeMap<usize, Expr>| {
        let columns = row.into_iter().filter(|(column, _)| *column >= count);
        columns.map(|(column, entry)| (column - count, entry)).collect()
    };
    rows.into_iter().map(right).collect()
}
