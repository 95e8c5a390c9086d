//! Pairs that several rows share are computed once.
//!
//! Greedy: the pair that occurs in most rows becomes a value of its own, until
//! none occurs twice. (The problem of the least number of operations is
//! NP-hard; this is the usual heuristic, after Breuer 1969.)

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

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
    rows: BTreeMap<Value, Vec<Signed>>,
    holders: BTreeMap<Pair, BTreeSet<Value>>,
    /// Pairs by their rank; entries may be out of date.
    queue: BinaryHeap<(Rank, Reverse<Pair>)>,
}

fn factor_rows(flat: &mut Flat, kind: &dyn Rows) {
    let mut work = Work { rows: BTreeMap::new(), holders: BTreeMap::new(), queue: BinaryHeap::new() };
    for (value, definition) in flat.definitions.iter().enumerate() {
        if let Some(row) = kind.row(definition) {
            work.insert(value, row);
        }
    }
    while let Some(pair) = work.most_frequent() {
        let members =
            vec![Signed { value: pair.0, negative: false }, Signed { value: pair.1, negative: pair.2 }];
        let common = flat.define(kind.definition(members.clone()));
        if !work.rows.contains_key(&common) {
            work.insert(common, members);
        }
        for holder in work.holders[&pair].clone() {
            if holder != common {
                work.replace(holder, pair, common);
            }
        }
    }
    for (value, row) in work.rows {
        flat.definitions[value] = kind.definition(row);
    }
}

impl Work {
    fn insert(&mut self, value: Value, row: Vec<Signed>) {
        let pairs = pairs(&row);
        self.rows.insert(value, row);
        for pair in pairs {
            self.holders.entry(pair).or_default().insert(value);
            self.queue.push((self.rank(&pair), Reverse(pair)));
        }
    }

    fn rank(&self, pair: &Pair) -> Rank {
        let Some(holders) = self.holders.get(pair) else { return (0, false) };
        let is_whole = |holder: &Value| self.rows.get(holder).is_some_and(|row| row.len() == 2);
        (holders.len(), holders.iter().any(is_whole))
    }

    fn remove(&mut self, value: Value) -> Vec<Signed> {
        let row = self.rows.remove(&value).unwrap_or_default();
        for pair in pairs(&row) {
            if let Some(holders) = self.holders.get_mut(&pair) {
                holders.remove(&value);
                self.queue.push((self.rank(&pair), Reverse(pair)));
            }
        }
        row
    }

    /// The pair with the most holders, two at least.
    fn most_frequent(&mut self) -> Option<Pair> {
        while let Some((rank, Reverse(pair))) = self.queue.pop() {
            if rank.0 >= 2 && self.rank(&pair) == rank {
                return Some(pair);
            }
        }
        None
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

/// The distinct pairs of a row.
fn pairs(row: &[Signed]) -> BTreeSet<Pair> {
    let mut pairs = BTreeSet::new();
    for (at, a) in row.iter().enumerate() {
        for b in &row[at + 1..] {
            pairs.insert((a.value, b.value, a.negative ^ b.negative));
        }
    }
    pairs
}
