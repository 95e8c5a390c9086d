//! Inputs that change with time, in a table.

use mbs_runtime::__private::{Segment, Spline};
use mbs_runtime::Real;
use mbs_symbolic::{Beyond, Interpolation};

use crate::Error;

/// The way of an input from instant to instant, and what it is before the first and after the last one.
///
/// The words for both are those of a [table](mbs_runtime::language#tables).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// From instant to instant.
    pub between: Interpolation,
    /// Before the first and after the last instant.
    pub outside: Beyond,
}

impl Default for Way {
    /// Straight lines between instants, and the first and the last value outside of them.
    fn default() -> Self {
        Self { between: Interpolation::Linear, outside: Beyond::Hold }
    }
}

/// Inputs over time.
///
/// # Example
/// ```
/// use mbs_analysis::{Beyond, InputTable, Interpolation, Way};
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
/// // the first one is switched on for the first second of every three, beside it
/// let way = Way { between: Interpolation::Step, outside: Beyond::Periodic };
/// let pulses = InputTable::led(vec![0.0, 1.0, 3.0], vec![(0, vec![9.0, 0.0, 9.0])], way)?;
/// table.with(pulses).set(6.5, &mut inputs);
/// assert_eq!(inputs, [9.0, 5.0]);
///
/// assert!(InputTable::new(vec![1.0, 0.0], vec![(0, vec![0.0, 0.0])]).is_err());
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InputTable {
    /// The instants of all inputs.
    times: Vec<f64>,
    inputs: Vec<Input>,
}

/// An input over time.
#[derive(Clone, Debug, PartialEq)]
struct Input {
    /// Its place in [`Info`](mbs_runtime::Info).
    place: usize,
    curve: Spline<Vec<Segment>>,
    /// The instants at which it has another slope or another value than before, and whether the latter.
    corners: Vec<(f64, bool)>,
}

/// Roundings of an instant, within which a jump may be on either side.
const ROUNDINGS: f64 = 4.0;

impl InputTable {
    /// A table of inputs at ascending times in s, by straight lines; before the first and after the last instant they
    /// stay. A column is the place of an input in [`Info`](mbs_runtime::Info) and its values in SI units, one at
    /// each of the times.
    ///
    /// # Errors
    /// [`Error::Samples`] for times and values that are not finite, for times that do not ascend, and for
    /// columns that are not as long as they.
    pub fn new(times: Vec<f64>, columns: Vec<(usize, Vec<f64>)>) -> Result<Self, Error> {
        Self::led(times, columns, Way::default())
    }

    /// The same with another way of the inputs. See the example of [`InputTable`].
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`Error::Samples`] for instants that are too few for it, and for a periodic input
    /// whose last value is not the first one.
    pub fn led(times: Vec<f64>, columns: Vec<(usize, Vec<f64>)>, way: Way) -> Result<Self, Error> {
        let wrong = |reason| Err(Error::Samples { reason });
        if times.is_empty() || columns.iter().any(|(_, values)| values.len() != times.len()) {
            return wrong("an input needs a value at each of the times, and there is at least one");
        }
        let values = columns.iter().flat_map(|(_, values)| values);
        if times.iter().chain(values).any(|x| !x.is_finite()) {
            return wrong("one is no finite number");
        }
        if !times.is_sorted_by(|before, after| before < after) {
            return wrong("their times have to ascend");
        }
        let input = |(place, values): (usize, Vec<f64>)| Input::new(place, &times, &values, way);
        let inputs = columns.into_iter().map(input).collect::<Result<_, Error>>()?;
        Ok(Self { times, inputs })
    }

    /// The inputs of both tables; an input that both have is that of the other one. See the example of
    /// [`InputTable`].
    #[must_use]
    pub fn with(mut self, other: Self) -> Self {
        self.inputs.retain(|input| other.inputs.iter().all(|theirs| theirs.place != input.place));
        self.inputs.extend(other.inputs);
        self.times.extend(other.times);
        self.times.sort_by(f64::total_cmp);
        self.times.dedup();
        self
    }

    /// The number of instants.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// `true` if the table has no inputs.
    pub fn is_empty(&self) -> bool {
        self.inputs.is_empty()
    }

    /// The first and the last instant in s; 0 for an empty table.
    pub fn span(&self) -> [f64; 2] {
        [self.times.first(), self.times.last()].map(|end| end.copied().unwrap_or(0.0))
    }

    /// Sets the inputs that the table has to their values at the time `t` in s; the others stay. A value that the
    /// table refuses is NaN.
    pub fn set<T: Real>(&self, t: T, inputs: &mut [T]) {
        for input in &self.inputs {
            if let Some(value) = inputs.get_mut(input.place) {
                *value = input.curve.derivative_at(0, t);
            }
        }
    }

    /// The first time after `t`, in s, at which two pieces of an input meet, or right before or right behind a jump;
    /// infinite if there is none.
    pub fn next_corner<T: Real>(&self, t: T) -> T {
        let next = self.inputs.iter().map(|input| input.next_corner(t));
        next.fold(T::from_f64(f64::INFINITY), |first, time| if time < first { time } else { first })
    }
}

impl Input {
    fn new(place: usize, times: &[f64], values: &[f64], way: Way) -> Result<Self, Error> {
        let wrong = |reason| Err(Error::Samples { reason });
        let points: Vec<(f64, f64)> = times.iter().copied().zip(values.iter().copied()).collect();
        let (is_periodic, is_cubic) = (way.outside == Beyond::Periodic, way.between == Interpolation::Cubic);
        let curve = match &*points {
            [(origin, value)] if !is_periodic && way.outside != Beyond::Refuse => {
                let constant = Segment { from: 0.0, coefficients: [*value, 0.0, 0.0, 0.0] };
                let curve = Spline { origin: *origin, period: None, segments: vec![constant] };
                return Ok(Self { place, curve, corners: Vec::new() });
            }
            points if is_periodic && points.len() < if is_cubic { 4 } else { 3 } => {
                return wrong(
                    "a periodic input needs three instants, a cubic one four, the last of which is the first again",
                );
            }
            _ if is_periodic && values.first() != values.last() => {
                return wrong("a periodic input ends with the value that it begins with");
            }
            points => mbs_symbolic::Spline::by_rule("", points, way.between, way.outside),
        };
        let Some(curve) = curve else {
            return wrong(match points.len() {
                1 => "an input that is refused outside of its instants needs two of them",
                _ => "they are too large for a finite slope between them",
            });
        };
        // at the points of a smooth one too, so that nothing between them is stepped over
        let jumps: Vec<f64> =
            curve.corners().into_iter().filter_map(|(at, jumps)| jumps.then_some(at)).collect();
        let points = curve.points().into_iter();
        let mut corners: Vec<_> = points.map(|at| (at, jumps.contains(&at))).collect();
        if way.outside == Beyond::Refuse {
            // a step ends where there is nothing behind it
            corners.extend(times.last().map(|last| (*last, false)));
        }
        let segments =
            curve.segments.iter().map(|it| Segment { from: it.from, coefficients: it.coefficients });
        let segments = segments.collect();
        let curve = Spline { origin: curve.origin, period: curve.period, segments };
        Ok(Self { place, curve, corners })
    }

    /// The first time behind `t` at which two pieces of the input meet, or right before or right behind a jump.
    fn next_corner<T: Real>(&self, t: T) -> T {
        let infinite = T::from_f64(f64::INFINITY);
        let Some((first, _)) = self.corners.first() else { return infinite };
        let period = self.curve.period.unwrap_or_default();
        let turns = if period > 0.0 { ((t.to_f64() - first) / period).floor() } else { 0.0 };
        let sides = |turn: f64, (at, jumps): (f64, bool)| {
            let time = at + turn * period;
            let size = time.abs() + self.curve.origin.abs() + period;
            let width = if jumps { ROUNDINGS * T::EPSILON.to_f64() * size } else { 0.0 };
            [time - width, time, time + width].map(T::from_f64)
        };
        let next = |turn: f64| {
            let behind = self.corners.partition_point(|corner| {
                // a run that begins at a jump begins behind it
                let [_, at, far] = sides(turn, *corner);
                far <= t || at == t
            });
            let sides = self.corners.get(behind).map(|corner| sides(turn, *corner));
            sides.map_or(infinite, |[near, _, far]| if near > t { near } else { far })
        };
        // by rounding a time may belong to the turn before or behind its own
        let times = [turns - 1.0, turns, turns + 1.0].map(next);
        times.into_iter().fold(infinite, |first, time| if time < first { time } else { first })
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

#[cfg(test)]
mod tests {
    use super::*;

    fn value(table: &InputTable, t: f64) -> f64 {
        let mut inputs = [9.0, 9.0];
        table.set(t, &mut inputs);
        assert_eq!(inputs[0], 9.0, "an input that the table does not have stays");
        inputs[1]
    }

    fn corners(table: &InputTable) -> Vec<f64> {
        table.inputs.iter().flat_map(|input| &input.corners).map(|(at, _)| *at).collect()
    }

    fn led(
        times: &[f64],
        values: &[f64],
        between: Interpolation,
        outside: Beyond,
    ) -> Result<InputTable, Error> {
        InputTable::led(times.to_vec(), vec![(1, values.to_vec())], Way { between, outside })
    }

    #[test]
    fn straight_lines_between_instants() {
        let table = InputTable::new(vec![0.0, 1.0, 2.0], vec![(1, vec![0.0, 0.5, 0.5])]).unwrap();
        assert_eq!([-1.0, 0.5, 1.0, 1.5, 9.0].map(|t| value(&table, t)), [0.0, 0.25, 0.5, 0.5, 0.5]);
        assert_eq!(corners(&table), [0.0, 1.0]);
        assert_eq!([-1.0, 0.0, 0.3, 1.0].map(|t| table.next_corner(t)), [0.0, 1.0, 1.0, f64::INFINITY]);
    }

    /// Of a line that was written in many instants only the ends are corners.
    #[test]
    fn a_straight_line_has_no_corner_within() {
        let times: Vec<f64> = (0..=1000).map(|at| f64::from(at) * 1e-3).collect();
        let values = times.iter().map(|t| 0.1 + 0.7 * t).collect();
        assert_eq!(corners(&InputTable::new(times, vec![(0, values)]).unwrap()), [0.0, 1.0]);
    }

    #[test]
    fn ways_from_instant_to_instant() {
        let (times, values) = ([0.0, 0.5, 1.0, 2.0], [0.0, -0.625, -2.0, -4.0]);
        let at = |between| {
            let table = led(&times, &values, between, Beyond::Extend).unwrap();
            [0.25, 1.5, 3.0].map(|t| value(&table, t))
        };
        assert_eq!(at(Interpolation::Linear), [-0.3125, -3.0, -6.0]);
        assert_eq!(at(Interpolation::Step), [0.0, -2.0, -4.0]);
        for between in [Interpolation::Cubic, Interpolation::Monotone] {
            let table = led(&times, &values, between, Beyond::Hold).unwrap();
            for (t, expected) in times.into_iter().zip(values) {
                assert!((value(&table, t) - expected).abs() < 1e-15, "{between:?} {t}");
            }
            assert_eq!([-9.0, 9.0].map(|t| value(&table, t)), [0.0, -4.0]);
        }
    }

    #[test]
    fn rules_for_what_is_outside() {
        let at = |outside, times: [f64; 3]| {
            let table = led(&[1.0, 2.0, 4.0], &[1.0, 3.0, 1.0], Interpolation::Linear, outside).unwrap();
            times.map(|t| value(&table, t))
        };
        assert_eq!(at(Beyond::Hold, [0.0, 3.0, 5.0]), [1.0, 2.0, 1.0]);
        assert_eq!(at(Beyond::Extend, [0.0, 3.0, 5.0]), [-1.0, 2.0, 0.0]);
        assert_eq!(at(Beyond::Periodic, [0.0, 4.5, 300_001.0]), [2.0, 2.0, 1.0]);
        let [before, within, behind] = at(Beyond::Refuse, [0.5, 4.0, 4.1]);
        assert!(before.is_nan() && within == 1.0 && behind.is_nan());
    }

    /// A step ends right before a jump, and the next one, as short as rounding, right behind it.
    #[test]
    fn a_jump_has_two_sides() {
        for (times, offset) in
            [([0.0, 0.3, 1.0], 0.0), ([-1e6, -999_999.7, -999_999.0], 0.0), ([0.0, 0.3, 1.0], 70.0)]
        {
            let table = led(&times, &[5.0, 2.0, 5.0], Interpolation::Step, Beyond::Periodic).unwrap();
            let period = times[2] - times[0];
            let mut t = times[0] + offset * period + 0.1;
            for expected in [times[1], times[2], times[1] + period] {
                let expected = expected + offset * period;
                let near = table.next_corner(t);
                let far = table.next_corner(near);
                assert!(near < expected && expected < far && far - near < 1e-8, "{near} {expected} {far}");
                let [before, behind] = [near, far].map(|t| value(&table, t));
                assert!(before != behind && value(&table, t) == before, "{before} {behind}");
                t = far;
            }
        }
    }

    #[test]
    fn periodic_corners_come_again() {
        let table = led(&[0.5, 1.0, 2.5], &[0.0, 1.0, 0.0], Interpolation::Linear, Beyond::Periodic).unwrap();
        let mut t = -3.0;
        let mut found = Vec::new();
        while found.len() < 6 {
            t = table.next_corner(t);
            found.push(t);
        }
        assert_eq!(found, [-1.5, -1.0, 0.5, 1.0, 2.5, 3.0]);
    }

    #[test]
    fn instants_that_do_not_fit_their_way() {
        let message = |times: &[f64], values: &[f64], between, outside| {
            led(times, values, between, outside).err().unwrap().to_string()
        };
        let few = message(&[0.0, 1.0], &[1.0, 1.0], Interpolation::Linear, Beyond::Periodic);
        assert!(few.contains("three instants"), "{few}");
        let few = message(&[0.0, 1.0, 2.0], &[1.0, 2.0, 1.0], Interpolation::Cubic, Beyond::Periodic);
        assert!(few.contains("cubic one four"), "{few}");
        let open = message(&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0], Interpolation::Step, Beyond::Periodic);
        assert!(open.contains("ends with the value"), "{open}");
        let one = message(&[0.0], &[1.0], Interpolation::Step, Beyond::Refuse);
        assert!(one.contains("needs two"), "{one}");
        assert!(
            message(&[0.0, 1e-300], &[0.0, 1e300], Interpolation::Linear, Beyond::Hold).contains("too large")
        );
        // one instant is a constant
        let constant = led(&[3.0], &[7.0], Interpolation::Cubic, Beyond::Hold).unwrap();
        assert_eq!((value(&constant, 0.0), constant.next_corner(0.0)), (7.0, f64::INFINITY));
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
