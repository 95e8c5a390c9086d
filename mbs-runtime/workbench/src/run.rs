//! Runs of a mechanism, recorded.

use mbs_analysis::Signal;
use mbs_runtime::equations::At;
use mbs_runtime::{Info, System};

use crate::digits::Reactions;
use crate::doubt::{Watch, few_digits, size, small_states};
use crate::instant::Instant;
use crate::model::Model;
use crate::notes::{end_note, notes};
use crate::recording::{MOST_OCCURRENCES, Recording, Summary, columns, memories};
use crate::resolution::Resolution;
use crate::settings::{Settings, Start, StartKind};
use crate::until::{Ending, Unmet};
use crate::{Column, Error, Motion, Occurrence, Unit, Until, picture};

/// More rows than this are refused, before they fill the memory.
const MAX_ROWS: u64 = 5_000_000;
/// Instants at which the power is looked at.
const POWERS: u64 = 100;

/// A coordinate, its rate or an own state at the start of a run, in the unit in which it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct StartValue {
    /// The coordinate, or `der(…)` of it.
    pub name: String,
    /// As it is declared, guesses included.
    pub declared: f64,
    /// As it starts.
    pub kept: f64,
    /// Its unit.
    pub unit: String,
}

impl dyn Model + '_ {
    /// The declared start, and what the constraints make of it.
    ///
    /// # Errors
    /// A start that cannot be made consistent.
    pub fn start_values(&self) -> Result<Vec<StartValue>, Error> {
        self.start_values_with(&self.defaults())
    }

    /// The same with other parameters.
    ///
    /// # Errors
    /// As [`start_values`](Model#method.start_values).
    pub(crate) fn start_values_with(&self, settings: &Settings) -> Result<Vec<StartValue>, Error> {
        let info = self.info();
        let declared = Start { kind: StartKind::Declared, ..Start::of(self, settings)? };
        let kept = Start { kind: StartKind::Consistent, ..declared.clone() };
        let n = info.coordinates.len();
        let state = |start: &Start| -> Result<Vec<f64>, Error> {
            let run = self.start(start)?;
            let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
            run.state(&mut q, &mut v);
            q.append(&mut v);
            Ok(q)
        };
        let values = state(&declared)?.into_iter().zip(state(&kept)?);
        let value = |(signal, (declared, kept)): (Signal, (f64, f64))| {
            let unit = Unit::of_signal(info, &signal);
            let [declared, kept] = [declared, kept].map(|value| unit.shown(value));
            StartValue { name: signal.name, declared, kept, unit: unit.name().to_owned() }
        };
        Ok(Signal::states(info).into_iter().zip(values).map(value).collect())
    }

    /// Runs a simulation. `progress` is called now and then with the steps
    /// taken and the steps in all.
    ///
    /// A run that fails on its way is no error here: [`Recording::ended`] says
    /// why, and the rows up to there are kept.
    ///
    /// # Errors
    /// Settings that the mechanism does not have or refuses.
    pub fn simulate(
        &self,
        settings: &Settings,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<Recording, Error> {
        self.simulate_while(settings, &mut |taken, steps| {
            progress(taken, steps);
            true
        })
    }

    /// The same, as long as `goes_on` says so; it is asked now and then. A run that is interrupted ends there, and
    /// is no error: [`Summary::end`] says when.
    ///
    /// # Errors
    /// As [`simulate`](Model#method.simulate).
    pub fn simulate_while(
        &self,
        settings: &Settings,
        goes_on: &mut dyn FnMut(u64, u64) -> bool,
    ) -> Result<Recording, Error> {
        let info = self.info();
        let start = Start::of(self, settings)?;
        let mut run = self.start(&start)?;
        let steps = run.ends_at(settings.end)?;
        let every = settings.every.max(1);
        if steps / every > MAX_ROWS {
            return Err(Error::TooManyRows { rows: steps / every, every: 1 + steps / MAX_ROWS });
        }
        let mut recorder = Recorder::new(self, &*run, settings.until.as_ref());
        recorder.resolution = Resolution::new(info, &start, recorder.size, steps);
        let notes = notes(self, settings).into_iter().chain(end_note(&*run, steps, settings.end)).collect();
        let ended = recorder.follow(&mut *run, [steps, every], goes_on).err();
        let mut recording = Recording { notes, ..recorder.finish(&*run, ended) };
        if let Some(tolerances) = start.tolerances {
            recording.doubts.extend(small_states(info, &recording.columns, tolerances.atol));
        }
        Ok(recording)
    }

    /// Where the points of the mechanism were during a run with these settings,
    /// at some of the recorded instants.
    ///
    /// # Errors
    /// Settings that the mechanism does not have or refuses.
    pub fn motion(&self, settings: &Settings, recording: &Recording) -> Result<Motion, Error> {
        let start = Start { kind: StartKind::Declared, ..Start::of(self, settings)? };
        let run = self.start(&start)?;
        let sketch = self.sketch();
        let mut columns = recording.columns.iter().map(|column| column.values.as_slice());
        let time = columns.next().unwrap_or_default();
        let states = Signal::states(self.info());
        let units = states.iter().map(|signal| Unit::of_signal(self.info(), signal));
        let coordinates: Vec<(&[f64], Unit)> = columns.zip(units).take(recording.coordinates).collect();
        let mut motion = Motion { sketch, times: Vec::new(), places: Vec::new() };
        for row in picture::kept(time.len(), sketch.points.len()) {
            let at = |column: &[f64]| column.get(row).copied().unwrap_or(f64::NAN);
            let q: Vec<f64> = coordinates.iter().map(|(column, unit)| unit.read(at(column))).collect();
            let places = places(&*run, at(time), &q);
            if places.iter().flatten().all(|x| x.is_finite()) {
                motion.times.push(at(time));
                motion.places.push(places);
            }
        }
        Ok(motion)
    }
}

/// Where the points of a mechanism are.
fn places(run: &dyn System, t: f64, q: &[f64]) -> Vec<[f64; 2]> {
    let mut points = vec![0.0; 2 * run.sketch().points.len()];
    run.points(t, q, &mut points);
    points.chunks_exact(2).map(|point| [point[0], point[1]]).collect()
}

/// A recorder of a run: its columns, its summary, its events and reasons to doubt it.
struct Recorder {
    info: &'static Info,
    columns: Vec<Column>,
    /// Those of coordinates, rates and own states.
    units: Vec<Unit>,
    /// The memories that have a column: their places among the inputs, and their units.
    memories: Vec<(usize, Unit)>,
    summary: Summary,
    watch: Watch,
    /// The size of the mechanism at the start in m.
    size: f64,
    reactions: Reactions,
    /// The watch over the length of the steps, of a run with a constant step.
    resolution: Option<Resolution>,
    now: Instant,
    phi: Vec<f64>,
    /// The condition that ends the run, and whether it is true at the start.
    until: Option<Until>,
    holds_at_start: bool,
    occurrences: Vec<Occurrence>,
}

impl Recorder {
    /// Of a run that begins.
    fn new(model: &dyn Model, run: &dyn System, until: Option<&Until>) -> Self {
        let info = model.info();
        let mut now = Instant::new(info);
        now.see(run);
        let size = size(model.sketch(), &places(run, run.time(), &now.q));
        let summary = Summary { energy_start: energy(run, &now), ..Summary::default() };
        let watch = Watch::new(info, model.derivation(), size);
        let phi = vec![0.0; info.constraints.len()];
        let units = Signal::states(info).iter().map(|signal| Unit::of_signal(info, signal)).collect();
        let (columns, memories) = (columns(info), memories(info));
        let (until, occurrences) = (until.cloned(), Vec::new());
        Self {
            info,
            columns,
            units,
            memories,
            summary,
            watch,
            size,
            reactions: Reactions::default(),
            resolution: None,
            now,
            phi,
            until,
            holds_at_start: false,
            occurrences,
        }
    }

    /// Advances by so many steps and records every so many.
    fn follow(
        &mut self,
        run: &mut dyn System,
        [steps, every]: [u64; 2],
        goes_on: &mut dyn FnMut(u64, u64) -> bool,
    ) -> Result<(), mbs_runtime::Error> {
        let powers_every = every.max(steps / POWERS);
        let mut margin_at_start = f64::NAN;
        for taken in 0..=steps {
            self.see(run);
            if let Some(resolution) = &mut self.resolution {
                resolution.see(run, &self.now, taken);
            }
            let is_look = taken % powers_every == 0;
            if self.watch.energy().is_some_and(|energy| is_look || energy.has_changed()) {
                let power = self.power(run);
                if let Some((energy, power)) = self.watch.energy().zip(power) {
                    if is_look {
                        energy.see_power(power);
                    }
                    if energy.has_changed() {
                        energy.see_work(power, run.step_size());
                    }
                }
            }
            if taken % every == 0 || taken == steps {
                self.append_row(run)?;
            }
            let margin = self.until.as_ref().map_or(f64::NAN, |until| until.margin(&self.now));
            // at the threshold itself, what the first step does counts
            if taken == 0 || (taken == 1 && margin_at_start == 0.0) {
                self.holds_at_start = margin > 0.0;
                margin_at_start = margin;
            }
            if taken < steps {
                if self.step(run)? {
                    goes_on(steps, steps);
                    return Ok(());
                }
                self.summary.steps = taken + 1;
                if ((taken + 1) % 1024 == 0 || taken + 1 == steps) && !goes_on(taken + 1, steps) {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// Advances by a step and notes the events on the way; whether one of them ends the run.
    fn step(&mut self, run: &mut dyn System) -> Result<bool, mbs_runtime::Error> {
        while let Some(event) = run.step_to_event()? {
            let declared = self.info.event_name(event.index).map(str::to_owned);
            let ending = self.until.as_ref().map(|until| until.ending);
            let is_end = declared.is_none() || ending == Some(Ending::Event(event.index));
            let condition = || self.until.as_ref().map(|until| until.text.clone());
            let name = declared.or_else(condition).unwrap_or_default();
            if is_end || self.occurrences.len() < MOST_OCCURRENCES {
                self.occurrences.push(Occurrence { name, t: event.t, is_rising: event.is_rising });
            }
            if is_end {
                self.see(run);
                self.append_row(run)?;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Looks at a state. This is called in every step.
    fn see(&mut self, run: &dyn System) {
        let Self { summary, watch, now, phi, .. } = self;
        now.see(run);
        // A largest value that is NaN once stays it.
        let larger = |largest: f64, x: f64| if x > largest || x.is_nan() { x } else { largest };
        let [violation, rate] = run.violations();
        summary.max_phi = larger(summary.max_phi, violation);
        summary.max_phi_dot = larger(summary.max_phi_dot, rate);
        run.equations().phi(run.time(), &now.q, phi);
        watch.see_constraints(run.time(), phi);
        if let Some(energy) = watch.energy() {
            let [kinetic, potential] = run.energies(At { t: run.time(), q: &now.q, v: &now.v });
            energy.see(kinetic, potential);
            energy.see_motion(self.info, &now.v, run.step_size());
        }
    }

    /// The power with which the energy changes along the motion that the equations ask for,
    /// by a difference over a small part of a step.
    fn power(&mut self, run: &dyn System) -> Option<f64> {
        self.now.solve(run).ok()?;
        let Instant { q, v, acceleration, .. } = &self.now;
        let part = 1e-3 * run.step_size();
        let energy = |dt: f64| {
            let moved = |x: &[f64], rate: &[f64]| -> Vec<f64> {
                x.iter().zip(rate).map(|(x, rate)| x + dt * rate).collect()
            };
            let (q, v) = (moved(q, v), moved(v, acceleration));
            let [kinetic, potential] = run.energies(At { t: run.time() + dt, q: &q, v: &v });
            kinetic + potential
        };
        Some((energy(part) - energy(-part)) / (2.0 * part))
    }

    fn append_row(&mut self, run: &dyn System) -> Result<(), mbs_runtime::Error> {
        let Self { info, columns, now, reactions, size, units, memories, .. } = self;
        now.solve(run)?;
        reactions.see(run, now, *size);
        // what is not finite is shown as it is, and doubted
        let _ = now.measure(run);
        let outputs =
            now.outputs.iter().zip(info.outputs).map(|(value, output)| Unit::of(output).shown(*value));
        let states = now.q.iter().chain(&now.v).zip(&*units).map(|(value, unit)| unit.shown(*value));
        let numbers = states.chain(now.multipliers.iter().copied());
        let memory =
            |(at, unit): &(usize, Unit)| now.inputs.get(*at).map_or(f64::NAN, |value| unit.shown(*value));
        let [violation, _] = run.violations();
        let row = [run.time()].into_iter().chain(numbers).chain(outputs);
        let row = row.chain(memories.iter().map(memory)).chain([violation]);
        for (column, value) in columns.iter_mut().zip(row) {
            column.values.push(value);
        }
        Ok(())
    }

    /// The recording of a run that has ended, with the reason if it did too early.
    fn finish(mut self, run: &dyn System, ended: Option<mbs_runtime::Error>) -> Recording {
        self.now.see(run);
        let summary = Summary {
            end: run.time(),
            energy_end: energy(run, &self.now),
            effort: run.effort(),
            ..self.summary
        };
        let mut doubts = self.watch.doubts(&self.columns);
        let singular = few_digits(run.digits_left(), run.worst_place());
        doubts.extend(singular.or_else(|| self.reactions.doubt()));
        doubts.extend(self.resolution.and_then(|resolution| resolution.doubt(summary.steps)));
        let (coordinates, lines) = (self.info.coordinates.len(), self.info.lines);
        let is_met = |until: &Until| self.occurrences.iter().any(|event| event.name == until.text);
        let unmet = self
            .until
            .as_ref()
            .filter(|until| !is_met(until))
            .map(|until| Unmet { condition: until.text.clone(), holds_at_start: self.holds_at_start });
        let Self { columns, memories, occurrences, .. } = self;
        let (memories, notes) = (memories.len(), Vec::new());
        Recording { columns, coordinates, lines, memories, summary, occurrences, unmet, ended, doubts, notes }
    }
}

fn energy(run: &dyn System, now: &Instant) -> f64 {
    let [kinetic, potential] = run.energies(At { t: run.time(), q: &now.q, v: &now.v });
    kinetic + potential
}
