//! Which pivot comes next.
//!
//! `Strategy` orders the candidates. Constraints come first (null space), or the locally cheapest
//! (Markowitz), or masses and then, of equally cheap rows, the one that waits for the fewest pivots.
//! Otherwise equally good candidates are taken in their order, so that the links of a chain are eliminated
//! alike.
//!
//! Candidates wait in a queue. A step has those judged anew that it touched. So the work grows with the
//! chain.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::matrix::{Kkt, Unknown};
use crate::arena::Arena;
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
    /// Masses first, then the locally cheapest row; among equally cheap rows the one that waits
    /// for the fewest pivots. A chain is then eliminated from both ends at once (twisted
    /// factorization), and each pivot waits for half as many others.
    BothEnds,
}

impl Strategy {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::NullSpace, Self::Cheapest, Self::BothEnds];
}

/// A chosen pivot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pivot {
    Pair { row: Unknown, coordinate: Unknown },
    Diagonal(Unknown),
    Loop { row: Unknown, coordinates: [Unknown; 2] },
}

/// The next step of the elimination.
pub(super) enum Next {
    Pivot(Pivot),
    /// These rows are added to the mass block, see [`super::augmentation`].
    Augmentation(Vec<Unknown>),
    /// These rows are made independent of each other, see [`super::deflation`].
    Deflation(Vec<Unknown>),
}

impl Pivot {
    /// The unknowns that it takes out.
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

/// The reasons for which a pivot is safe, best first.
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

/// The key by which pivots are compared, the best one least: whether it is not urgent, its
/// cost, class and depth as the strategy weighs them, and its place in the mechanism.
type Key = (bool, [usize; 3], Unknown);

#[derive(Clone, Copy)]
struct Candidate {
    class: Class,
    /// A coordinate without a mass of its own has to find its row before rows lose
    /// their zero diagonal entry.
    is_urgent: bool,
    cost: usize,
    /// How many pivots, one after the other, come before it.
    depth: usize,
    pivot: Pivot,
}

impl Candidate {
    fn key(&self, strategy: Strategy) -> Key {
        let class = self.class as usize;
        let weighed = match strategy {
            Strategy::NullSpace => [class, self.cost, 0],
            Strategy::Cheapest => [self.cost, class, 0],
            Strategy::BothEnds => [usize::from(self.class == Class::SchurRow), self.cost, self.depth],
        };
        (!self.is_urgent, weighed, first_unknown(self.pivot))
    }
}

/// The best pivot of every unknown, kept up to date while the matrix changes.
pub(super) struct Order {
    strategy: Strategy,
    candidates: BTreeMap<Unknown, Candidate>,
    queue: BTreeSet<(Key, Unknown)>,
    /// Coordinates without a mass of their own: where a combination of their
    /// accelerations moves no mass, only the constraints determine it. The mass
    /// block is positive definite over all other coordinates, in any position.
    uncertain: BTreeSet<Unknown>,
    /// How many pivots, one after the other, have changed the entries of an unknown.
    depths: BTreeMap<Unknown, usize>,
}

impl Order {
    pub fn new(arena: &Arena, matrix: &Kkt, strategy: Strategy) -> Self {
        let is_uncertain =
            |unknown: &Unknown| matches!(unknown, Unknown::Coordinate(_)) && !matrix.is_massive(*unknown);
        let uncertain = matrix.unknowns().filter(is_uncertain).collect();
        let mut order = Self {
            strategy,
            candidates: BTreeMap::new(),
            queue: BTreeSet::new(),
            uncertain,
            depths: BTreeMap::new(),
        };
        for unknown in matrix.unknowns() {
            order.judge(arena, matrix, unknown);
        }
        order
    }

    /// Judges again what a step may have changed: the unknowns that it took out,
    /// those that it touched, and the rows that are coupled to these.
    pub fn update(&mut self, arena: &Arena, matrix: &Kkt, taken: &[Unknown], touched: &BTreeSet<Unknown>) {
        taken.iter().for_each(|unknown| {
            self.uncertain.remove(unknown);
        });
        let depth = self.depth(taken) + 1;
        for &unknown in touched {
            let known = self.depths.entry(unknown).or_insert(0);
            *known = depth.max(*known);
        }
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
        if !matrix.contains(unknown) {
            return;
        }
        let candidates = self.candidates_of(arena, matrix, unknown);
        if let Some(best) = candidates.into_iter().min_by_key(|candidate| candidate.key(self.strategy)) {
            self.queue.insert((best.key(self.strategy), unknown));
            self.candidates.insert(unknown, best);
        }
    }

    /// Chooses the next step; `None` when nothing is left.
    ///
    /// Pairs come first as long as a mass is uncertain: a mass that is eliminated
    /// leaves no 0 on the diagonal of its rows.
    pub fn choose(&mut self, arena: &mut Arena, matrix: &Kkt) -> Result<Option<Next>, Undetermined> {
        if let Some(pair) = self.best().filter(|candidate| candidate.class <= Class::LastPair) {
            return Ok(Some(Next::Pivot(pair.pivot)));
        }
        if let Some(pivot) = single_loop(matrix) {
            return Ok(Some(Next::Pivot(pivot)));
        }
        if !self.uncertain.is_empty() {
            let rows = self.make_certain(arena, matrix)?;
            if !rows.is_empty() {
                return Ok(Some(Next::Augmentation(rows)));
            }
        }
        match self.best() {
            Some(candidate) => Ok(Some(Next::Pivot(candidate.pivot))),
            None if matrix.unknowns().next().is_none() => Ok(None),
            None => match matrix.next_set() {
                Some(rows) => Ok(Some(Next::Deflation(rows.to_vec()))),
                None => Err(Undetermined { unknowns: matrix.unknowns().collect() }),
            },
        }
    }

    fn best(&self) -> Option<&Candidate> {
        self.queue.first().and_then(|(_, unknown)| self.candidates.get(unknown))
    }

    /// Leaves no mass uncertain; gives the rows that have to be added to the mass
    /// block for that. Without any, a regular system has a definite mass block.
    fn make_certain(&mut self, arena: &mut Arena, matrix: &Kkt) -> Result<Vec<Unknown>, Undetermined> {
        let uncertain = without_certain(arena, matrix, std::mem::take(&mut self.uncertain));
        let nothing = |unknown: &Unknown| {
            matrix.get(*unknown, *unknown).is_none() && matrix.neighbours(*unknown).next().is_none()
        };
        let undetermined: Vec<_> = uncertain.iter().copied().filter(nothing).collect();
        if !undetermined.is_empty() {
            return Err(Undetermined { unknowns: undetermined });
        }
        let neighbours = uncertain.iter().flat_map(|&unknown| matrix.neighbours(unknown));
        let rows = neighbours.map(|(other, _)| other).filter(|other| matches!(other, Unknown::Row(_)));
        let rows: BTreeSet<_> = rows.collect();
        // all masses are candidates now, and no pair is urgent
        for unknown in matrix.unknowns() {
            self.judge(arena, matrix, unknown);
        }
        Ok(rows.into_iter().collect())
    }

    /// How many pivots, one after the other, come before one of these.
    fn depth(&self, unknowns: &[Unknown]) -> usize {
        let depths = unknowns.iter().filter_map(|unknown| self.depths.get(unknown));
        depths.max().copied().unwrap_or(0)
    }

    fn candidates_of(&self, arena: &Arena, matrix: &Kkt, unknown: Unknown) -> Vec<Candidate> {
        match unknown {
            // it waits for all others
            Unknown::Row(_) if matrix.is_in_set(unknown) => Vec::new(),
            Unknown::Row(_) if matrix.get(unknown, unknown).is_none() => {
                self.pair_candidates(arena, matrix, unknown)
            }
            Unknown::Row(_) => {
                let is_coupled =
                    matrix.neighbours(unknown).any(|(other, _)| matches!(other, Unknown::Coordinate(_)));
                if is_coupled { Vec::new() } else { vec![self.diagonal(matrix, unknown, Class::SchurRow)] }
            }
            Unknown::Coordinate(_) => {
                let is_safe = matrix.get(unknown, unknown).is_some() && !self.uncertain.contains(&unknown);
                if is_safe { vec![self.diagonal(matrix, unknown, Class::Mass)] } else { Vec::new() }
            }
        }
    }

    fn pair_candidates(&self, arena: &Arena, matrix: &Kkt, row: Unknown) -> Vec<Candidate> {
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
                is_urgent: self.uncertain.contains(&coordinate),
                cost: pair_cost(matrix, row, coordinate) + usize::from(!is_unit),
                depth: self.depth(&[row, coordinate]),
                pivot: Pivot::Pair { row, coordinate },
            });
        }
        candidates
    }

    fn diagonal(&self, matrix: &Kkt, unknown: Unknown, class: Class) -> Candidate {
        let neighbours = matrix.neighbours(unknown).count();
        let cost = neighbours * (neighbours + 1) / 2;
        let depth = self.depth(&[unknown]);
        Candidate { class, is_urgent: false, cost, depth, pivot: Pivot::Diagonal(unknown) }
    }
}

/// Those whose mass is not certain: a reduced mass that cannot vanish is, if
/// it is coupled to none that is uncertain.
///
/// With M ≥ 0 in the quadratic sense, xᵀMx = 0 for x over the uncertain ones
/// implies Mx = 0, and the row of such a coordinate reads M_zz x_z = 0. Ends
/// since every round takes one out.
fn without_certain(arena: &mut Arena, matrix: &Kkt, mut uncertain: BTreeSet<Unknown>) -> BTreeSet<Unknown> {
    let mut is_certain = |uncertain: &BTreeSet<Unknown>, unknown: Unknown| {
        let is_positive = matrix.get(unknown, unknown).is_some_and(|mass| arena.is_positive(mass));
        is_positive && matrix.neighbours(unknown).all(|(other, _)| !uncertain.contains(&other))
    };
    while let Some(certain) = uncertain.iter().copied().find(|&unknown| is_certain(&uncertain, unknown)) {
        uncertain.remove(&certain);
    }
    uncertain
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

/// Entries that change when the pair is eliminated, each counted in one half.
fn pair_cost(matrix: &Kkt, row: Unknown, coordinate: Unknown) -> usize {
    let is_other = |other: &Unknown| *other != row && *other != coordinate;
    let of_row: BTreeSet<_> = matrix.neighbours(row).map(|(other, _)| other).filter(is_other).collect();
    let of_coordinate: BTreeSet<_> =
        matrix.neighbours(coordinate).map(|(other, _)| other).filter(is_other).collect();
    let only_coordinate = of_coordinate.difference(&of_row).count();
    of_row.len() * (of_row.len() + 1) / 2 + of_row.len() * only_coordinate
}
