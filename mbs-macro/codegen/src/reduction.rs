//! Which coordinates have to be integrated, with `states = reduced;`.
//!
//! A row that is linear in a coordinate with a number as its coefficient, Φᵢ = c xⱼ + g(other
//! coordinates, t), gives that coordinate: xⱼ = −g/c. Most rows of planar joints are of that
//! kind. Where it is not integrated, Φᵢ and Φ̇ᵢ are 0 at every instant, so that the row needs
//! no feedback; the rows that are left are integrated and fed back as they are without
//! reduction. The elimination stays what it is: its solution is written in the coordinates
//! that are left.
//!
//! Rows are taken in their order, and each gives a coordinate that no other row has given. The
//! dependences on coordinates, linear ones with their coefficients and others, are kept in numbers;
//! so a coordinate is given only where the choices before have left it linear. Each choice uses up
//! a row, which bounds their number.
//!
//! A coordinate that is given has the errors of those that it is made of. Of a differential gear,
//! h = 1.5 b − 0.5 a, the carrier's angle h may be the small difference of two large ones, and a
//! spring on the carrier then acts on the rounding of a and b. So coordinates on which no force
//! depends are given first, and coefficients that would multiply errors are avoided.
//!
//! # How it is used
//!
//! `StatePosition` and `StateVelocity` are the symbols of a step. `Complete` is the function that leads back
//! to all coordinates.
//!
//! In Rust a step works on `Mechanism::States`, so that types tell both apart. A run completes its state
//! where somebody looks at it. That takes the sines and cosines that the next step takes too, so a step does
//! not do it. In C the state of a run always has all coordinates, and a step ends by completing them.
//!
//! Without feedback, centripetal accelerations along x and y cancel in right-hand sides. These are
//! multiplied out where that costs less (`eliminate/sums.rs` in `mbs-symbolic`).

use std::collections::{BTreeMap, BTreeSet};

use mbs_symbolic::{Arena, Expr, Node, Number, Symbol};
use rustc_hash::FxHashMap as HashMap;

use crate::derive::Equations;
use crate::independence::Rows;
use crate::independence::samples::units;
use crate::inputs::Inputs;
use crate::model::{Meaning, Model};

/// Sums of more terms are computed once, so that those of a chain do not become longer from
/// link to link.
const LONGEST_OPEN_SUM: usize = 8;

/// A coordinate is not given by a coefficient below this share of the largest one in its row, in
/// typical lengths and radians: its errors would be those of the others, multiplied by so much.
const SMALLEST_SHARE: f64 = 0.1;

/// Coordinates that constraints give.
pub struct Reduction {
    /// Position and velocity of every coordinate, by the symbols of the states; empty if all
    /// coordinates are integrated.
    values: HashMap<Symbol, Expr>,
    /// The coordinates that are not integrated.
    given: BTreeSet<usize>,
    /// The rows that give them.
    pub rows: BTreeSet<usize>,
}

/// Chooses the coordinates that are integrated: all, or with `states = reduced;` those that no
/// row gives, whose symbols are then those of states.
pub fn reduce(model: &mut Model, equations: &Equations, rows: &Rows, inputs: &mut Inputs) -> Reduction {
    let given = match model.solver.has_reduced_states() {
        true => given(model, equations, rows),
        false => Given::default(),
    };
    if given.rows.is_empty() {
        return Reduction { values: HashMap::default(), given: BTreeSet::new(), rows: BTreeSet::new() };
    }
    Reduction::new(model, given, inputs)
}

impl Reduction {
    fn new(model: &mut Model, given: Given, inputs: &mut Inputs) -> Self {
        let coordinates: BTreeSet<usize> = given.rows.keys().copied().collect();
        let states: Vec<usize> =
            (0..model.coordinates.len()).filter(|at| !coordinates.contains(at)).collect();
        inputs.reduce(model, &states);
        let mut values = HashMap::default();
        for state in &inputs.states {
            let coordinate = &model.coordinates[state.coordinate];
            values.insert(coordinate.position, model.arena.variable(state.position));
            values.insert(coordinate.velocity, model.arena.variable(state.velocity));
        }
        let symbols: Vec<Symbol> = coordinates.iter().flat_map(|&at| symbols_of(model, at)).collect();
        let by_others: Vec<Expr> = symbols.iter().map(|symbol| given.values[symbol]).collect();
        let by_states = model.arena.substitute_all(&by_others, &values);
        values.extend(symbols.into_iter().zip(by_states));
        Self { values, given: coordinates, rows: given.rows.into_values().collect() }
    }

    /// The coordinates that constraints give, and what they are by the others.
    pub fn given(&self, model: &Model) -> Vec<(usize, Expr)> {
        let value = |at: usize| self.values.get(&model.coordinates[at].position);
        self.given.iter().filter_map(|&at| Some((at, *value(at)?))).collect()
    }

    /// Functions of all coordinates as functions of those that are integrated.
    pub fn in_states(&self, arena: &mut Arena, roots: &[Expr]) -> Vec<Expr> {
        if self.values.is_empty() { roots.to_vec() } else { arena.substitute_all(roots, &self.values) }
    }

    /// The predicted accelerations of all coordinates: of those that a row gives, that of their
    /// formula.
    pub fn predicted(&self, model: &mut Model, inputs: &Inputs) -> Vec<Expr> {
        let arena = &mut model.arena;
        let mut direction = HashMap::from_iter([(inputs.time, arena.one())]);
        let mut predicted = vec![arena.zero(); model.coordinates.len()];
        for state in &inputs.states {
            let acceleration = arena.variable(state.predicted);
            direction.insert(state.position, arena.variable(state.velocity));
            direction.insert(state.velocity, acceleration);
            predicted[state.coordinate] = acceleration;
        }
        for &at in &self.given {
            if let Some(&velocity) = self.values.get(&model.coordinates[at].velocity) {
                let acceleration = arena.derivative(velocity, &direction);
                predicted[at] = arena.share(acceleration);
            }
        }
        predicted
    }

    /// All coordinates and velocities as functions of the states.
    pub fn complete(&self, model: &mut Model) -> Vec<Expr> {
        let positions = model.coordinates.iter().map(|coordinate| coordinate.position);
        let velocities = model.coordinates.iter().map(|coordinate| coordinate.velocity);
        let symbols: Vec<Symbol> = positions.chain(velocities).collect();
        let all: Vec<Expr> = symbols.into_iter().map(|symbol| model.arena.variable(symbol)).collect();
        self.in_states(&mut model.arena, &all)
    }
}

/// The coordinates that rows give.
#[derive(Default)]
struct Given {
    /// The row of each coordinate.
    rows: BTreeMap<usize, usize>,
    /// Their positions and velocities, by those of coordinates that no row gives.
    values: HashMap<Symbol, Expr>,
}

/// A dependence on coordinates: linear with these coefficients, or otherwise.
#[derive(Clone, Default)]
struct Dependence {
    linear: BTreeMap<usize, Number>,
    otherwise: BTreeSet<usize>,
}

impl Dependence {
    /// Of a row, by its entries of Φ_q.
    fn of_row(arena: &Arena, entries: &BTreeMap<usize, Expr>) -> Self {
        let mut dependence = Self::default();
        for (&column, &entry) in entries {
            match arena.as_number(entry) {
                Some(coefficient) => {
                    dependence.linear.insert(column, coefficient);
                }
                None => {
                    dependence.otherwise.insert(column);
                }
            }
        }
        dependence
    }

    fn contains(&self, coordinate: usize) -> bool {
        self.linear.contains_key(&coordinate) || self.otherwise.contains(&coordinate)
    }

    /// The same with what a coordinate depends on in its place.
    fn replace(&mut self, coordinate: usize, given: &Self) {
        if self.otherwise.remove(&coordinate) {
            self.otherwise.extend(given.linear.keys().chain(&given.otherwise));
        }
        let Some(factor) = self.linear.remove(&coordinate) else { return };
        for (&column, &coefficient) in &given.linear {
            let sum = self.linear.get(&column).copied().unwrap_or(Number::ZERO) + factor * coefficient;
            self.linear.insert(column, sum);
        }
        self.otherwise.extend(&given.otherwise);
    }

    /// The coordinates that are given by 0 = this, and their coefficients.
    fn candidates(&self) -> impl Iterator<Item = (usize, Number)> {
        let is_given = |(column, coefficient): &(&usize, &Number)| {
            !coefficient.is_zero() && !self.otherwise.contains(column)
        };
        self.linear.iter().filter(is_given).map(|(&column, &coefficient)| (column, coefficient))
    }

    /// The dependence of the coordinate that is given by 0 = this.
    fn solved(mut self, coordinate: usize, coefficient: Number) -> Self {
        self.linear.remove(&coordinate);
        let factor = -coefficient.recip();
        self.linear.values_mut().for_each(|value| *value = factor * *value);
        self
    }
}

/// The coordinates that rows give, and what they are by the others.
fn given(model: &mut Model, equations: &Equations, rows: &Rows) -> Given {
    let mut given = Given::default();
    let mut dependences: BTreeMap<usize, Dependence> = BTreeMap::new();
    let preference = Preference::new(model, equations);
    for row in model.of_positions(&rows.alone()) {
        let mut dependence = Dependence::of_row(&model.arena, &equations.phi_q[row]);
        for (&coordinate, known) in &dependences {
            dependence.replace(coordinate, known);
        }
        let Some((coordinate, coefficient)) = preference.best(model, &dependence) else { continue };
        let dependence = dependence.solved(coordinate, coefficient);

        let symbols = symbols_of(model, coordinate);
        let solved = [equations.phi[row], equations.phi_dot[row]].into_iter().zip(symbols);
        let solved = solved.map(|(row, x)| (x, solve(&mut model.arena, row, &given.values, x, coefficient)));
        let solved: HashMap<Symbol, Expr> = solved.collect();
        // what was given before by this one is given by the others
        for (&before, known) in dependences.iter_mut().filter(|(_, known)| known.contains(coordinate)) {
            for symbol in symbols_of(model, before) {
                if let Some(value) = given.values.get_mut(&symbol) {
                    let by_others = model.arena.substitute(*value, &solved);
                    *value = short(&mut model.arena, by_others);
                }
            }
            known.replace(coordinate, &dependence);
        }
        dependences.insert(coordinate, dependence);
        given.values.extend(solved);
        given.rows.insert(coordinate, row);
    }
    given
}

/// Which coordinates are given rather than others.
struct Preference {
    /// Coordinates on which forces depend, by their positions or velocities.
    felt: BTreeSet<usize>,
    /// Unit of each coordinate: 1 rad for an angle, a typical length of the mechanism in m for a length.
    units: Vec<f64>,
}

impl Preference {
    fn new(model: &Model, equations: &Equations) -> Self {
        let nodes = model.arena.reachable(&equations.total_forces);
        let coordinate = |expr: &Expr| match *model.arena.node(*expr) {
            Node::Symbol(symbol) => match model.meanings.get(symbol.index()) {
                Some(&Meaning::Coordinate(at) | &Meaning::Velocity(at)) => Some(at),
                _ => None,
            },
            _ => None,
        };
        Self { felt: nodes.iter().filter_map(coordinate).collect(), units: units(model) }
    }

    /// The coordinate that is given by 0 = `dependence`, and its coefficient: one that no force
    /// depends on, with a coefficient that is not small, a length rather than an angle, of the
    /// body that was declared last.
    fn best(&self, model: &Model, dependence: &Dependence) -> Option<(usize, Number)> {
        let size = |at: usize, coefficient: Number| coefficient.to_f64().abs() * self.units[at];
        let largest = dependence.linear.iter().map(|(&at, &c)| size(at, c)).fold(0.0, f64::max);
        dependence.candidates().max_by_key(|&(at, coefficient)| {
            let is_length = !model.coordinates[at].is_angle();
            let is_small = size(at, coefficient) < SMALLEST_SHARE * largest;
            (!is_small, !self.felt.contains(&at), is_length, at)
        })
    }
}

/// The symbols of a position and its velocity.
fn symbols_of(model: &Model, coordinate: usize) -> [Symbol; 2] {
    let coordinate = &model.coordinates[coordinate];
    [coordinate.position, coordinate.velocity]
}

/// The x of 0 = `row`, which is linear in it, with what is known before in its place.
fn solve(
    arena: &mut Arena,
    row: Expr,
    known: &HashMap<Symbol, Expr>,
    x: Symbol,
    coefficient: Number,
) -> Expr {
    let row = arena.substitute(row, known);
    let rest = arena.substitute(row, &HashMap::from_iter([(x, arena.zero())]));
    let value = arena.scale(rest, -coefficient.recip());
    short(arena, value)
}

/// A value that is computed once if it is a long sum.
fn short(arena: &mut Arena, value: Expr) -> Expr {
    match arena.node(value) {
        Node::Sum(_, terms) if terms.len() > LONGEST_OPEN_SUM => arena.share(value),
        _ => value,
    }
}
