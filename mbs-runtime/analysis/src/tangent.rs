//! Motions that the constraints leave free, in minimal coordinates.
//!
//! The directions come from a QR decomposition of Φ_qᵀ with pivots, in which masses weigh the coordinates.
//! Everything here asks the mechanism on slices, so a type and a text are the same to it.

use mbs_runtime::equations::{At, Equations};
use nalgebra::{DMatrix, DVector};

use crate::difference::five_point;
use crate::singular::Singular;
use crate::{Error, rest};

/// A mechanism at rest, with its inputs and its time held.
#[derive(Clone, Copy)]
pub struct Rest<'a> {
    pub mechanism: &'a dyn Equations<f64>,
    pub t: f64,
    pub inputs: &'a [f64],
    /// The size of the mechanism in m.
    pub length: f64,
    /// The size of own states, in their units.
    pub states: f64,
}

/// The directions N in which positions can move: Φ_q N = 0.
///
/// N = W Y with orthonormal Y, where W has what each coordinate moves by under a unit of kinetic
/// energy, so that lengths and angles weigh alike.
pub struct Tangent {
    /// W, the diagonal of it.
    weights: DVector<f64>,
    /// Y
    orthonormal: DMatrix<f64>,
    /// N
    pub directions: DMatrix<f64>,
}

/// Rows whose part beside others is less than this share of the largest repeat them.
const DEPENDENT: f64 = 1e-9;
/// Newton's corrections of positions end before this.
const CORRECTIONS: usize = 50;

impl<'a> Rest<'a> {
    /// A mechanism whose size is that of its largest coordinate that is a length, at a position or at the
    /// declared start.
    pub fn new(mechanism: &'a dyn Equations<f64>, t: f64, inputs: &'a [f64], q: &[f64]) -> Self {
        /// Of a mechanism that stands at the origin, within a nanometre.
        const USUAL: f64 = 0.1;
        const NOTHING: f64 = 1e-9;
        let declared: Vec<f64> = mechanism.info().coordinates.iter().map(|q| q.default).collect();
        let rest = Self { mechanism, t, inputs, length: NOTHING, states: 1.0 }.grown(q).grown(&declared);
        Self { length: if rest.length > NOTHING { rest.length } else { USUAL }, ..rest }
    }

    /// The mechanism with a size of at least the largest length among the coordinates.
    pub fn grown(self, q: &[f64]) -> Self {
        let info = self.mechanism.info();
        let coordinates = info.coordinates.iter().zip(q);
        let lengths = coordinates.clone().take(info.lines).filter(|(q, _)| q.dimension.length != 0);
        let length = lengths.map(|(_, q)| q.abs()).fold(self.length, f64::max);
        let states = coordinates.skip(info.lines).map(|(z, value)| (value / unit_of(z)).abs());
        Self { length, states: states.fold(self.states, f64::max), ..self }
    }

    /// 1 rad for an angle, the size of the mechanism for a length; for an own state several times what it was,
    /// so that a search may enlarge it.
    pub fn scales(&self) -> DVector<f64> {
        const GROWTH: f64 = 16.0;
        let info = self.mechanism.info();
        let scale = |at: usize| match info.coordinates[at].dimension.length {
            _ if info.is_own(at) => GROWTH * self.states * unit_of(&info.coordinates[at]),
            0 => 1.0,
            _ => self.length,
        };
        DVector::from_fn(info.coordinates.len(), |at, _| scale(at))
    }

    /// How far a displacement leads, or what an acceleration is, measured by the scales of the coordinates: the
    /// largest share, or no number if one is none.
    pub fn measure(&self, w: &DVector<f64>) -> f64 {
        let shares = w.component_div(&self.scales());
        if shares.iter().any(|share| share.is_nan()) { f64::NAN } else { shares.amax() }
    }

    /// Stiffnesses are zero that are less than this share of the largest one: a hundred times the error of a
    /// derivative, by the chain rule or by differences.
    pub fn resolution(&self) -> f64 {
        if self.mechanism.is_differentiable() { 1e-12 } else { 1e-9 }
    }

    /// Where a displacement leads on the constraints.
    ///
    /// # Errors
    /// [`NotAssembled`](mbs_runtime::Error::NotAssembled).
    pub fn moved(&self, q: &DVector<f64>, step: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let mut next = q + step;
        self.assemble(&mut next)?;
        Ok(next)
    }

    /// Moves positions onto the constraints, as little as possible in the norm of the mass matrix.
    ///
    /// # Errors
    /// [`NotAssembled`](mbs_runtime::Error::NotAssembled).
    pub fn assemble(&self, q: &mut DVector<f64>) -> Result<(), Error> {
        let info = self.mechanism.info();
        let mut phi = self.violation(q);
        let mut size = f64::NAN;
        for _ in 0..CORRECTIONS {
            let delta = self.correction(q, &phi);
            size = self.measure(&delta);
            if !size.is_finite() {
                break;
            }
            // far from the constraints a full correction may overshoot
            *q -= delta * (0.5 / size).min(1.0);
            if size < 1e-14 * (1.0 + q.amax()) {
                return Ok(());
            }
            phi = self.violation(q);
        }
        let row = if phi.is_empty() { 0 } else { phi.icamax() };
        let violation = phi.amax();
        // at rounding Newton's method may circle; at a singular position a correction is no number
        if size.is_finite() && violation <= 1e-13 * (1.0 + q.amax()) {
            return Ok(());
        }
        let constraint = info.constraints.get(row).map_or("", |constraint| constraint.name);
        Err(mbs_runtime::Error::NotAssembled { t: self.t, constraint, violation }.into())
    }

    /// q̈ from rest, and λ, with drives that stand still: Φ_q q̈ = 0.
    pub fn acceleration(&self, q: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let (a, multipliers) = rest::acceleration(self.mechanism, self.t, q.as_slice(), self.inputs);
        (DVector::from_vec(a), DVector::from_vec(multipliers))
    }

    /// Φ
    pub fn violation(&self, q: &DVector<f64>) -> DVector<f64> {
        let mut phi = DVector::zeros(self.mechanism.info().constraints.len());
        self.mechanism.phi(self.t, q.as_slice(), phi.as_mut_slice());
        phi
    }

    /// Φ̇
    pub fn violation_rate(&self, q: &DVector<f64>, v: &DVector<f64>) -> DVector<f64> {
        let mut rate = DVector::zeros(self.mechanism.info().constraints.len());
        self.mechanism.phi_dot(At { t: self.t, q: q.as_slice(), v: v.as_slice() }, rate.as_mut_slice());
        rate
    }

    /// The smallest Δ, in the norm of the mass matrix, with Φ_q Δ = `violation`. Where constraints repeat
    /// others, all of them are asked, in the sense of least squares: those that a run solves for may depend
    /// on each other at a position that is regular.
    pub fn correction(&self, q: &DVector<f64>, violation: &DVector<f64>) -> DVector<f64> {
        if self.mechanism.info().redundant.is_empty() {
            let mut delta = DVector::zeros(q.len());
            self.mechanism.projection(self.t, q.as_slice(), violation.as_slice(), delta.as_mut_slice());
            return delta;
        }
        let weights = self.weights(q);
        let rows = self.weighed_rows(q, &weights);
        if rows.iter().any(|x| !x.is_finite()) {
            return DVector::from_element(q.len(), f64::NAN);
        }
        let decomposition = Singular::new(&rows);
        decomposition.solve(violation, DEPENDENT * decomposition.values.amax()).component_mul(&weights)
    }

    /// W, by which coordinates weigh alike; see [`Tangent`].
    fn weights(&self, q: &DVector<f64>) -> DVector<f64> {
        let n = q.len();
        let mass = |at: usize| 2.0 * self.kinetic_energy(q, &unit(n, at));
        let masses: Vec<f64> = (0..n).map(mass).collect();
        let lightest = masses.iter().copied().filter(|mass| *mass > 0.0).fold(f64::INFINITY, f64::min);
        let lightest = if lightest.is_finite() { lightest } else { 1.0 };
        DVector::from_fn(n, |at, _| 1.0 / if masses[at] > 0.0 { masses[at] } else { lightest }.sqrt())
    }

    /// Φ_q W
    fn weighed_rows(&self, q: &DVector<f64>, weights: &DVector<f64>) -> DMatrix<f64> {
        let n = q.len();
        let mut rows = DMatrix::zeros(self.mechanism.info().constraints.len(), n);
        for at in 0..n {
            rows.set_column(at, &self.along(q, &(unit(n, at) * weights[at])));
        }
        rows
    }

    /// Φ_q w
    pub fn along(&self, q: &DVector<f64>, w: &DVector<f64>) -> DVector<f64> {
        self.violation_rate(q, w) - self.violation_rate(q, &DVector::zeros(q.len()))
    }

    /// vᵀMv/2
    fn kinetic_energy(&self, q: &DVector<f64>, v: &DVector<f64>) -> f64 {
        self.mechanism.kinetic_energy(At { t: self.t, q: q.as_slice(), v: v.as_slice() })
    }

    /// The directions that are free at a position on the constraints.
    pub fn tangent(&self, q: &DVector<f64>) -> Tangent {
        let info = self.mechanism.info();
        let (n, lines, m) = (q.len(), info.lines, info.constraints.len());
        let weights = self.weights(q);
        // Φ_qᵀ = QR with the rows of Φ_q in the order of what is left of them: behind as many columns as
        // rows are independent, Q spans the directions that Φ_q does not see; square, to have all of Q
        let mut transposed = DMatrix::zeros(lines, lines.max(m));
        let rows = self.weighed_rows(q, &weights);
        transposed.columns_mut(0, m).copy_from(&rows.columns(0, lines).transpose());
        for mut row in transposed.column_iter_mut() {
            let size = row.amax();
            if size > 0.0 {
                row /= size;
            }
        }
        let free = usize::try_from(info.dof).unwrap_or(0).min(lines);
        let mut orthonormal = DMatrix::zeros(n, free);
        if free > 0 {
            let all = transposed.col_piv_qr().q();
            orthonormal.rows_mut(0, lines).copy_from(&all.columns(lines - free, free));
        }
        let directions = DMatrix::from_fn(n, free, |row, column| weights[row] * orthonormal[(row, column)]);
        Tangent { weights, orthonormal, directions }
    }

    /// The same, and behind them a direction for each own state.
    pub fn unknowns(&self, q: &DVector<f64>) -> Tangent {
        let Tangent { weights, orthonormal, .. } = self.tangent(q);
        let (n, free, lines) = (q.len(), orthonormal.ncols(), self.mechanism.info().lines);
        let mut orthonormal = orthonormal.insert_columns(free, n - lines, 0.0);
        (lines..n).for_each(|at| orthonormal[(at, free + at - lines)] = 1.0);
        let directions =
            DMatrix::from_fn(n, orthonormal.ncols(), |row, column| weights[row] * orthonormal[(row, column)]);
        Tangent { weights, orthonormal, directions }
    }

    /// M_r = NᵀMN, from kinetic energies.
    pub fn reduced_mass(&self, q: &DVector<f64>, tangent: &Tangent) -> DMatrix<f64> {
        let directions = &tangent.directions;
        let energy = |v: &DVector<f64>| self.kinetic_energy(q, v);
        let column = |at: usize| directions.column(at).clone_owned();
        let free = directions.ncols();
        DMatrix::from_fn(free, free, |i, j| {
            let (a, b) = (column(i), column(j));
            energy(&(&a + &b)) - energy(&a) - energy(&b)
        })
    }

    /// A_r of z̈ = A_r z: how z̈ from rest changes along the free directions.
    pub fn stiffness_rate(&self, q: &DVector<f64>, tangent: &Tangent) -> DMatrix<f64> {
        let rates = self.rates(q, &tangent.directions);
        let mut reduced = DMatrix::zeros(rates.ncols(), rates.ncols());
        for (at, rate) in rates.column_iter().enumerate() {
            reduced.set_column(at, &tangent.minimal(&rate.into_owned()));
        }
        reduced
    }

    /// How q̈ from rest changes along directions, a column each: by the chain rule where the equations can be
    /// had over duals, else by the five-point formula.
    fn rates(&self, q: &DVector<f64>, directions: &DMatrix<f64>) -> DMatrix<f64> {
        if let Some(rates) = rest::rates(self, q, directions) {
            return rates;
        }
        let scales = self.scales();
        let mut rates = DMatrix::zeros(q.len(), directions.ncols());
        for (at, direction) in directions.column_iter().enumerate() {
            let largest = direction.component_div(&scales).amax();
            let there = |share: f64| self.acceleration(&(q + direction * share)).0;
            rates.set_column(at, &five_point(there, if largest > 0.0 { 1.0 / largest } else { 1.0 }));
        }
        rates
    }

    /// The first coordinate whose acceleration from rest has no derivative at a position.
    pub fn without_derivative(&self, q: &DVector<f64>) -> Option<usize> {
        let rates = self.rates(q, &self.tangent(q).directions);
        rates.row_iter().position(|row| row.iter().any(|rate| !rate.is_finite()))
    }
}

/// One unit of an own state, in SI units.
fn unit_of(state: &mbs_runtime::Quantity) -> f64 {
    if state.scale > 0.0 { state.scale } else { 1.0 }
}

/// The direction in which one coordinate moves.
fn unit(n: usize, at: usize) -> DVector<f64> {
    DVector::from_fn(n, |other, _| f64::from(u8::from(at == other)))
}

impl Tangent {
    /// z of w = N z, for a w that is along the constraints.
    pub fn minimal(&self, w: &DVector<f64>) -> DVector<f64> {
        self.orthonormal.transpose() * w.component_div(&self.weights)
    }

    /// How large z may be of a w of these sizes.
    pub fn minimal_sizes(&self, sizes: &DVector<f64>) -> DVector<f64> {
        self.orthonormal.transpose().abs() * sizes.component_div(&self.weights)
    }
}
