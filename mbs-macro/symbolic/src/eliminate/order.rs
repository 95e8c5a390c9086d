//! Which pivot comes next.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::matrix::{Kkt, Unknown};
use crate::arena::{Arena, Expr, Stage};
use crate::number::Number;

/// In which order pivots are taken. Any order gives the same solution; they
/// differ in cost, and which one is cheaper depends on the mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strategy {
    /// Constraints first: the motion is written through the velocities that
    /// they leave free. Cheap where few degrees of freedom are left.
    NullSpace,
    /// The locally cheapest pivot, mass or constraint. Keeps chains sparse.
    Cheapest,
}

impl Strategy {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::NullSpace, Self::Cheapest];
}

/// A chosen pivot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pivot {
    Pair { row: Unknown, coordinate: Unknown },
    Diagonal(Unknown),
    Loop { row: Unknown, coordinates: [Unknown; 2] },
}

impl Pivot {
    /// What it takes out.
    pub fn unknowns(self) -> Vec<Unknown> {
        match self {
            Self::Pair { row, coordinate } => vec![row, coordinate],
            Self::Diagonal(unknown) => vec![unknown],
            Self::Loop { row, coordinates: [a, b] } => vec![row, a, b],
        }
    }
}

/// Unknowns that no pivot determines: rows that repeat others, or massless
/// coordinates that no constraint fixes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Undetermined {
    /// The unknowns that were left.
    pub unknowns: Vec<Unknown>,
}

impl fmt::Display for Undetermined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no pivot determines {:?}", self.unknowns)
    }
}

impl std::error::Error for Undetermined {}

/// What makes a pivot safe, best first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    /// A pair with a coefficient that is a number.
    ConstantPair,
    /// A pair in which the row touches nothing else: it vanishes exactly where
    /// the whole system is singular.
    LastPair,
    /// A row whose coordinates are all eliminated.
    SchurRow,
    /// A positive mass.
    Mass,
}

/// How much larger another constant of a row may be than its pivot.
const LARGEST_WEIGHT: f64 = 1e3;

/// What speaks for a pivot, the best one least: whether it is not urgent, its
/// cost and class as the strategy weighs them, and its place in the mechanism.
type Key = (bool, (usize, usize), Unknown);

#[derive(Clone, Copy)]
struct Candidate {
    class: Class,
    /// A massless coordinate has to find its row before rows lose their zero
    /// diagonal entry.
    is_urgent: bool,
    cost: usize,
    pivot: Pivot,
}

impl Candidate {
    fn key(&self, strategy: Strategy) -> Key {
        let class = self.class as usize;
        let weighed = match strategy {
            Strategy::NullSpace => (class, self.cost),
            Strategy::Cheapest => (self.cost, class),
        };
        (!self.is_urgent, weighed, first_unknown(self.pivot))
    }
}

/// The best pivot of every unknown, kept up to date while the matrix changes.
pub(super) struct Order {
    strategy: Strategy,
    candidates: BTreeMap<Unknown, Candidate>,
    queue: BTreeSet<(Key, Unknown)>,
    massless: BTreeSet<Unknown>,
}

impl Order {
    pub fn new(arena: &Arena, matrix: &Kkt, strategy: Strategy) -> Self {
        let (candidates, queue, massless) = (BTreeMap::new(), BTreeSet::new(), BTreeSet::new());
        let mut order = Self { strategy, candidates, queue, massless };
        for unknown in matrix.unknowns() {
            order.judge(arena, matrix, unknown);
        }
        order
    }

    /// Judges again what a step may have changed: the unknowns that it took out,
    /// those that it touched, and the rows that are coupled to these.
    pub fn update(&mut self, arena: &Arena, matrix: &Kkt, taken: &[Unknown], touched: &BTreeSet<Unknown>) {
        let coordinates = touched.iter().filter(|unknown| matches!(unknown, Unknown::Coordinate(_)));
        let rows = coordinates.flat_map(|&unknown| matrix.neighbours(unknown)).map(|(other, _)| other);
        let rows = rows.filter(|other| matches!(other, Unknown::Row(_)));
        let changed: BTreeSet<Unknown> = rows.chain(touched.iter().copied()).collect();
        for &unknown in taken.iter().chain(&changed) {
            self.judge(arena, matrix, unknown);
        }
    }

    fn judge(&mut self, arena: &Arena, matrix: &Kkt, unknown: Unknown) {
        if let Some(known) = self.candidates.remove(&unknown) {
            self.queue.remove(&(known.key(self.strategy), unknown));
        }
        self.massless.remove(&unknown);
        if !matrix.contains(unknown) {
            return;
        }
        if is_massless(arena, matrix, unknown) {
            self.massless.insert(unknown);
        }
        let candidates = candidates(arena, matrix, unknown);
        if let Some(best) = candidates.into_iter().min_by_key(|candidate| candidate.key(self.strategy)) {
            self.queue.insert((best.key(self.strategy), unknown));
            self.candidates.insert(unknown, best);
        }
    }

    /// The next pivot; `None` when nothing is left.
    pub fn choose(
        &self,
        arena: &Arena,
        matrix: &Kkt,
        magnitude: &dyn Fn(&Arena, Expr) -> f64,
    ) -> Result<Option<Pivot>, Undetermined> {
        let best = self.queue.first().and_then(|(_, unknown)| self.candidates.get(unknown));
        let is_pair = best.is_some_and(|candidate| candidate.class <= Class::LastPair);
        if let (false, Some(pivot)) = (is_pair, single_loop(matrix)) {
            return Ok(Some(pivot));
        }
        match best {
            Some(candidate) if is_pair || self.massless.is_empty() => Ok(Some(candidate.pivot)),
            best => {
                if let Some(pivot) = largest_pair(arena, matrix, magnitude) {
                    return Ok(Some(pivot));
                }
                if let Some(candidate) = best {
                    return Ok(Some(candidate.pivot));
                }
                if let Some(pivot) = largest_mass(arena, matrix, magnitude) {
                    return Ok(Some(pivot));
                }
                let unknowns: Vec<_> = matrix.unknowns().collect();
                if unknowns.is_empty() { Ok(None) } else { Err(Undetermined { unknowns }) }
            }
        }
    }
}

fn first_unknown(pivot: Pivot) -> Unknown {
    match pivot {
        Pivot::Pair { coordinate, .. } => coordinate,
        Pivot::Diagonal(unknown) => unknown,
        Pivot::Loop { row, .. } => row,
    }
}

/// All that is left, if that is two coordinates, their masses coupled, and one
/// row over both. (Without the coupling, masses are the cheaper pivots.)
fn single_loop(matrix: &Kkt) -> Option<Pivot> {
    let left: Vec<_> = matrix.unknowns().take(4).collect();
    let [first @ Unknown::Coordinate(_), second @ Unknown::Coordinate(_), row @ Unknown::Row(_)] = left[..]
    else {
        return None;
    };
    let is_set = |a, b| matrix.get(a, b).is_some();
    let has_masses = is_set(first, first) && is_set(second, second) && is_set(first, second);
    let fits = has_masses && is_set(row, first) && is_set(row, second);
    (fits && !is_set(row, row)).then_some(Pivot::Loop { row, coordinates: [first, second] })
}

fn candidates(arena: &Arena, matrix: &Kkt, unknown: Unknown) -> Vec<Candidate> {
    match unknown {
        Unknown::Row(_) if matrix.get(unknown, unknown).is_none() => pair_candidates(arena, matrix, unknown),
        Unknown::Row(_) => {
            let is_coupled =
                matrix.neighbours(unknown).any(|(other, _)| matches!(other, Unknown::Coordinate(_)));
            if is_coupled { Vec::new() } else { vec![diagonal(matrix, unknown, Class::SchurRow)] }
        }
        Unknown::Coordinate(_) => {
            let is_safe = matrix.get(unknown, unknown).is_some() && !is_massless(arena, matrix, unknown);
            if is_safe { vec![diagonal(matrix, unknown, Class::Mass)] } else { Vec::new() }
        }
    }
}

/// A coordinate whose mass is not positive for certain.
fn is_massless(arena: &Arena, matrix: &Kkt, unknown: Unknown) -> bool {
    let reduced_mass_is_constant =
        || matrix.get(unknown, unknown).is_some_and(|mass| arena.stage(mass) <= Stage::Parameter);
    matches!(unknown, Unknown::Coordinate(_)) && !matrix.is_massive(unknown) && !reduced_mass_is_constant()
}

fn pair_candidates(arena: &Arena, matrix: &Kkt, row: Unknown) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    let neighbours: Vec<_> = matrix.neighbours(row).collect();
    let size = |entry| arena.as_number(entry).map(|number| number.abs().to_f64());
    let largest = neighbours.iter().filter_map(|&(_, entry)| size(entry)).fold(0.0, f64::max);
    for &(coordinate, entry) in &neighbours {
        if !matches!(coordinate, Unknown::Coordinate(_)) {
            continue;
        }
        let class = match size(entry) {
            // a small one beside a large one would cost digits
            Some(size) if size * LARGEST_WEIGHT < largest => continue,
            Some(_) => Class::ConstantPair,
            None if neighbours.len() == 1 => Class::LastPair,
            None => continue,
        };
        let is_unit = arena.as_number(entry).is_some_and(|n| n.abs() == Number::ONE);
        candidates.push(Candidate {
            class,
            is_urgent: is_massless(arena, matrix, coordinate),
            cost: pair_cost(matrix, row, coordinate) + usize::from(!is_unit),
            pivot: Pivot::Pair { row, coordinate },
        });
    }
    candidates
}

/// Entries that change when the pair is eliminated, each counted in one half.
fn pair_cost(matrix: &Kkt, row: Unknown, coordinate: Unknown) -> usize {
    let is_other = |other: &Unknown| *other != row && *other != coordinate;
    let of_row: BTreeSet<_> = matrix.neighbours(row).map(|(other, _)| other).filter(is_other).collect();
    let of_coordinate: BTreeSet<_> =
        matrix.neighbours(coordinate).map(|(other, _)| other).filter(is_other).collect();
    let only_coordinate = of_coordinate.difference(&of_row).count();
    of_row.len() * (of_row.len() + 1) / 2 + of_row.len() * only_coordinate
}

fn diagonal(matrix: &Kkt, unknown: Unknown, class: Class) -> Candidate {
    let neighbours = matrix.neighbours(unknown).count();
    let cost = neighbours * (neighbours + 1) / 2;
    Candidate { class, is_urgent: false, cost, pivot: Pivot::Diagonal(unknown) }
}

/// For the massless coordinates: the pair whose coefficient stays largest over
/// the sampled positions. Not safe by its form; pivot growth is watched.
fn largest_pair(arena: &Arena, matrix: &Kkt, magnitude: &dyn Fn(&Arena, Expr) -> f64) -> Option<Pivot> {
    let mut best: Option<(f64, Pivot)> = None;
    for row in matrix.unknowns() {
        if !matches!(row, Unknown::Row(_)) || matrix.get(row, row).is_some() {
            continue;
        }
        for (coordinate, entry) in matrix.neighbours(row) {
            if !is_massless(arena, matrix, coordinate) {
                continue;
            }
            let size = magnitude(arena, entry);
            if best.is_none_or(|(largest, _)| size > largest) {
                best = Some((size, Pivot::Pair { row, coordinate }));
            }
        }
    }
    best.filter(|(size, _)| *size > 0.0).map(|(_, pivot)| pivot)
}

/// The last resort of a massless coordinate: the reduced mass that stays
/// largest over the sampled positions.
fn largest_mass(arena: &Arena, matrix: &Kkt, magnitude: &dyn Fn(&Arena, Expr) -> f64) -> Option<Pivot> {
    let is_coordinate = |unknown: &Unknown| matches!(unknown, Unknown::Coordinate(_));
    let sized = |unknown| Some((magnitude(arena, matrix.get(unknown, unknown)?), unknown));
    let largest =
        matrix.unknowns().filter(is_coordinate).filter_map(sized).max_by(|a, b| a.0.total_cmp(&b.0));
    largest.filter(|(size, _)| *size > 0.0).map(|(_, unknown)| Pivot::Diagonal(unknown))
}
