//! The Jacobian of constraints and prescribed coordinates.

use crate::singular::Singular;
use mbs_runtime::equations::{At, Equations};
use nalgebra::{DMatrix, DVector, Dyn, LU, QR};

/// Singular values below this share of the largest are 0.
const SINGULAR: f64 = 1e-9;
/// Below this share they cannot be told from 0 where a coordinate turns back, as at a dead centre: Φ, which is known to ε, tells
/// a position there to √ε.
const FOLDED: f64 = 1e-7;

/// J = [Φ_q; 1_I] at a position.
///
/// It has a row for every constraint, also for those that repeat others: where the rows that a run
/// solves for depend on each other, all together may still be independent. J is factorized in numbers
/// without units: columns are multiplied by the scales of coordinates, rows divided by their largest
/// entry.
#[derive(Clone)]
pub struct Jacobian {
    /// Φ_q
    all: DMatrix<f64>,
    places: Vec<usize>,
    scales: DVector<f64>,
    /// The divisor of each row of J.
    sizes: DVector<f64>,
    scaled: DMatrix<f64>,
    factors: Factors,
}

/// J as a product.
#[derive(Clone)]
enum Factors {
    /// With as many rows as coordinates.
    Square(LU<f64, Dyn, Dyn>),
    /// With rows that repeat others, J = QR.
    Tall(QR<f64, Dyn, Dyn>),
}

impl Jacobian {
    pub fn at(
        mechanism: &dyn Equations<f64>,
        (t, q): (f64, &DVector<f64>),
        places: &[usize],
        scales: &DVector<f64>,
    ) -> Self {
        let info = mechanism.info();
        let (n, m) = (q.len(), info.constraints.len());
        let rate = |v: &DVector<f64>| {
            let mut rate = DVector::zeros(m);
            mechanism.phi_dot(At { t, q: q.as_slice(), v: v.as_slice() }, rate.as_mut_slice());
            rate
        };
        let at_rest = rate(&DVector::zeros(n));
        let mut all = DMatrix::zeros(m, n);
        let mut unit = DVector::zeros(n);
        for at in 0..n {
            unit[at] = scales[at];
            all.set_column(at, &((rate(&unit) - &at_rest) / scales[at]));
            unit[at] = 0.0;
        }
        let mut scaled = DMatrix::zeros(m + places.len(), n);
        scaled.rows_mut(0, m).copy_from(&all);
        for (row, place) in places.iter().enumerate() {
            scaled[(m + row, *place)] = 1.0;
        }
        for (mut column, scale) in scaled.column_iter_mut().zip(scales) {
            column *= *scale;
        }
        let size = |row: usize| scaled.row(row).amax();
        let sizes = DVector::from_fn(scaled.nrows(), |row, _| if size(row) > 0.0 { size(row) } else { 1.0 });
        for (mut row, size) in scaled.row_iter_mut().zip(&sizes) {
            row /= *size;
        }
        let factors = match scaled.is_square() {
            true => Factors::Square(scaled.clone().lu()),
            false => Factors::Tall(scaled.clone().qr()),
        };
        let (places, scales) = (places.to_vec(), scales.clone());
        Self { all, places, scales, sizes, scaled, factors }
    }

    /// x with Φ_q x = `rates` and x_I = `chosen`, in the sense of least squares where rows repeat others;
    /// not finite where J is singular.
    pub fn solve(&self, rates: &DVector<f64>, chosen: &DVector<f64>) -> DVector<f64> {
        let right = DVector::from_iterator(self.sizes.len(), rates.iter().chain(chosen).copied());
        let right = right.component_div(&self.sizes);
        let found = match &self.factors {
            Factors::Square(factors) => factors.solve(&right),
            Factors::Tall(factors) => factors.r().solve_upper_triangular(&factors.q().tr_mul(&right)),
        };
        let none = || DVector::from_element(self.scales.len(), f64::NAN);
        found.map_or_else(none, |x| x.component_mul(&self.scales))
    }

    /// N with Φ_q N = 0 and N_I = 1.
    pub fn directions(&self) -> DMatrix<f64> {
        let (n, f) = (self.scales.len(), self.places.len());
        let still = DVector::zeros(self.all.nrows());
        let mut directions = DMatrix::zeros(n, f);
        for at in 0..f {
            let unit = DVector::from_fn(f, |other, _| f64::from(u8::from(at == other)));
            directions.set_column(at, &self.solve(&still, &unit));
        }
        directions
    }

    /// λ and σ with Φ_qᵀλ + 1_Iᵀσ = `push`. Where rows repeat others, λ is the least one.
    pub fn balance(&self, push: &DVector<f64>) -> [DVector<f64>; 2] {
        let (m, f) = (self.all.nrows(), self.places.len());
        if !self.scaled.is_square() {
            return self.least_balance(push);
        }
        // Jᵀ y = push of J = sizes · scaled / scales
        let right = push.component_mul(&self.scales);
        let y = self.scaled.transpose().lu().solve(&right);
        let y = y.map_or_else(|| DVector::from_element(m + f, f64::NAN), |y| y.component_div(&self.sizes));
        [y.rows(0, m).clone_owned(), y.rows(m, f).clone_owned()]
    }

    fn least_balance(&self, push: &DVector<f64>) -> [DVector<f64>; 2] {
        let (m, n, f) = (self.all.nrows(), self.all.ncols(), self.places.len());
        let mut matrix = DMatrix::zeros(n, m + f);
        matrix.columns_mut(0, m).copy_from(&self.all.transpose());
        for (at, place) in self.places.iter().enumerate() {
            matrix[(*place, m + at)] = 1.0;
        }
        if matrix.iter().any(|x| !x.is_finite()) {
            return [DVector::from_element(m, f64::NAN), DVector::from_element(f, f64::NAN)];
        }
        let decomposition = Singular::new(&matrix);
        let y = decomposition.solve(push, SINGULAR * decomposition.values.amax());
        [y.rows(0, m).clone_owned(), y.rows(m, f).clone_owned()]
    }

    /// Rows of J that are independent here, as many as there are coordinates.
    pub fn independent(&self) -> Vec<usize> {
        let count = self.scaled.nrows();
        let mut rows = DMatrix::from_fn(1, count, |_, row| row);
        if let Factors::Tall(_) = self.factors {
            self.scaled.transpose().col_piv_qr().p().permute_columns(&mut rows);
        }
        rows.iter().take(self.scales.len()).copied().collect()
    }

    /// `true` if the determinant of these rows of J is positive.
    pub fn sign(&self, rows: &[usize]) -> bool {
        let factors = match &self.factors {
            Factors::Square(factors) => factors.clone(),
            Factors::Tall(_) => self.scaled.select_rows(rows).lu(),
        };
        let swaps: f64 = factors.p().determinant();
        let pivots = factors.lu_internal().diagonal();
        pivots.iter().fold(swaps, |sign, pivot| sign * pivot.signum()) > 0.0
    }

    /// True if a coordinate can move while the prescribed ones stand still.
    pub fn is_singular(&self) -> bool {
        let values = self.decomposed().map(|found| found.values);
        values.is_none_or(|values| values.min() <= FOLDED * values.max())
    }

    /// Where J is nearest to being singular: the constraint that keeps the mechanism from being led further,
    /// and the coordinate that moves most while the prescribed ones stand still.
    pub fn nearly_singular(&self) -> [usize; 2] {
        let Some(decomposition) = self.decomposed() else { return [0, 0] };
        let least = decomposition.values.imin();
        let rows = self.all.nrows();
        let row = if rows > 0 { decomposition.u.column(least).rows(0, rows).icamax() } else { 0 };
        [row, decomposition.v_t.row(least).transpose().icamax()]
    }

    /// Nothing of numbers that are not finite, on which the decomposition would not end.
    fn decomposed(&self) -> Option<Singular> {
        let is_finite = !self.scaled.is_empty() && self.scaled.iter().all(|x| x.is_finite());
        is_finite.then(|| Singular::new(&self.scaled))
    }

    /// The largest violation of a constraint, as a share of the scales.
    pub fn violation(&self, phi: &DVector<f64>) -> f64 {
        let size = |row: usize| self.all.row(row).transpose().component_mul(&self.scales).amax();
        let share = |(row, phi): (usize, &f64)| phi.abs() / size(row).max(f64::MIN_POSITIVE);
        phi.iter().enumerate().map(share).fold(0.0, f64::max)
    }
}
