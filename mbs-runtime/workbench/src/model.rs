//! A mechanism whose type is no longer known: what commands work with.

use std::marker::PhantomData;

use mbs_runtime::{
    Baumgarte, Components, Derivation, Feedback, Held, Info, Mechanism, PerStage, Reactions, Simulation,
    State,
};

use crate::doubt::{Watch, few_digits, size};
use crate::members::{self, Members};
use crate::recording::{Column, Recording, Summary, columns};
use crate::settings::{FeedbackKind, Settings, StartKind};
use crate::signals::Player;
use crate::{Error, Motion, Unit, picture};

/// More rows than this are refused, before they fill the memory.
const MAX_ROWS: u64 = 5_000_000;

/// What commands need of a mechanism. Implemented for every [`Mechanism`] in
/// `f64` by [`of`].
pub trait Model: Send + Sync {
    /// Names, units, equations and operation counts.
    fn info(&self) -> &'static Info;

    /// The equations and their elimination.
    fn derivation(&self) -> &'static Derivation;

    /// The declared start, and what the constraints make of it.
    ///
    /// # Errors
    /// A start that cannot be made consistent.
    fn start(&self) -> Result<Vec<StartValue>, Error>;

    /// What a run is asked to do where nothing else is said.
    fn defaults(&self) -> Settings {
        Settings::default()
    }

    /// Runs a simulation. `progress` is called now and then with the steps
    /// taken and the steps in all.
    ///
    /// A run that fails on its way is no error here: [`Recording::ended`] says
    /// why, and the rows up to there are kept.
    ///
    /// # Errors
    /// Settings that the mechanism does not have or refuses.
    fn simulate(&self, settings: &Settings, progress: &mut dyn FnMut(u64, u64)) -> Result<Recording, Error>;

    /// Where the points of the mechanism were during a run with these settings,
    /// at some of the recorded instants.
    ///
    /// # Errors
    /// Settings that the mechanism does not have or refuses.
    fn motion(&self, settings: &Settings, recording: &Recording) -> Result<Motion, Error>;

    /// Runs simulations that differ in parameters, on all cores.
    ///
    /// # Errors
    /// Settings that the mechanism does not have or refuses; what happens to a
    /// member is no error here.
    fn sweep(&self, settings: &Settings, members: Members<'_>) -> Result<(), Error>;
}

/// A coordinate or its rate at the start of a run, in SI units.
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

/// The mechanism `M` as a [`Model`].
pub fn of<M: Mechanism<Real = f64>>() -> Box<dyn Model> {
    with::<M>(Settings::default())
}

/// The mechanism `M` as a [`Model`] with defaults of its own: a fast mechanism
/// needs a smaller step.
pub fn with<M: Mechanism<Real = f64>>(defaults: Settings) -> Box<dyn Model> {
    Box::new(Typed::<M> { defaults, sweep: members::one_by_one::<M>, mechanism: PhantomData })
}

/// The mechanism `M` as a [`Model`] whose sweeps run eight members to a vector
/// instruction: some times faster, and some seconds more to compile.
pub fn in_lanes<M: Mechanism<Real = f64>>(defaults: Settings) -> Box<dyn Model> {
    Box::new(Typed::<M> { defaults, sweep: members::in_lanes::<M>, mechanism: PhantomData })
}

struct Typed<M> {
    defaults: Settings,
    sweep: fn(&Settings, Members<'_>) -> Result<(), Error>,
    mechanism: PhantomData<M>,
}

impl<M: Mechanism<Real = f64>> Model for Typed<M> {
    fn info(&self) -> &'static Info {
        M::INFO
    }

    fn derivation(&self) -> &'static Derivation {
        M::DERIVATION
    }

    fn start(&self) -> Result<Vec<StartValue>, Error> {
        let mechanism = M::new(M::Parameters::default())?;
        let declared = mechanism.declared_start();
        let kept = mbs_runtime::start::consistent(&mechanism, &declared)?;
        let values = |of: fn(&State<M::Coordinates>) -> M::Coordinates| {
            let [declared, kept] = [&declared, &kept].map(|state| of(state).into_array().as_ref().to_vec());
            declared.into_iter().zip(kept)
        };
        let coordinates = M::INFO.coordinates.iter();
        let positions = coordinates
            .clone()
            .zip(values(|state| state.q))
            .map(|(quantity, values)| (quantity.name.to_owned(), Unit::of_coordinate(quantity), values));
        let rates = coordinates.zip(values(|state| state.v)).map(|(quantity, values)| {
            (format!("der({})", quantity.name), Unit::of_coordinate(quantity).per_second(), values)
        });
        let value = |(name, unit, (declared, kept)): (String, Unit, (f64, f64))| StartValue {
            name,
            declared,
            kept,
            unit: unit.name().to_owned(),
        };
        Ok(positions.chain(rates).map(value).collect())
    }

    fn defaults(&self) -> Settings {
        self.defaults.clone()
    }

    fn simulate(&self, settings: &Settings, progress: &mut dyn FnMut(u64, u64)) -> Result<Recording, Error> {
        match settings.feedback {
            FeedbackKind::Held => run::<M, Held>(settings, progress),
            FeedbackKind::PerStage => run::<M, PerStage>(settings, progress),
        }
    }

    fn motion(&self, settings: &Settings, recording: &Recording) -> Result<Motion, Error> {
        let parameters = assign("parameter", M::Parameters::default(), &settings.parameters)?;
        let mechanism = M::new(parameters)?;
        let mut columns = recording.columns.iter().map(|column| column.values.as_slice());
        let time = columns.next().unwrap_or_default();
        let coordinates: Vec<&[f64]> = columns.take(recording.coordinates).collect();
        let mut motion = Motion { sketch: M::SKETCH, times: Vec::new(), places: Vec::new() };
        for row in picture::kept(time.len(), M::SKETCH.points.len()) {
            let mut q = M::Coordinates::splat(f64::NAN).into_array();
            for (value, column) in q.as_mut().iter_mut().zip(&coordinates) {
                *value = column.get(row).copied().unwrap_or(f64::NAN);
            }
            let t = time.get(row).copied().unwrap_or(f64::NAN);
            let places = mechanism.points(t, &M::Coordinates::from_array(q)).as_ref().to_vec();
            if places.iter().flatten().all(|x| x.is_finite()) {
                motion.times.push(t);
                motion.places.push(places);
            }
        }
        Ok(motion)
    }

    fn sweep(&self, settings: &Settings, members: Members<'_>) -> Result<(), Error> {
        (self.sweep)(settings, members)
    }
}

/// What a run is made of, but for the parameters.
pub(crate) struct Start<M: Mechanism, F: Feedback> {
    /// The declared parameters with those of the settings.
    pub parameters: M::Parameters,
    inputs: M::Inputs,
    gains: Baumgarte<F>,
    step: f64,
    kind: StartKind,
    allow_unstable: bool,
}

impl<M: Mechanism<Real = f64>, F: Feedback> Start<M, F> {
    pub fn of(settings: &Settings) -> Result<Self, Error> {
        let step = settings.step;
        if !(step > 0.0 && step.is_finite()) {
            return Err(mbs_runtime::Error::Step { step }.into());
        }
        let deadbeat = Baumgarte::<F>::deadbeat(step);
        Ok(Self {
            parameters: assign("parameter", M::Parameters::default(), &settings.parameters)?,
            inputs: assign("input", M::Inputs::default(), &settings.inputs)?,
            gains: Baumgarte::<F>::new(
                settings.alpha.unwrap_or(deadbeat.alpha()),
                settings.beta.unwrap_or(deadbeat.beta()),
            )?,
            step,
            kind: settings.start,
            allow_unstable: settings.allow_unstable,
        })
    }

    pub fn simulation(&self, parameters: M::Parameters) -> Result<Simulation<M, F>, mbs_runtime::Error> {
        let builder = Simulation::builder(M::new(parameters)?, self.step);
        let mut builder = builder.baumgarte(self.gains).inputs(self.inputs);
        if self.kind == StartKind::Declared {
            builder = builder.as_declared();
        }
        if self.allow_unstable {
            builder = builder.allow_unstable();
        }
        builder.build()
    }
}

fn run<M: Mechanism<Real = f64>, F: Feedback>(
    settings: &Settings,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Recording, Error> {
    let start = Start::<M, F>::of(settings)?;
    let player = Player::of::<M>(settings)?;
    let simulation = start.simulation(start.parameters)?;
    let steps = simulation.steps_to(settings.end)?;
    let every = settings.every.max(1);
    if steps / every > MAX_ROWS {
        return Err(Error::TooManyRows { rows: steps / every, every: 1 + steps / MAX_ROWS });
    }
    Ok(record(simulation, player, steps, every, progress))
}

/// `values` with the named ones replaced.
fn assign<C: Components<Real = f64>>(
    kind: &'static str,
    values: C,
    settings: &[(String, f64)],
) -> Result<C, Error> {
    settings.iter().try_fold(values, |values, (name, value)| {
        values.with(name, *value).ok_or_else(|| Error::unknown(kind, name, C::NAMES.iter().copied()))
    })
}

fn record<M: Mechanism<Real = f64>, F: Feedback>(
    mut simulation: Simulation<M, F>,
    player: Option<Player<'_>>,
    steps: u64,
    every: u64,
    progress: &mut dyn FnMut(u64, u64),
) -> Recording {
    let mut columns = columns(M::INFO);
    let mut summary = Summary { energy_start: simulation.energy(), ..Summary::default() };
    let State { t, q, .. } = simulation.state();
    let places = simulation.mechanism().points(*t, q);
    let mut watch = Watch::new(M::INFO, M::DERIVATION, size(M::SKETCH, places.as_ref()));
    let powers_every = every.max(steps / POWERS);
    let mut ended = None;
    let mut taken = 0;
    loop {
        if let Some(player) = &player {
            player.set(&mut simulation);
        }
        see(&simulation, &mut summary, &mut watch);
        if watch.wants_energy()
            && taken % powers_every == 0
            && let Some(power) = power(&simulation)
        {
            watch.see_power(power);
        }
        if (taken % every == 0 || taken == steps)
            && let Err(error) = append_row(&simulation, &mut columns)
        {
            ended = Some(error);
            break;
        }
        if taken == steps {
            break;
        }
        if let Err(error) = step(&mut simulation) {
            ended = Some(error);
            break;
        }
        taken += 1;
        if taken % 1024 == 0 || taken == steps {
            progress(taken, steps);
        }
    }
    summary.steps = taken;
    summary.end = simulation.time();
    summary.energy_end = simulation.energy();
    let mut doubts = watch.doubts(&columns);
    doubts.extend(few_digits(simulation.digits_left(), simulation.worst_place()));
    Recording { columns, coordinates: M::INFO.coordinates.len(), summary, ended, doubts }
}

/// Instants at which the power is looked at.
const POWERS: u64 = 100;

/// What is looked at in every step.
fn see<M: Mechanism<Real = f64>, F: Feedback>(
    simulation: &Simulation<M, F>,
    summary: &mut Summary,
    watch: &mut Watch,
) {
    let State { t, q, .. } = simulation.state();
    let phi = simulation.mechanism().phi(*t, q);
    // A largest value that is NaN once stays it.
    let larger = |largest: f64, x: f64| if x > largest || x.is_nan() { x } else { largest };
    summary.max_phi = larger(summary.max_phi, phi.norm());
    summary.max_phi_dot = larger(summary.max_phi_dot, simulation.velocity_violation());
    watch.see_constraints(*t, phi.into_array().as_ref());
    if watch.wants_energy() {
        let mechanism = simulation.mechanism();
        let state = simulation.state();
        watch.see_energy(mechanism.kinetic_energy(state), mechanism.potential_energy(state));
    }
}

/// The power with which the energy changes along the motion that the equations ask for, by
/// a difference over a small part of a step.
fn power<M: Mechanism<Real = f64>, F: Feedback>(simulation: &Simulation<M, F>) -> Option<f64> {
    let part = 1e-3 * simulation.step_size();
    let State { t, q, v } = *simulation.state();
    let acceleration = seen(simulation).ok()?.0.acceleration;
    let energy = |dt: f64| {
        let moved = |x: M::Coordinates, rate: M::Coordinates| x.zip_map(rate, |x, rate| x + dt * rate);
        let state = State { t: t + dt, q: moved(q, v), v: moved(v, acceleration) };
        simulation.mechanism().kinetic_energy(&state) + simulation.mechanism().potential_energy(&state)
    };
    Some((energy(part) - energy(-part)) / (2.0 * part))
}

/// A step. Runs and sweeps share the code of it, which is long for each mechanism. Feedback
/// in both stages, which few ask for, is spared the fused step: its stages give the same
/// numbers.
#[inline(never)]
pub(crate) fn step<M: Mechanism, F: Feedback>(
    simulation: &mut Simulation<M, F>,
) -> Result<(), mbs_runtime::Error> {
    if F::IS_HELD { simulation.step() } else { simulation.step_in_stages() }
}

/// What is seen of an instant: accelerations and multipliers, outputs.
pub(crate) type Seen<M> =
    (Reactions<<M as Mechanism>::Coordinates, <M as Mechanism>::Constraints>, <M as Mechanism>::Outputs);

/// Looks at an instant; shared as well.
#[inline(never)]
pub(crate) fn seen<M: Mechanism, F: Feedback>(
    simulation: &Simulation<M, F>,
) -> Result<Seen<M>, mbs_runtime::Error> {
    let reactions = simulation.reactions()?;
    let outputs = simulation.mechanism().outputs(simulation.state(), simulation.inputs(), &reactions);
    Ok((reactions, outputs))
}

fn append_row<M: Mechanism<Real = f64>, F: Feedback>(
    simulation: &Simulation<M, F>,
    columns: &mut [Column],
) -> Result<(), mbs_runtime::Error> {
    let state = simulation.state();
    let (reactions, outputs) = seen(simulation)?;
    let (q, v, multipliers) =
        (state.q.into_array(), state.v.into_array(), reactions.multipliers.into_array());
    let outputs = outputs.into_array();
    let row = [state.t]
        .into_iter()
        .chain(q.as_ref().iter().copied())
        .chain(v.as_ref().iter().copied())
        .chain(multipliers.as_ref().iter().copied())
        .chain(
            outputs
                .as_ref()
                .iter()
                .zip(M::INFO.outputs)
                .map(|(value, output)| Unit::of(output).shown(*value)),
        )
        .chain([simulation.violation()]);
    for (column, value) in columns.iter_mut().zip(row) {
        column.values.push(value);
    }
    Ok(())
}
