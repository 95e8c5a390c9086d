//! Reasons not to trust the numbers of a run that did not fail.
//!
//! `energy.rs` and `resolution.rs` find two of them: a changed energy, and steps that are too long for the
//! forces.

use std::fmt;

use mbs_runtime::{Derivation, Dimension, Info, Sketch, WorstPlace};

use crate::Column;
use crate::energy::Energy;
use crate::number::significant;
use crate::unit::Unit;

/// The violation of a constraint, as a share of the size of the mechanism (for angles, of a radian), from
/// which on a run is doubted. A gap in a joint is then visible.
const VIOLATION: f64 = 1e-3;
/// Decimal digits below which a run is doubted. Half of those of a double: an error of that
/// size grows in motions that are sensitive, and nothing else tells of it.
pub(crate) const DIGITS: f64 = 8.0;
/// A reason not to trust the numbers of a run, although it did not fail.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// A joint or another constraint came apart.
    Violation {
        /// The constraint.
        constraint: &'static str,
        /// Its largest violation, in SI units.
        value: f64,
        /// The unit of the violation.
        unit: String,
        /// The time of the largest violation, in s.
        at: f64,
        /// The size of the mechanism at the start in m.
        size: f64,
    },
    /// The energy changed although neither a force nor a drive changes it.
    Energy {
        /// By how much it changed, in J.
        change: f64,
        /// How much was in motion, in J.
        moved: f64,
    },
    /// The run passed so near to a singular position that few digits were left.
    Digits {
        /// How many decimal digits the accelerations of the worst step had.
        left: f64,
        /// When that was, in s.
        at: f64,
        /// The constraint or the coordinate that lost them; empty if none is to blame.
        name: &'static str,
    },
    /// Constant steps were too long for the forces, so that deviations grew that die away in truth.
    Unstable {
        /// The coordinate that moves fastest.
        coordinate: &'static str,
        /// The time at which that was seen, in s.
        at: f64,
        /// The step, in s.
        step: f64,
        /// The time within which the forces act, in s.
        within: f64,
        /// A step that would have been stable, in s.
        longest: f64,
    },
    /// Constant steps were too long for the motion.
    Coarse {
        /// The coordinate whose rate was off most.
        coordinate: &'static str,
        /// The time at which it was, in s.
        at: f64,
        /// The step, in s.
        step: f64,
        /// The error of one step, as a share of the fastest motion.
        share: f64,
    },
    /// A state of the mechanism's own was as small as the absolute error that every step might have.
    Small {
        /// The state.
        state: &'static str,
        /// Its unit.
        unit: &'static str,
        /// Its largest value, in this unit.
        largest: f64,
        /// The absolute tolerance of the run.
        atol: f64,
    },
    /// A quantity was not a number, or infinite.
    NotFinite {
        /// The quantity.
        name: String,
        /// Its first value that was not finite.
        value: f64,
        /// The time of that value, in s.
        at: f64,
    },
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = |x: f64| significant(x, 3);
        match self {
            Self::Violation { constraint, value, unit, at, size } => write!(
                f,
                "the constraint `{constraint}` was violated by {} {unit} at t = {} s (the mechanism measures {} m); \
                 its parts came apart, so the results are not to be trusted: try a smaller --step",
                digits(*value),
                digits(*at),
                digits(*size)
            ),
            Self::Energy { change, moved } => write!(
                f,
                "the energy changed by {} J although no force, drive or damper changes it ({} J were in motion): \
                 a smaller --step shows whether the run went through a singular position",
                digits(*change),
                digits(*moved)
            ),
            Self::Digits { left, at, name } => {
                let whose = if name.is_empty() { String::new() } else { format!(" of `{name}`") };
                write!(
                    f,
                    "only {left:.0} digits{whose} were left at t = {} s, near a singular position: what follows may \
                     depend on the step; compare with another --step",
                    digits(*at)
                )
            }
            Self::Unstable { coordinate, at, step, within, longest } => write!(
                f,
                "steps of {} s are too long for the forces along `{coordinate}`, which act within {} s at t = {} s: \
                 what should die away grows from step to step; take a run to a tolerance (--rtol 1e-6), --step {}, \
                 or --method trbdf2 for stiff forces",
                digits(*step),
                digits(*within),
                digits(*at),
                plain(*longest)
            ),
            Self::Coarse { coordinate, at, step, share } => write!(
                f,
                "a step of {} s is off by {} % of the fastest motion at t = {} s, along `{coordinate}`: steps are too \
                 long for the motion; take a run to a tolerance (--rtol 1e-6), or compare with a smaller --step",
                digits(*step),
                significant(100.0 * share, 2),
                digits(*at)
            ),
            Self::Small { state, unit, largest, atol } => write!(
                f,
                "the state `{state}` is at most {largest:.1e} {unit}, and the absolute tolerance is {atol:.1e} {unit}: its \
                 digits are not to be trusted; declare it in a smaller unit, or give --atol {:.0e}",
                1e-6 * largest
            ),
            Self::NotFinite { name, value, at } => {
                write!(f, "`{name}` is {value} from t = {} s on", digits(*at))
            }
        }
    }
}

/// A step of at most so many seconds that a person can type: `0.04ms`.
fn plain(step: f64) -> String {
    let power = 10_f64.powf(step.log10().floor());
    // to one digit, down
    let rounded = (step / power).floor().max(1.0) * power;
    if rounded >= 1e-6 { format!("{}ms", significant(1e3 * rounded, 1)) } else { format!("{rounded:.0e}") }
}

/// States of a mechanism's own that are lost in the absolute tolerance of a run which recorded these columns: their
/// largest value is below ten times it, and more than a rounding of it.
pub(crate) fn small_states<'a>(
    info: &'static Info,
    columns: &'a [Column],
    atol: f64,
) -> impl Iterator<Item = Doubt> + 'a {
    let own = info.coordinates.iter().enumerate().skip(info.lines);
    own.filter_map(move |(at, quantity)| {
        // behind the time and the positions
        let column = columns.get(1 + info.coordinates.len() + at)?;
        let largest = column.values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let largest = Unit::of(quantity).read(largest) / quantity.scale;
        let is_small = (1e-6 * atol..10.0 * atol).contains(&largest);
        is_small.then_some(Doubt::Small { state: quantity.name, unit: quantity.unit, largest, atol })
    })
}

/// A watch over the constraints and the energy during a run.
pub(crate) struct Watch {
    rows: Vec<Row>,
    /// Extent of the mechanism at the start in m.
    size: f64,
    energy: Option<Energy>,
}

struct Row {
    constraint: &'static str,
    unit: String,
    /// The violation from which on it counts; infinite where nothing is known to compare with.
    limit: f64,
    worst: f64,
    at: f64,
}

impl Watch {
    /// For a mechanism of this [size].
    pub fn new(info: &'static Info, derivation: &'static Derivation, size: f64) -> Self {
        let row = |constraint: &mbs_runtime::Constraint| {
            let unit = Unit::si(constraint.dimension);
            let unit = if unit.name().is_empty() { "rad".to_owned() } else { unit.name().to_owned() };
            let limit = match constraint.dimension {
                of if of == Dimension::of(0, of.length, 0) => VIOLATION * size.powi(i32::from(of.length)),
                _ => f64::INFINITY,
            };
            Row { constraint: constraint.name, unit, limit, worst: 0.0, at: 0.0 }
        };
        let rows = info.constraints.iter().map(row).collect();
        Self { rows, size, energy: Energy::of(derivation, size) }
    }

    /// Takes Φ.
    pub fn see_constraints(&mut self, t: f64, phi: &[f64]) {
        for (row, phi) in self.rows.iter_mut().zip(phi) {
            if phi.abs() > row.worst {
                (row.worst, row.at) = (phi.abs(), t);
            }
        }
    }

    /// The watched energy. `None` if constraints or forces may change it.
    pub fn energy(&mut self) -> Option<&mut Energy> {
        self.energy.as_mut()
    }

    /// The reasons to doubt a run that recorded these columns, time first.
    pub fn doubts(self, columns: &[Column]) -> Vec<Doubt> {
        let size = self.size;
        let worst = self
            .rows
            .into_iter()
            .filter(|row| row.worst > row.limit)
            .max_by(|a, b| (a.worst / a.limit).total_cmp(&(b.worst / b.limit)));
        let violation = worst.map(|Row { constraint, unit, worst, at, .. }| Doubt::Violation {
            constraint,
            value: worst,
            unit,
            at,
            size,
        });
        let times = columns.first().map_or(&[][..], |time| &time.values);
        let span = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
        let energy = self.energy.and_then(|energy| energy.doubt(span));
        violation.into_iter().chain(energy).chain(not_finite(columns)).collect()
    }
}

/// Diagonal of the box around the points of bodies and ground in m; 1 m if that is nothing.
pub(crate) fn size(sketch: &Sketch, places: &[[f64; 2]]) -> f64 {
    let points = || sketch.bodies.iter().flat_map(|body| body.points).chain(sketch.ground);
    let extent = |axis: usize| {
        let place = |point: &usize| places.get(*point).map(|place| place[axis]);
        let values = || points().filter_map(place).filter(|x| x.is_finite());
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let diagonal = extent(0).hypot(extent(1));
    if diagonal > 0.0 && diagonal.is_finite() { diagonal } else { 1.0 }
}

/// A doubt where the worst step of a run had fewer digits than a motion can be trusted with.
pub(crate) fn few_digits(left: f64, place: Option<WorstPlace>) -> Option<Doubt> {
    let WorstPlace { t, constraint, coordinate } = place.filter(|_| left < DIGITS)?;
    let name = if constraint.is_empty() { coordinate } else { constraint };
    Some(Doubt::Digits { left, at: t, name })
}

/// The columns that were not numbers throughout.
fn not_finite(columns: &[Column]) -> impl Iterator<Item = Doubt> {
    let times = columns.first().map_or(&[][..], |time| &time.values);
    columns.iter().filter_map(|column| {
        let (row, value) = column.values.iter().enumerate().find(|(_, x)| !x.is_finite())?;
        let at = times.get(row).copied().unwrap_or(f64::NAN);
        Some(Doubt::NotFinite { name: column.name.clone(), value: *value, at })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pass_that_leaves_few_digits() {
        let place = WorstPlace { t: 0.25, constraint: "rod", coordinate: "x" };
        assert_eq!(few_digits(8.5, Some(place)), None);
        let doubt = few_digits(4.2, Some(place)).unwrap();
        assert_eq!(doubt, Doubt::Digits { left: 4.2, at: 0.25, name: "rod" });
        assert!(doubt.to_string().starts_with("only 4 digits of `rod` were left at t = 0.25 s"), "{doubt}");
    }
}
