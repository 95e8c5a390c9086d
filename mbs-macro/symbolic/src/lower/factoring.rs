//! Pairs that several rows share are computed once.
//!
//! Greedy: the pair that occurs in most rows becomes a value of its own, until
//! none occurs twice. (The problem of the least number of operations is
//! NP-hard; this is the usual heuristic, after Breuer 1969.)

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap as HashMap;

use super::flatten::{Definition, Flat, Signed, Value};

pub(super) fn factor(flat: &mut Flat) {
    factor_rows(flat, &Products);
    factor_rows(flat, &Sums);
}

/// Two members of a row, up to a common sign.
type Pair = (Value, Value, bool);

/// How many rows hold a pair, and whether one of them is nothing else: of two
/// pairs that save the same now, that one leaves the other rows free to share
/// more.
type Rank = (usize, bool);

/// The two kinds of rows.
trait Rows {
    fn row(&self, definition: &Definition) -> Option<Vec<Signed>>;
    fn definition(&self, row: Vec<Signed>) -> Definition;
}

struct Products;
struct Sums;

impl Rows for Products {
    fn row(&self, definition: &Definition) -> Option<Vec<Signed>> {
        let Definition::Product(factors) = definition else { return None };
        Some(factors.iter().map(|&value| Signed { value, negative: false }).collect())
    }

    fn definition(&self, row: Vec<Signed>) -> Definition {
        Definition::Product(row.into_iter().map(|factor| factor.value).collect())
    }
}

impl Rows for Sums {
    fn row(&self, definition: &Definition) -> Option<Vec<Signed>> {
        let Definition::Sum(summands) = definition else { return None };
        Some(summands.clone())
    }

    fn definition(&self, row: Vec<Signed>) -> Definition {
        Definition::Sum(row)
    }
}

/// Rows under work, and which of them contain which pair.
struct Work {
    /// Per value, its row, if it has one.
    rows: Vec<Option<Vec<Signed>>>,
    /// Per value, whether it can be in several rows: it is in two already, or is
    /// a row, which may turn out to be what others have in common.
    can_recur: Vec<bool>,
    holders: HashMap<Pair, Holders>,
    /// Pairs in two rows or more, by their rank; entries may be out of date.
    queue: BinaryHeap<(Rank, Reverse<Pair>)>,
}

/// The rows that hold a pair.
#[derive(Default)]
struct Holders {
    rows: Vec<Value>,
    /// How many of them are nothing else.
    whole: usize,
}

impl Holders {
    fn rank(&self) -> Rank {
        (self.rows.len(), self.whole > 0)
    }
}

fn factor_rows(flat: &mut Flat, kind: &dyn Rows) {
    let rows: Vec<_> = flat.definitions.iter().map(|definition| kind.row(definition)).collect();
    let mut work = Work {
        can_recur: can_recur(&rows),
        rows: vec![None; rows.len()],
        holders: HashMap::default(),
        queue: BinaryHeap::new(),
    };
    for (value, row) in rows.into_iter().enumerate() {
        if let Some(row) = row {
            work.insert(value, row);
        }
    }
    while let Some((pair, holders)) = work.most_frequent() {
        let members =
            vec![Signed { value: pair.0, negative: false }, Signed { value: pair.1, negative: pair.2 }];
        let common = flat.define(kind.definition(members.clone()));
        work.rows.resize(flat.definitions.len(), None);
        work.can_recur.resize(flat.definitions.len(), true);
        for holder in holders {
            if holder != common {
                work.replace(holder, pair, common);
            }
        }
        // it holds the pair too, whether it was a row before or not
        work.rows[common] = None;
        work.insert(common, members);
    }
    for (value, row) in work.rows.into_iter().enumerate() {
        if let Some(row) = row {
            flat.definitions[value] = kind.definition(row);
        }
    }
}

fn can_recur(rows: &[Option<Vec<Signed>>]) -> Vec<bool> {
    let mut last_holder = vec![None; rows.len()];
    let mut can_recur: Vec<bool> = rows.iter().map(Option::is_some).collect();
    for (at, row) in rows.iter().enumerate() {
        for member in row.iter().flatten() {
            let last = last_holder[member.value].replace(at);
            can_recur[member.value] |= last.is_some_and(|last| last != at);
        }
    }
    can_recur
}

impl Work {
    fn insert(&mut self, value: Value, row: Vec<Signed>) {
        for pair in self.pairs(&row) {
            let holders = self.holders.entry(pair).or_default();
            holders.rows.push(value);
            holders.whole += usize::from(row.len() == 2);
            if holders.rows.len() >= 2 {
                self.queue.push((holders.rank(), Reverse(pair)));
            }
        }
        self.rows[value] = Some(row);
    }

    fn remove(&mut self, value: Value) -> Vec<Signed> {
        let row = self.rows[value].take().unwrap_or_default();
        for pair in self.pairs(&row) {
            let Some(holders) = self.holders.get_mut(&pair) else { continue };
            let Some(at) = holders.rows.iter().position(|holder| *holder == value) else { continue };
            holders.rows.swap_remove(at);
            holders.whole -= usize::from(row.len() == 2);
            if holders.rows.len() >= 2 {
                self.queue.push((holders.rank(), Reverse(pair)));
            }
        }
        row
    }

    /// The pair with the most holders, two at least, and these.
    fn most_frequent(&mut self) -> Option<(Pair, Vec<Value>)> {
        while let Some((rank, Reverse(pair))) = self.queue.pop() {
            if self.holders.get(&pair).is_some_and(|holders| holders.rank() == rank) {
                let Holders { rows, .. } = self.holders.remove(&pair)?;
                return Some((pair, rows));
            }
        }
        None
    }

    /// The distinct pairs of a row that can be in others.
    fn pairs(&self, row: &[Signed]) -> Vec<Pair> {
        let members: Vec<&Signed> = row.iter().filter(|member| self.can_recur[member.value]).collect();
        let mut pairs = Vec::with_capacity(members.len() * members.len().saturating_sub(1) / 2);
        for (at, a) in members.iter().enumerate() {
            pairs.extend(members[at + 1..].iter().map(|b| (a.value, b.value, a.negative ^ b.negative)));
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Puts `common` in the place of the pair in one row.
    fn replace(&mut self, holder: Value, (a, b, opposite): Pair, common: Value) {
        let mut row = self.remove(holder);
        let Some(first) = row.iter().position(|member| member.value == a) else {
            return self.insert(holder, row);
        };
        let negative = row.remove(first).negative;
        match row.iter().position(|m| m.value == b && (m.negative ^ negative) == opposite) {
            Some(second) => {
                row.remove(second);
                row.push(Signed { value: common, negative });
            }
            // The pair needs another occurrence of `a`, which a sum never has.
            None => row.push(Signed { value: a, negative }),
        }
        row.sort_unstable();
        self.insert(holder, row);
    }
}
