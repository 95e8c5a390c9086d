//! Test whether a run keeps its energy, in a mechanism where nothing changes it.

use mbs_runtime::{Derivation, Info, Quantity};

use crate::Doubt;

/// The change of an energy that nothing changes, as a share of the energy that was in
/// motion, from which on a run is doubted.
const ENERGY: f64 = 1e-2;
/// A mechanism is at rest if no position changes by more than so many roundings in a step: what changes
/// its energy is rounding too.
const AT_REST: f64 = 1024.0;
/// The share of it that forces without a potential may have changed by, for a mechanism
/// to count as one that keeps its energy.
const WORK: f64 = 1e-3;

/// Energies of a run, for a mechanism whose energy nothing changes.
#[derive(Default)]
pub(crate) struct Energy {
    /// The size of the mechanism in m.
    size: f64,
    /// `true` if anything moved by more than rounding in a step.
    has_moved: bool,
    first: Option<f64>,
    last: f64,
    /// The change in the last step.
    change: f64,
    /// The work of all forces in steps that changed the energy, by the power at their ends.
    work: f64,
    kinetic: f64,
    potential: Option<(f64, f64)>,
    /// Of all energy, along the motion that the equations ask for, at some instants.
    powers: Vec<f64>,
}

impl Energy {
    /// That of a mechanism of this size; nothing if something changes it.
    pub fn of(derivation: &Derivation, size: f64) -> Option<Self> {
        derivation.keeps_energy.then(|| Self { size, ..Self::default() })
    }

    /// Takes the energies.
    pub fn see(&mut self, kinetic: f64, potential: f64) {
        let energy = kinetic + potential;
        self.first.get_or_insert(energy);
        self.change = energy - if self.potential.is_some() { self.last } else { energy };
        self.last = energy;
        self.kinetic = self.kinetic.max(kinetic);
        let (low, high) = self.potential.unwrap_or((potential, potential));
        self.potential = Some((low.min(potential), high.max(potential)));
    }

    /// Takes the velocities of a run with steps of `step` seconds.
    pub fn see_motion(&mut self, info: &Info, v: &[f64], step: f64) {
        let scale = |q: &Quantity| if q.dimension.length != 0 { self.size } else { 1.0 };
        let mut speeds = info.coordinates.iter().take(info.lines).zip(v).map(|(q, v)| (v / scale(q)).abs());
        self.has_moved = self.has_moved || !speeds.all(|speed| speed * step <= AT_REST * f64::EPSILON);
    }

    /// Takes the power with which the energy changes according to the equations, at one of the instants that are
    /// spread over the run.
    pub fn see_power(&mut self, power: f64) {
        self.powers.push(power.abs());
    }

    /// `true` if the last step has changed the energy, so that its power is of interest.
    pub fn has_changed(&self) -> bool {
        self.change.abs() > WORK * self.moved()
    }

    /// Takes the power at the end of a step of so many seconds that has changed the energy.
    pub fn see_work(&mut self, power: f64, step: f64) {
        self.work += power * step;
    }

    /// The energy that was in motion.
    fn moved(&self) -> f64 {
        self.kinetic + self.potential.map_or(0.0, |(low, high)| high - low)
    }

    /// The doubt about a run of `span` seconds whose energy changed too much. `None` if the energy is kept, if nothing
    /// moved, or if forces without a potential may have changed it.
    pub fn doubt(mut self, span: f64) -> Option<Doubt> {
        if !self.has_moved {
            return None;
        }
        let (moved, change) = (self.moved(), self.last - self.first?);
        // a stop acts for a moment
        let is_explained = (change - self.work).abs() < 0.5 * change.abs();
        self.powers.sort_by(f64::total_cmp);
        // The median: a pass that goes wrong is short.
        let power = self.powers.get(self.powers.len() / 2).copied().unwrap_or(0.0);
        let is_kept = power * span <= WORK * moved;
        (is_kept && !is_explained && change.abs() > ENERGY * moved).then_some(Doubt::Energy { change, moved })
    }
}
