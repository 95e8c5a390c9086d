//! Pairs that several rows share are computed once.
//!
//! Greedy: the pair that occurs in most rows becomes a value of its own, until
//! none occurs twice. (The problem of the least number of operations is
//! NP-hard; this is the usual heuristic, after Breuer 1969.)

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap as HashMap;

use super::flatten::{Definition, Flat, Signed, Value, without_opposites};
use crate::inconsistency::Inconsistency;

pub(super) fn factor(flat: &mut Flat) -> Result<(), Inconsistency> {
    factor_rows(flat, &Products)?;
    factor_rows(flat, &Sums)
}

/// Why there is no end to be seen.
const ENDLESS: Inconsistency =
    Inconsistency { pass: "factoring", rule: "every pair that is taken spares an operation" };

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
    /// The operations of the rows. A row takes one operation less than it has members.
    operations: usize,
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

fn factor_rows(flat: &mut Flat, kind: &dyn Rows) -> Result<(), Inconsistency> {
    let rows: Vec<_> = flat.definitions.iter().map(|definition| kind.row(definition)).collect();
    let mut work = Work {
        can_recur: can_recur(&rows),
        rows: vec![None; rows.len()],
        holders: HashMap::default(),
        queue: BinaryHeap::new(),
        operations: 0,
    };
    for (value, row) in rows.into_iter().enumerate() {
        if let Some(row) = row {
            work.insert(value, row);
        }
    }
    // Operations fall: a pair costs one, and spares one in each row that holds it, of
    // which there are two or more.
    while let Some((pair, holders)) = work.most_frequent() {
        let before = work.operations;
        let members =
            vec![Signed { value: pair.0, negative: false }, Signed { value: pair.1, negative: pair.2 }];
        let common = flat.define(kind.definition(members.clone()));
        work.rows.resize(flat.definitions.len(), None);
        work.can_recur.resize(flat.definitions.len(), true);
        for holder in holders {
            if holder != common {
                work.replace(holder, pair, common)?;
            }
        }
        // it holds the pair too, whether it was a row before or not
        work.remove(common);
        work.insert(common, members);
        if work.operations >= before {
            return Err(ENDLESS);
        }
    }
    for (value, row) in work.rows.into_iter().enumerate() {
        if let Some(row) = row {
            flat.definitions[value] = kind.definition(row);
        }
    }
    Ok(())
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
        for pair in self.pairs(&row, |_| true) {
            self.enter(pair, value, row.len() == 2);
        }
        self.operations += row.len().saturating_sub(1);
        self.rows[value] = Some(row);
    }

    /// Takes a row out; `None` of a value that has none.
    fn remove(&mut self, value: Value) -> Option<Vec<Signed>> {
        let row = self.rows[value].take()?;
        self.operations -= row.len().saturating_sub(1);
        for pair in self.pairs(&row, |_| true) {
            self.leave(pair, value, row.len() == 2);
        }
        Some(row)
    }

    /// A row holds a pair.
    fn enter(&mut self, pair: Pair, row: Value, is_whole: bool) {
        let holders = self.holders.entry(pair).or_default();
        holders.rows.push(row);
        holders.whole += usize::from(is_whole);
        if holders.rows.len() >= 2 {
            self.queue.push((holders.rank(), Reverse(pair)));
        }
    }

    /// A row does not hold a pair any more.
    fn leave(&mut self, pair: Pair, row: Value, is_whole: bool) {
        let Some(holders) = self.holders.get_mut(&pair) else { return };
        let Some(at) = holders.rows.iter().position(|holder| *holder == row) else { return };
        holders.rows.swap_remove(at);
        holders.whole -= usize::from(is_whole);
        if holders.rows.len() >= 2 {
            self.queue.push((holders.rank(), Reverse(pair)));
        }
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

    /// The distinct pairs of a row that can be in others and have a member that is asked
    /// for.
    fn pairs(&self, row: &[Signed], is_asked_for: impl Fn(Value) -> bool) -> Vec<Pair> {
        let members: Vec<(&Signed, bool)> = row
            .iter()
            .filter(|member| self.can_recur[member.value])
            .map(|member| (member, is_asked_for(member.value)))
            .collect();
        let mut pairs = Vec::new();
        for (at, (a, of_a)) in members.iter().enumerate() {
            let others = members[at + 1..].iter().filter(|(_, of_b)| *of_a || *of_b);
            pairs.extend(others.map(|(b, _)| (a.value, b.value, a.negative ^ b.negative)));
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Puts `common` in the place of the pair in one row. A row has each value with one
    /// sign alone, so that any occurrence of `a` goes with any of `b`.
    fn replace(&mut self, holder: Value, (a, b, opposite): Pair, common: Value) -> Result<(), Inconsistency> {
        let row = self.rows[holder].take().ok_or(ENDLESS)?;
        let mut rest = row.clone();
        let first = rest.iter().position(|member| member.value == a).ok_or(ENDLESS)?;
        let negative = rest.remove(first).negative;
        let is_other = |member: &Signed| member.value == b && (member.negative ^ negative) == opposite;
        let second = rest.iter().position(is_other).ok_or(ENDLESS)?;
        rest.remove(second);
        rest.push(Signed { value: common, negative });
        // the row may have had the negative of the pair as a member already
        let replaced = without_opposites(rest);
        self.operations -= row.len().saturating_sub(1);
        self.operations += replaced.len().saturating_sub(1);
        // Pairs of other members stay; or one of them is all that is left.
        let is_changed = |value| replaced.len() == 2 || [a, b, common].contains(&value);
        for pair in self.pairs(&row, is_changed) {
            self.leave(pair, holder, row.len() == 2);
        }
        for pair in self.pairs(&replaced, is_changed) {
            self.enter(pair, holder, replaced.len() == 2);
        }
        self.rows[holder] = Some(replaced);
        Ok(())
    }
}
