//! Inputs that change with time, in a table.

use mbs_runtime::Real;

use crate::Error;

/// Inputs over time: straight lines between instants. Before the first instant and after the last one they are
/// constant.
///
/// # Example
/// ```
/// use mbs_analysis::InputTable;
///
/// // the second input rises from 0 to 5 within 2 s, and stays there
/// let table = InputTable::new(vec![0.0, 2.0, 4.0], vec![(1, vec![0.0, 5.0, 5.0])])?;
/// let mut inputs = [7.0, 7.0];
/// table.set(0.5, &mut inputs);
/// assert_eq!(inputs, [7.0, 1.25]);
/// assert_eq!((table.len(), table.span()), (3, [0.0, 4.0]));
/// assert!(InputTable::default().is_empty());
///
/// // a line has another slope from 2 s on, and no other one later
/// assert_eq!(table.next_corner(0.5), 2.0);
/// assert_eq!(table.next_corner(2.0), f64::INFINITY);
///
/// assert!(InputTable::new(vec![1.0, 0.0], vec![(0, vec![0.0, 0.0])]).is_err());
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InputTable {
    times: Vec<f64>,
    /// The place of an input in [`Info`](mbs_runtime::Info), and its values.
    columns: Vec<(usize, Vec<f64>)>,
    /// The instants at which a line has another slope than the one before it.
    corners: Vec<f64>,
}

/// Slopes that differ by less than this part of the largest change between two instants are one: what numbers
/// of a file leave of a straight line.
const STRAIGHT: f64 = 1e-12;

impl InputTable {
    /// A table of inputs at ascending times in s. A column is the place of an input in [`Info`](mbs_runtime::Info) and its
    /// values in SI units, one at each of the times.
    ///
    /// # Errors
    /// [`Error::Samples`] for times and values that are not finite, for times that do not ascend, and for
    /// columns that are not as long as they.
    pub fn new(times: Vec<f64>, columns: Vec<(usize, Vec<f64>)>) -> Result<Self, Error> {
        let wrong = |reason| Err(Error::Samples { reason });
        if times.is_empty() || columns.iter().any(|(_, values)| values.len() != times.len()) {
            return wrong("an input needs a value at each of the times, and there is at least one");
        }
        let values = columns.iter().flat_map(|(_, values)| values);
        if times.iter().chain(values).any(|x| !x.is_finite()) {
            return wrong("one is no finite number");
        }
        if times.is_sorted_by(|before, after| before < after) {
            let corners = corners(&times, &columns);
            Ok(Self { times, columns, corners })
        } else {
            wrong("their times have to ascend")
        }
    }

    /// The number of instants.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// `true` if the table has no inputs.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// The first and the last instant in s; 0 for an empty table.
    pub fn span(&self) -> [f64; 2] {
        [self.times.first(), self.times.last()].map(|end| end.copied().unwrap_or(0.0))
    }

    /// Sets the inputs that the table has to their values at the time `t` in s; the others stay.
    pub fn set<T: Real>(&self, t: T, inputs: &mut [T]) {
        let behind = self.times.partition_point(|time| *time <= t.to_f64());
        for (place, values) in &self.columns {
            let at =
                |index: usize| Some((T::from_f64(*self.times.get(index)?), T::from_f64(*values.get(index)?)));
            let value = match (behind.checked_sub(1).and_then(at), at(behind)) {
                (Some((t0, x0)), Some((t1, x1))) => x0 + (x1 - x0) * ((t - t0) / (t1 - t0)),
                (Some((_, x)), None) | (None, Some((_, x))) => x,
                (None, None) => continue,
            };
            if let Some(input) = inputs.get_mut(*place) {
                *input = value;
            }
        }
    }

    /// The first time after `t`, in s, at which an input changes its slope; infinite if there is none.
    pub fn next_corner<T: Real>(&self, t: T) -> T {
        let next = self.corners.partition_point(|corner| T::from_f64(*corner) <= t);
        T::from_f64(self.corners.get(next).copied().unwrap_or(f64::INFINITY))
    }
}

/// The start in s of a run that follows a log from `first` to `last` seconds, if the log has a clock of its own: a
/// clock that shows more at the beginning than the log is long.
///
/// # Example
/// ```
/// use mbs_analysis::own_clock;
///
/// assert_eq!(own_clock([0.1, 5.0]), None);
/// assert_eq!(own_clock([1200.0, 1205.0]), Some(1200.0));
/// ```
pub fn own_clock([first, last]: [f64; 2]) -> Option<f64> {
    (last > first && first > last - first).then_some(first)
}

fn corners(times: &[f64], columns: &[(usize, Vec<f64>)]) -> Vec<f64> {
    let has_corner = |values: &[f64], at: usize| {
        // a constant before the first instant and after the last one
        let slope = |from: usize, to: Option<usize>| {
            let to = to.filter(|to| *to < times.len())?;
            Some((values.get(to)? - values.get(from)?) / (times.get(to)? - times.get(from)?))
        };
        let before = at.checked_sub(1).and_then(|from| slope(from, Some(at))).unwrap_or(0.0);
        let after = slope(at, Some(at + 1)).unwrap_or(0.0);
        let largest = before.abs().max(after.abs());
        let change = (after - before).abs();
        // what overflows is a corner as well
        largest > 0.0 && (change > STRAIGHT * largest || change.is_nan())
    };
    let indices = (0..times.len()).filter(|at| columns.iter().any(|(_, values)| has_corner(values, *at)));
    indices.filter_map(|at| times.get(at).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(table: &InputTable, t: f64) -> f64 {
        let mut inputs = [9.0, 9.0];
        table.set(t, &mut inputs);
        assert_eq!(inputs[0], 9.0, "an input that the table does not have stays");
        inputs[1]
    }

    #[test]
    fn straight_lines_between_instants() {
        let table = InputTable::new(vec![0.0, 1.0, 2.0], vec![(1, vec![0.0, 0.5, 0.5])]).unwrap();
        assert_eq!([-1.0, 0.5, 1.0, 1.5, 9.0].map(|t| value(&table, t)), [0.0, 0.25, 0.5, 0.5, 0.5]);
        assert_eq!(table.corners, [0.0, 1.0]);
        assert_eq!([-1.0, 0.0, 0.3, 1.0].map(|t| table.next_corner(t)), [0.0, 1.0, 1.0, f64::INFINITY]);
    }

    /// Of a line that was written in many instants only the ends are corners.
    #[test]
    fn a_straight_line_has_no_corner_within() {
        let times: Vec<f64> = (0..=1000).map(|at| f64::from(at) * 1e-3).collect();
        let values = times.iter().map(|t| 0.1 + 0.7 * t).collect();
        assert_eq!(InputTable::new(times, vec![(0, values)]).unwrap().corners, [0.0, 1.0]);
    }

    #[test]
    fn tables_that_are_none() {
        let message = |times: &[f64], values: &[f64]| {
            InputTable::new(times.to_vec(), vec![(0, values.to_vec())]).err().unwrap().to_string()
        };
        assert!(message(&[], &[]).contains("at least one"));
        assert!(message(&[0.0, 1.0], &[1.0]).contains("a value at each"));
        assert!(message(&[0.0, 1.0], &[1.0, f64::NAN]).contains("finite"));
        assert!(message(&[0.0, 0.0], &[1.0, 2.0]).contains("ascend"));
    }
}
