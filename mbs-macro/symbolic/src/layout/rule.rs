//! Places that go with the copies of a loop.

/// The places that go with the copies of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// first + step·copy, or first − step·copy
    Line {
        /// The place of the first copy.
        first: usize,
        /// The distance from copy to copy.
        step: usize,
        /// True if places fall.
        is_down: bool,
    },
    /// One of the [tables](super::Loop::tables) of the loop, by position.
    Table(usize),
}

impl Rule {
    /// The rule of places; where they have none, they become one of the tables.
    pub(super) fn of(places: Vec<usize>, tables: &mut Vec<Vec<usize>>) -> Self {
        Self::line(&places).unwrap_or_else(|| {
            let known = tables.iter().position(|table| *table == places);
            Self::Table(known.unwrap_or_else(|| {
                tables.push(places);
                tables.len() - 1
            }))
        })
    }

    fn line(places: &[usize]) -> Option<Self> {
        let [first, second, ..] = *places else { return None };
        let (up, down) = (second.saturating_sub(first), first.saturating_sub(second));
        let by_rule = |(copy, place): (usize, &usize)| place + down * copy == first + up * copy;
        let is_line = places.iter().enumerate().all(by_rule);
        is_line.then_some(Self::Line { first, step: up.max(down), is_down: down > 0 })
    }

    /// The place of a copy.
    pub fn at(self, copy: usize, tables: &[Vec<usize>]) -> usize {
        match self {
            Self::Line { first, step, is_down: false } => first + step * copy,
            Self::Line { first, step, is_down: true } => first - step * copy,
            Self::Table(table) => tables[table][copy],
        }
    }
}
