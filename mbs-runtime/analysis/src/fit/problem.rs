//! Predictions of a mechanism at the instants of the samples, with derivatives.

use std::cell::{Cell, RefCell};

use mbs_runtime::Error as RunError;
use mbs_runtime::equations::{PARTIALS, Partials};
use mbs_runtime::{Real, System};
use nalgebra::{DMatrix, DVector};

use super::least_squares::Local;
use super::{Experiment, Trial, Trials};
use crate::{Error, Variable};

/// An experiment whose names were found and whose samples are in the order of time.
pub struct Problem<'a> {
    pub experiment: &'a Experiment,
    trials: &'a dyn Trials,
    channels: Vec<Variable>,
    places: Vec<Variable>,
    /// The instants of all samples, ascending.
    times: Vec<f64>,
    /// All samples by their instants.
    pub samples: Vec<Sample>,
    pub guess: DVector<f64>,
    pub bounds: Vec<[f64; 2]>,
    pub runs: Cell<usize>,
    /// The steps that a run may take.
    most_steps: Cell<u64>,
    /// Why the last run that failed did.
    pub failure: RefCell<Option<RunError>>,
}

/// A measured value.
pub struct Sample {
    instant: usize,
    pub channel: usize,
    pub value: f64,
}

impl<'a> Problem<'a> {
    /// Finds the names of an experiment, and puts its samples in the order of time.
    ///
    /// # Errors
    /// As [`Experiment::fit`].
    pub fn new(experiment: &'a Experiment, trials: &'a dyn Trials) -> Result<Self, Error> {
        let (channels, places) = (experiment.channels()?, experiment.places()?);
        experiment.check()?;
        let measured = &experiment.measured;
        let mut times: Vec<f64> = measured.iter().flat_map(|measured| measured.times.clone()).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut samples = Vec::new();
        for (channel, measured) in measured.iter().enumerate() {
            for (time, value) in measured.times.iter().zip(&measured.values) {
                let instant = times.partition_point(|other| other < time);
                samples.push(Sample { instant, channel, value: *value });
            }
        }
        samples.sort_by_key(|sample| sample.instant);
        let mut problem = Self {
            experiment,
            trials,
            channels,
            places,
            times,
            samples,
            guess: DVector::zeros(0),
            bounds: Vec::new(),
            runs: Cell::new(0),
            most_steps: Cell::new(0),
            failure: RefCell::new(None),
        };
        let instants = problem.times.len() + experiment.table.len();
        problem.most_steps.set(FIRST + MOST * instants as u64);
        problem.begin()?;
        Ok(problem)
    }

    /// Finds the guesses and the bounds.
    fn begin(&mut self) -> Result<(), Error> {
        let declared = self.declared_start()?;
        let Experiment { info, parameters, unknown, .. } = self.experiment;
        let n = info.coordinates.len();
        let value = |place: &Variable| match place {
            Variable::Coordinate(at) => declared.get(*at).copied(),
            Variable::Velocity(at) => declared.get(n + at).copied(),
            Variable::Parameter(at) => parameters.get(*at).copied(),
            _ => None,
        };
        let guesses = unknown.iter().zip(&self.places);
        let guesses = guesses.map(|(unknown, place)| unknown.guess.or(value(place)).unwrap_or(f64::NAN));
        self.guess = DVector::from_iterator(unknown.len(), guesses);
        for (unknown, guess) in unknown.iter().zip(&self.guess) {
            let [low, high] = unknown.bounds;
            // written so that NaN is refused
            if !(low <= *guess && *guess <= high && low < high && guess.is_finite()) {
                return Err(Error::Bounds { name: unknown.name.clone(), guess: *guess, low, high });
            }
        }
        self.bounds = (0..unknown.len()).map(|at| self.declared_bounds(at)).collect();
        let steps = Cell::new(0);
        let first = self.run(&self.guess, 0, self.samples.len(), &mut |_, run| steps.set(steps_of(run)));
        match first {
            Ok(()) => self.most_steps.set(MOST * (steps.get() + self.times.len() as u64)),
            // no other start would come to the end of such data
            Err(error @ RunError::TooManySteps { .. }) => return Err(Error::Mechanism(error)),
            Err(_) => {}
        }
        Ok(())
    }

    /// Positions and velocities of the declared start; the data begin at it or behind it.
    fn declared_start(&self) -> Result<Vec<f64>, Error> {
        let Experiment { parameters, measured, .. } = self.experiment;
        let parameters: Vec<Partials> = parameters.iter().map(|value| Partials::constant(*value)).collect();
        let (declared, start) = (RefCell::new(Vec::new()), Cell::new(0.0));
        let keep = |q: &mut [Partials], v: &mut [Partials]| {
            *declared.borrow_mut() = q.iter().chain(v.iter()).map(|x| x.value).collect();
        };
        let trial = Trial { start: &keep, times: &[f64::NEG_INFINITY], ..self.trial(&parameters) };
        self.trials.follow(&trial, &mut |_, run| {
            start.set(run.time().value);
            Ok(())
        })?;
        for measured in measured {
            if let Some(t) = measured.times.first().filter(|t| **t < start.get()) {
                return Err(Error::BeforeStart { name: measured.name.clone(), t: *t, start: start.get() });
            }
        }
        Ok(declared.into_inner())
    }

    /// The bounds of an unknown, and 0 where the declaration asks a parameter not to be negative.
    fn declared_bounds(&self, at: usize) -> [f64; 2] {
        /// A part of the guess so small that it does not matter.
        const LITTLE: f64 = 1e-6;
        let [low, high] = self.experiment.unknown[at].bounds;
        let guess = self.guess[at];
        if !matches!(self.places[at], Variable::Parameter(_)) || guess <= 0.0 || low >= 0.0 {
            return [low, high];
        }
        let takes = |part: f64| {
            let mut x = self.guess.clone();
            x[at] = part * guess;
            let [parameters, ..] = self.planted(&x, 0);
            self.trials.check(&parameters).is_ok()
        };
        match (takes(1.0), takes(-LITTLE), takes(0.0)) {
            (true, false, true) => [0.0, high],
            (true, false, false) => [LITTLE * guess, high],
            _ => [low, high],
        }
    }

    fn trial<'t>(&'t self, parameters: &'t [Partials]) -> Trial<'t> {
        let Experiment { start_time, inputs, table, tolerances, .. } = self.experiment;
        let (start_time, tolerances, most_steps) = (*start_time, *tolerances, self.most_steps.get());
        Trial { parameters, start: &|_, _| (), times: &[], start_time, inputs, table, tolerances, most_steps }
    }

    /// Parameters, positions and velocities with some values of x, as variables from the one with the number
    /// `first` on. Positions and velocities that are not in x are NaN.
    fn planted(&self, x: &DVector<f64>, first: usize) -> [Vec<Partials>; 3] {
        let Experiment { info, parameters, .. } = self.experiment;
        let unset = || vec![Partials::constant(f64::NAN); info.coordinates.len()];
        let parameters = parameters.iter().map(|value| Partials::constant(*value)).collect();
        let mut planted = [parameters, unset(), unset()];
        for (number, (place, value)) in self.places.iter().zip(x).enumerate() {
            let (list, at) = match place {
                Variable::Parameter(at) => (0, *at),
                Variable::Velocity(at) => (2, *at),
                Variable::Coordinate(at) => (1, *at),
                _ => continue,
            };
            // an index from PARTIALS on makes a constant
            planted[list][at] = Partials::variable(*value, number.checked_sub(first).unwrap_or(PARTIALS));
        }
        planted
    }

    /// The number of samples until a part of the time of the experiment has passed.
    pub fn samples_until(&self, part: f64) -> usize {
        let ends = (self.times.first(), self.times.last());
        let (Some(first), Some(last)) = ends else { return 0 };
        let instants = self.times.partition_point(|t| *t <= first + part * (last - first));
        self.samples.partition_point(|sample| sample.instant < instants)
    }

    /// The predictions of the first `count` samples, and their derivatives by x.
    ///
    /// # Errors
    /// Those of the runs.
    pub fn predict(&self, x: &DVector<f64>, count: usize) -> Result<Local, RunError> {
        let mut predicted = DVector::zeros(count);
        let mut jacobian = DMatrix::zeros(count, x.len());
        for first in (0..x.len()).step_by(PARTIALS) {
            self.runs.set(self.runs.get() + 1);
            let mut row = 0;
            self.run(x, first, count, &mut |value, _| {
                predicted[row] = value.value;
                let columns = (first..x.len()).zip(value.partials);
                columns.for_each(|(column, partial)| jacobian[(row, column)] = partial);
                row += 1;
            })?;
        }
        Ok(Local { residuals: predicted, jacobian })
    }

    /// A run over the first `count` samples, with derivatives from the unknown with the number `first` on.
    fn run(
        &self,
        x: &DVector<f64>,
        first: usize,
        count: usize,
        take: &mut dyn FnMut(Partials, &dyn System<Partials>),
    ) -> Result<(), RunError> {
        let [parameters, positions, velocities] = self.planted(x, first);
        let change = |q: &mut [Partials], v: &mut [Partials]| {
            let places = q.iter_mut().zip(&positions).chain(v.iter_mut().zip(&velocities));
            places.filter(|(_, new)| new.is_finite()).for_each(|(place, new)| *place = *new);
        };
        let instants = self.samples.get(count.wrapping_sub(1)).map_or(0, |last| last.instant + 1);
        let times = self.times.get(..instants).unwrap_or(&self.times);
        let trial = Trial { start: &change, times, ..self.trial(&parameters) };
        let mut view = View::new(self);
        let mut samples = self.samples.iter().take(count).peekable();
        self.trials.follow(&trial, &mut |instant, run| {
            view.see(run)?;
            while let Some(sample) = samples.next_if(|sample| sample.instant == instant) {
                take(view.value(self.channels[sample.channel]), run);
            }
            Ok(())
        })
    }
}

/// A run that takes so many times the steps of the first and a step to each instant is one of a stiffness that
/// nothing measured asks for.
const MOST: u64 = 30;
/// The first run may take so many steps beside those to the instants of the data and of the inputs.
const FIRST: u64 = 100_000;

fn steps_of(run: &dyn System<Partials>) -> u64 {
    run.effort().map_or(0, |effort| effort.steps)
}

/// The state of a run at an instant, in room that is made once.
struct View {
    q: Vec<Partials>,
    v: Vec<Partials>,
    acceleration: Vec<Partials>,
    multipliers: Vec<Partials>,
    outputs: Vec<Partials>,
    /// True if anything beside positions and velocities was measured.
    is_solved: bool,
}

impl View {
    fn new(problem: &Problem<'_>) -> Self {
        let info = problem.experiment.info;
        let room = |count: usize| vec![Partials::default(); count];
        let coordinates = info.coordinates.len();
        let is_state =
            |channel: &Variable| matches!(channel, Variable::Coordinate(_) | Variable::Velocity(_));
        Self {
            q: room(coordinates),
            v: room(coordinates),
            acceleration: room(coordinates),
            multipliers: room(info.constraints.len()),
            outputs: room(info.outputs.len()),
            is_solved: !problem.channels.iter().all(is_state),
        }
    }

    fn see(&mut self, run: &dyn System<Partials>) -> Result<(), RunError> {
        run.state(&mut self.q, &mut self.v);
        if self.is_solved {
            run.reactions(&mut self.acceleration, &mut self.multipliers)?;
            // what was not measured may be undefined
            let _ = run.outputs(&self.acceleration, &self.multipliers, &mut self.outputs);
        }
        Ok(())
    }

    fn value(&self, channel: Variable) -> Partials {
        let found = match channel {
            Variable::Coordinate(at) => self.q.get(at),
            Variable::Velocity(at) => self.v.get(at),
            Variable::Output(at) => self.outputs.get(at),
            Variable::Multiplier(at) => self.multipliers.get(at),
            Variable::Input(_) | Variable::Parameter(_) => None,
        };
        found.copied().unwrap_or(Partials::constant(f64::NAN))
    }
}
