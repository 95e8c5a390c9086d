//! Minimal coordinates: declared coordinates that determine the others.

use mbs_runtime::Info;
use mbs_runtime::equations::Equations;
use nalgebra::{DMatrix, DVector};

use crate::point::OperatingPoint;
use crate::tangent::Rest;
use crate::{Error, Signal, Variable};

/// A coordinate is taken that moves by at least this share of the one that moves most, so that
/// angles come before lengths, and first ones before later ones.
const SHARE: f64 = 0.3;
/// Coordinates whose directions are nearer to those of others than this do not determine a position.
const INDEPENDENT: f64 = 1e-6;

/// A component of a direction is 0 that is this share of the largest one.
const ROUNDING: f64 = 1e-14;

/// Independent coordinates z = q_I at a position, and the directions N of all coordinates with
/// Φ_q N = 0 and N_I = 1.
pub struct Chart<'a> {
    rest: Rest<'a>,
    q: DVector<f64>,
    /// I, positions of coordinates.
    pub independent: Vec<usize>,
    /// N
    pub directions: DMatrix<f64>,
    /// M_r = NᵀMN
    pub mass: DMatrix<f64>,
}

impl<'a> Chart<'a> {
    /// The chart at a point, with the coordinates that are asked for or with those that move most.
    ///
    /// # Errors
    /// [`Error::Unknown`], [`Error::Dependent`].
    pub fn new(
        mechanism: &'a dyn Equations<f64>,
        point: &'a OperatingPoint,
        names: Option<&[String]>,
    ) -> Result<Self, Error> {
        let (rest, q) = (point.rest(mechanism), DVector::from_column_slice(&point.q));
        let tangent = rest.tangent(&q);
        let info = mechanism.info();
        let scales = rest.scales();
        let moves = DMatrix::from_fn(q.len(), tangent.directions.ncols(), |row, column| {
            tangent.directions[(row, column)] / scales[row]
        });
        let independent = match names {
            Some(names) => asked(info, &moves, names)?,
            None => chosen(info, moves.clone(), 0),
        };
        let rows = tangent.directions.select_rows(&independent);
        let Some(inverse) = rows.try_inverse() else { return Err(dependent(info, &independent)) };
        let mut directions = &tangent.directions * &inverse;
        // what is rounding beside the largest is 0
        for mut direction in directions.column_iter_mut() {
            let largest = direction.component_div(&scales).amax();
            direction.zip_apply(&scales, |x, scale| {
                *x = if x.abs() > ROUNDING * largest * scale { *x } else { 0.0 }
            });
        }
        let mass = inverse.transpose() * rest.reduced_mass(&q, &tangent) * &inverse;
        Ok(Self { rest, q, independent, directions, mass })
    }

    /// 1 rad for an angle, the size of the mechanism for a length.
    pub fn scales(&self) -> DVector<f64> {
        self.rest.scales()
    }

    /// How the other coordinates change where Φ, or Φ̇ for velocities, changes at a rate that is not
    /// theirs: δ with Φ_q δ = −`rate` and δ_I = 0.
    pub fn carried(&self, rate: &DVector<f64>) -> DVector<f64> {
        let least = self.rest.correction(&self.q, rate);
        &self.directions * self.minimal(&least) - least
    }

    /// z of a change of all coordinates.
    pub fn minimal(&self, change: &DVector<f64>) -> DVector<f64> {
        change.select_rows(&self.independent)
    }
}

/// The coordinates that determine the others together with given ones.
pub fn beside(rest: &Rest<'_>, q: &DVector<f64>, given: &[usize]) -> Vec<usize> {
    let (tangent, scales) = (rest.tangent(q), rest.scales());
    let directions = &tangent.directions;
    let mut left =
        DMatrix::from_fn(q.len(), directions.ncols(), |row, column| directions[(row, column)] / scales[row]);
    for at in given {
        take(&mut left, *at);
    }
    chosen(rest.mechanism.info(), left, given.len())
}

/// Greedily by what is left of the rows of N, without the directions of rows that were taken.
fn chosen(info: &Info, mut left: DMatrix<f64>, given: usize) -> Vec<usize> {
    let mut taken = Vec::new();
    for _ in given..left.ncols() {
        let sizes: Vec<f64> = left.row_iter().map(|row| row.norm()).collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let is_long = |at: &usize| sizes[*at] >= SHARE * largest;
        let is_angle = |at: &usize| info.coordinates[*at].dimension.length == 0;
        let mut candidates = (0..sizes.len()).filter(is_long);
        let Some(at) = candidates.clone().find(is_angle).or_else(|| candidates.next()) else { break };
        take(&mut left, at);
        taken.push(at);
    }
    taken.sort_unstable();
    taken
}

/// Takes the direction of a row away from all rows; gives the length that it had.
fn take(left: &mut DMatrix<f64>, at: usize) -> f64 {
    let row = left.row(at).transpose();
    let length = row.norm();
    if length > 0.0 {
        let unit = row / length;
        let shares = &*left * &unit;
        *left -= shares * unit.transpose();
    }
    length
}

fn asked(info: &Info, moves: &DMatrix<f64>, names: &[String]) -> Result<Vec<usize>, Error> {
    let signals = Signal::coordinates(info, names)?;
    let at = |signal: &Signal| match signal.variable {
        Variable::Coordinate(at) => Some(at),
        _ => None,
    };
    let places: Vec<usize> = signals.iter().filter_map(at).collect();
    let largest = moves.row_iter().map(|row| row.norm()).fold(0.0, f64::max);
    let mut left = moves.clone();
    let is_independent = places.iter().all(|&at| take(&mut left, at) > INDEPENDENT * largest);
    if places.len() == moves.ncols() && is_independent { Ok(places) } else { Err(dependent(info, &places)) }
}

fn dependent(info: &Info, places: &[usize]) -> Error {
    let names = places.iter().filter_map(|&at| info.coordinates.get(at)).map(|q| q.name.to_owned());
    Error::Dependent { coordinates: names.collect(), dof: info.dof }
}
