//! The residuals at the positions of a task, and their derivatives.
//!
//! Every row is divided by the size of what it measures, so that lengths and angles weigh alike: a constraint in
//! m² by L², an angle by 1 rad, with L the extent of the positions.

use std::f64::consts::{PI, TAU};

use mbs_runtime::equations::{At, Equations, PARTIALS, Partials};
use mbs_runtime::{Dimension, Info};
use nalgebra::{DMatrix, DVector};

use super::blocks::Block;
use super::task::Task;
use crate::{Error, Signal, Trials, Variable};

/// A task whose names were found.
pub struct System<'a> {
    pub task: &'a Task,
    pub trials: &'a (dyn Trials + Sync),
    /// Where the unknowns stand among the parameters.
    places: Vec<usize>,
    columns: Vec<Signal>,
    /// The declared positions.
    pub declared: Vec<f64>,
    pub drive: Option<usize>,
    /// L
    pub size: f64,
    /// The sizes of constraints and of columns.
    rows: Vec<f64>,
    /// Those of coordinates and of unknowns.
    pub scales: [DVector<f64>; 2],
}

/// A mechanism with some values of the unknowns at some positions.
#[derive(Clone)]
pub struct Guess {
    pub values: DVector<f64>,
    pub coordinates: Vec<DVector<f64>>,
}

impl<'a> System<'a> {
    /// # Errors
    /// [`Error::Unknown`], and what the mechanism says about its parameters.
    pub fn new(task: &'a Task, trials: &'a (dyn Trials + Sync)) -> Result<Self, Error> {
        let info = task.info;
        let columns = Signal::outputs(info, Some(&task.columns))?;
        let is_position =
            |signal: &&Signal| !matches!(signal.variable, Variable::Coordinate(_) | Variable::Output(_));
        if let Some(signal) = columns.iter().find(is_position) {
            let known = Signal::outputs(info, None)?.into_iter().map(|signal| signal.name).collect();
            return Err(Error::Unknown { kind: "coordinate or output", name: signal.name.clone(), known });
        }
        let names: Vec<String> = task.unknown.iter().map(|unknown| unknown.name.clone()).collect();
        let place = |signal: Signal| match signal.variable {
            Variable::Parameter(at) => Some(at),
            _ => None,
        };
        let places = Signal::parameters(info, &names)?.into_iter().filter_map(place).collect();
        let drive = task.drive.as_ref().map(|name| Signal::coordinates(info, std::slice::from_ref(name)));
        let drive = drive.transpose()?.and_then(|found| match found.first()?.variable {
            Variable::Coordinate(at) => Some(at),
            _ => None,
        });
        let mut declared = Vec::new();
        let parameters: Vec<Partials> = task.parameters.iter().map(|x| Partials::constant(*x)).collect();
        // what is refused with the declared values may be taken with others
        let _ = trials.look(&parameters, &mut |_, q| declared = q.iter().map(|q| q.value).collect());
        declared.resize(info.coordinates.len(), 0.0);
        let size = size(task, &columns);
        let of = |dimension: Dimension| size.powi(i32::from(dimension.length));
        let constraints = info.constraints.iter().map(|row| of(row.dimension));
        let rows = constraints.chain(columns.iter().map(|column| of(column.dimension))).collect();
        let coordinates = info.coordinates.iter().map(|q| of(q.dimension));
        let unknowns = task.unknown.iter().map(|unknown| 0.25 * (unknown.bounds[1] - unknown.bounds[0]));
        let scales = [
            DVector::from_iterator(info.coordinates.len(), coordinates),
            DVector::from_iterator(task.unknown.len(), unknowns),
        ];
        Ok(Self { task, trials, places, columns, declared, drive, size, rows, scales })
    }

    pub fn info(&self) -> &'static Info {
        self.task.info
    }

    pub fn is_angle(&self, coordinate: usize) -> bool {
        self.info().coordinates.get(coordinate).is_some_and(|q| q.dimension.length == 0)
    }

    /// True if there are more values than unknowns and positions can meet.
    pub fn is_overdetermined(&self) -> bool {
        let values = self.task.positions.iter().flatten().flatten().count();
        values > self.task.unknown.len() + self.task.positions.len()
    }

    /// All parameters, with partial derivatives by the unknowns from the one with a number on.
    pub fn parameters(&self, values: &DVector<f64>, first: Option<usize>) -> Vec<Partials> {
        let mut parameters: Vec<Partials> =
            self.task.parameters.iter().map(|x| Partials::constant(*x)).collect();
        for (at, (place, value)) in self.places.iter().zip(values).enumerate() {
            let partial = first.and_then(|first| at.checked_sub(first)).unwrap_or(PARTIALS);
            parameters[*place] = Partials::variable(*value, partial);
        }
        parameters
    }

    /// Writes the residuals at a position; the constraints count `weight` times.
    fn residuals(
        &self,
        mechanism: &dyn Equations<Partials>,
        q: &[Partials],
        position: usize,
        weight: f64,
        room: &mut Room,
    ) {
        let m = self.info().constraints.len();
        let Room { residuals, still, multipliers, inputs, outputs } = room;
        let (phi, values) = residuals.split_at_mut(m);
        mechanism.phi(Partials::default(), q, phi);
        if self.columns.iter().any(|column| matches!(column.variable, Variable::Output(_))) {
            let at = At { t: Partials::default(), q, v: still };
            mechanism.outputs(at, inputs, [still, multipliers], outputs);
        }
        for (phi, size) in phi.iter_mut().zip(&self.rows) {
            *phi = *phi * Partials::constant(weight / size);
        }
        let targets = &self.task.positions[position];
        let columns = self.columns.iter().zip(targets).zip(&self.rows[m..]);
        for (value, ((column, target), size)) in values.iter_mut().zip(columns) {
            let found = match column.variable {
                Variable::Coordinate(at) => q.get(at).copied(),
                Variable::Output(at) => outputs.get(at).copied(),
                _ => None,
            };
            *value = match (found, target) {
                (Some(found), Some(target)) => {
                    let is_angle = matches!(column.variable, Variable::Coordinate(at) if self.is_angle(at));
                    let miss = found.value - target;
                    let turns = if is_angle { (miss / TAU).round() } else { 0.0 };
                    (found - Partials::constant(target + TAU * turns)) * Partials::constant(1.0 / size)
                }
                (_, None) => Partials::default(),
                (None, Some(_)) => Partials::constant(f64::NAN),
            };
        }
    }

    /// The residuals at all positions, with derivatives if they are asked for. Nothing where the mechanism
    /// refuses the values or a residual is no number.
    pub fn blocks(&self, guess: &Guess, weight: f64, with_derivatives: bool) -> Option<Vec<Block>> {
        let (n, p) = (self.scales[0].len(), guess.values.len());
        let [of_q, of_p] = if with_derivatives { [n, p] } else { [0, 0] };
        let count = self.rows.len();
        let block = |_| Block {
            residuals: DVector::zeros(count),
            by_coordinates: DMatrix::zeros(count, of_q),
            by_unknowns: DMatrix::zeros(count, of_p),
        };
        let mut blocks: Vec<Block> = (0..guess.coordinates.len()).map(block).collect();
        let mut room = Room::new(self);
        let constant = |q: &DVector<f64>| q.iter().map(|q| Partials::constant(*q)).collect::<Vec<_>>();
        let all: Vec<Vec<Partials>> = guess.coordinates.iter().map(constant).collect();
        for first in (0..of_p).step_by(PARTIALS) {
            let parameters = self.parameters(&guess.values, Some(first));
            let look = self.trials.look(&parameters, &mut |mechanism, _| {
                for (position, (block, q)) in blocks.iter_mut().zip(&all).enumerate() {
                    self.residuals(mechanism, q, position, weight, &mut room);
                    store(&room.residuals, &mut block.by_unknowns, first);
                }
            });
            look.ok()?;
        }
        let parameters = self.parameters(&guess.values, None);
        let look = self.trials.look(&parameters, &mut |mechanism, _| {
            for (position, (block, q)) in blocks.iter_mut().zip(&all).enumerate() {
                for first in (0..of_q.max(1)).step_by(PARTIALS) {
                    let q = seeded(q, first);
                    self.residuals(mechanism, &q, position, weight, &mut room);
                    store(&room.residuals, &mut block.by_coordinates, first);
                }
                block.residuals = DVector::from_iterator(count, room.residuals.iter().map(|r| r.value));
            }
        });
        look.ok()?;
        blocks.iter().all(|block| block.residuals.iter().all(|r| r.is_finite())).then_some(blocks)
    }

    /// The largest difference from a value that was asked for, in SI units.
    pub fn missed(&self, blocks: &[Block]) -> f64 {
        let m = self.info().constraints.len();
        let of = |block: &Block| {
            let values = block.residuals.iter().zip(&self.rows).skip(m);
            values.map(|(r, size)| (r * size).abs()).fold(0.0, f64::max)
        };
        blocks.iter().map(of).fold(0.0, f64::max)
    }
}

/// Numbers as variables from the one with the number `first` on.
pub fn seeded(q: &[Partials], first: usize) -> Vec<Partials> {
    let partial = |at: usize| at.checked_sub(first).unwrap_or(PARTIALS);
    q.iter().enumerate().map(|(at, q)| Partials::variable(q.value, partial(at))).collect()
}

/// Writes partial derivatives to the columns of a matrix from the one with the number `first` on.
pub fn store(residuals: &[Partials], matrix: &mut DMatrix<f64>, first: usize) {
    for (row, residual) in residuals.iter().enumerate() {
        for (column, partial) in (first..matrix.ncols()).zip(residual.partials) {
            matrix[(row, column)] = partial;
        }
    }
}

/// The nearest of the angles that are the same, measured from another.
pub fn nearest_turn(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// The largest extent of values that are lengths; 1 m where there are none.
fn size(task: &Task, columns: &[Signal]) -> f64 {
    let extent = |column: usize| {
        let values = || task.positions.iter().filter_map(|row| row.get(column).copied().flatten());
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let lengths = columns.iter().enumerate().filter(|(_, column)| column.dimension.length == 1);
    let largest = lengths.map(|(at, _)| extent(at)).filter(|x| x.is_finite()).fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

/// Vectors to compute with.
struct Room {
    residuals: Vec<Partials>,
    still: Vec<Partials>,
    multipliers: Vec<Partials>,
    inputs: Vec<Partials>,
    outputs: Vec<Partials>,
}

impl Room {
    fn new(system: &System<'_>) -> Self {
        let info = system.info();
        let zeros = |count: usize| vec![Partials::default(); count];
        Self {
            residuals: zeros(system.rows.len()),
            still: zeros(info.coordinates.len()),
            multipliers: zeros(info.constraints.len()),
            inputs: info.inputs.iter().map(|input| Partials::constant(input.default)).collect(),
            outputs: zeros(info.outputs.len()),
        }
    }
}
