//! Reasons not to trust the numbers of a run that did not fail.

use std::fmt;

use mbs_runtime::{Derivation, Dimension, Info, Sketch, WorstPlace};

use crate::Column;
use crate::number::significant;
use crate::unit::Unit;

/// The violation of a constraint, as a share of the size of the mechanism (for angles, of
/// a radian), from which on a run is doubted. What joints leave open is then visible.
const VIOLATION: f64 = 1e-3;
/// The change of an energy that nothing changes, as a share of the energy that was in
/// motion, from which on a run is doubted.
const ENERGY: f64 = 1e-2;
/// Decimal digits below which a run is doubted. Half of those of a double: an error of that
/// size grows in motions that are sensitive, and nothing else tells of it.
const DIGITS: f64 = 8.0;
/// The share of it that forces without a potential may have changed by, for a mechanism
/// to count as one that keeps its energy.
const WORK: f64 = 1e-3;

/// A reason not to trust the numbers of a run, although it did not fail.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// A joint or another constraint came apart.
    Violation {
        /// The constraint.
        constraint: &'static str,
        /// Its largest violation in SI units,
        value: f64,
        /// the unit,
        unit: String,
        /// and when that was, in s.
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
    /// A quantity was not a number, or infinite.
    NotFinite {
        /// The quantity.
        name: String,
        /// What it was.
        value: f64,
        /// Since when, in s.
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
            Self::NotFinite { name, value, at } => {
                write!(f, "`{name}` is {value} from t = {} s on", digits(*at))
            }
        }
    }
}

/// What is watched during a run.
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

#[derive(Default)]
struct Energy {
    first: Option<f64>,
    last: f64,
    kinetic: f64,
    potential: Option<(f64, f64)>,
    /// Of all energy, along the motion that the equations ask for, at some instants.
    powers: Vec<f64>,
}

impl Watch {
    /// For a mechanism of this [size].
    pub fn new(info: &'static Info, derivation: &'static Derivation, size: f64) -> Self {
        let row = |constraint: &mbs_runtime::Constraint| {
            let unit = Unit::si(constraint.dimension);
            let unit = if unit.name().is_empty() { "rad".to_owned() } else { unit.name().to_owned() };
            let limit = match constraint.dimension {
                Dimension { mass: 0, length, time: 0 } => VIOLATION * size.powi(i32::from(length)),
                _ => f64::INFINITY,
            };
            Row { constraint: constraint.name, unit, limit, worst: 0.0, at: 0.0 }
        };
        let rows = info.constraints.iter().map(row).collect();
        Self { rows, size, energy: keeps_energy(info, derivation).then(Energy::default) }
    }

    /// Takes Φ.
    pub fn see_constraints(&mut self, t: f64, phi: &[f64]) {
        for (row, phi) in self.rows.iter_mut().zip(phi) {
            if phi.abs() > row.worst {
                (row.worst, row.at) = (phi.abs(), t);
            }
        }
    }

    /// Whether energies are worth computing.
    pub fn wants_energy(&self) -> bool {
        self.energy.is_some()
    }

    /// Takes the energies.
    pub fn see_energy(&mut self, kinetic: f64, potential: f64) {
        let Some(energy) = &mut self.energy else { return };
        energy.first.get_or_insert(kinetic + potential);
        energy.last = kinetic + potential;
        energy.kinetic = energy.kinetic.max(kinetic);
        let (low, high) = energy.potential.unwrap_or((potential, potential));
        energy.potential = Some((low.min(potential), high.max(potential)));
    }

    /// Takes the power with which the energy changes according to the equations.
    pub fn see_power(&mut self, power: f64) {
        if let Some(energy) = &mut self.energy {
            energy.powers.push(power.abs());
        }
    }

    /// What is to be doubted after a run that recorded these columns, time first.
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

impl Energy {
    fn doubt(mut self, span: f64) -> Option<Doubt> {
        let (low, high) = self.potential?;
        let moved = self.kinetic + (high - low);
        let change = self.last - self.first?;
        self.powers.sort_by(f64::total_cmp);
        // The median: a pass that goes wrong is short.
        let power = self.powers.get(self.powers.len() / 2).copied().unwrap_or(0.0);
        let is_kept = power * span <= WORK * moved;
        (is_kept && change.abs() > ENERGY * moved).then_some(Doubt::Energy { change, moved })
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

/// Whether neither constraints nor forces depend on time, on velocities or on inputs.
/// Forces that depend on places alone may still have no potential.
fn keeps_energy(info: &Info, derivation: &Derivation) -> bool {
    let changes_it = |word: &str| {
        matches!(word, "t" | "der" | "lambda") || info.inputs.iter().any(|input| input.name == word)
    };
    let words = |text: &'static str| text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    derivation.phi_t.is_empty() && !derivation.forces.iter().any(|force| words(force.text).any(changes_it))
}

/// Whether the worst step of a run had fewer digits than a motion can be trusted with.
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
    use crate::{Settings, model};

    mbs_runtime::mechanism! {
        /// A weight on a rod.
        pub Swing {
            dof = 1;
            gravity = (0, -9.81) [m/s^2];
            body bob (x, y) { mass = 1 [kg]; }
            constraint rod: x^2 + y^2 = 1 [m^2];
            start { x = 1 [m]; guess y = 0; }
        }
    }

    mbs_runtime::mechanism! {
        /// A weight on a spring.
        pub Bouncer {
            dof = 1;
            body bob (x) { mass = 1 [kg]; }
            spring s (bob, ground) { stiffness = 400 [N/m]; length = 1 [m]; }
            start { x = 1.1 [m]; }
            /// A number for half a second.
            output left = sqrt(1 - 2*t/(1 [s]));
        }
    }

    mbs_runtime::mechanism! {
        pub Damped {
            dof = 1;
            body bob (x) { mass = 1 [kg]; }
            spring s (bob, ground) { stiffness = 400 [N/m]; length = 1 [m]; damping = 4 [N*s/m]; }
            start { x = 1.1 [m]; }
        }
    }

    mbs_runtime::mechanism! {
        pub Pushed {
            dof = 1;
            body bob (x) { mass = 1 [kg]; }
            force push on bob = (1 [N], 0);
            start { x = 1.1 [m]; }
        }
    }

    fn doubts<M: mbs_runtime::Mechanism<Real = f64>>(settings: Settings) -> Vec<Doubt> {
        model::of::<M>().simulate(&settings, &mut |_, _| ()).unwrap().doubts
    }

    fn settings(step: f64, end: f64) -> Settings {
        Settings { step, end, ..Settings::default() }
    }

    #[test]
    fn a_joint_that_comes_apart() {
        assert!(doubts::<Swing>(settings(1e-3, 5.0)).is_empty());
        let coarse = doubts::<Swing>(settings(0.1, 5.0));
        let Some(Doubt::Violation { constraint: "rod", value, size, .. }) = coarse.first() else {
            panic!("{coarse:?}")
        };
        assert!(*value > 1e-3 && *size == 1.0, "{coarse:?}");
    }

    #[test]
    fn an_energy_that_nothing_changes() {
        assert!(doubts::<Bouncer>(settings(1e-3, 0.4)).is_empty());
        // Heun's method gains energy where ωh is large; a damper takes it away.
        let coarse = doubts::<Bouncer>(settings(20e-3, 0.4));
        assert!(matches!(coarse.as_slice(), [Doubt::Energy { change, .. }] if *change > 0.0), "{coarse:?}");
        assert!(doubts::<Damped>(settings(20e-3, 0.4)).is_empty());
        // Nor is it kept where a force without a potential acts.
        assert!(doubts::<Pushed>(settings(20e-3, 0.4)).is_empty());
    }

    #[test]
    fn a_pass_that_leaves_few_digits() {
        let place = WorstPlace { t: 0.25, constraint: "rod", coordinate: "x" };
        assert_eq!(few_digits(8.5, Some(place)), None);
        let doubt = few_digits(4.2, Some(place)).unwrap();
        assert_eq!(doubt, Doubt::Digits { left: 4.2, at: 0.25, name: "rod" });
        assert!(doubt.to_string().starts_with("only 4 digits of `rod` were left at t = 0.25 s"), "{doubt}");
    }

    #[test]
    fn a_value_that_is_no_number() {
        let doubts = doubts::<Bouncer>(settings(1e-3, 1.0));
        let [Doubt::NotFinite { name, value, at }] = doubts.as_slice() else { panic!("{doubts:?}") };
        assert!(name == "left" && value.is_nan() && (0.5..0.502).contains(at), "{doubts:?}");
        assert!(doubts[0].to_string().starts_with("`left` is NaN from t = 0.5"), "{}", doubts[0]);
    }
}
