//! The Jacobian of constraints and prescribed coordinates.

use mbs_runtime::equations::{At, Described};
use nalgebra::{DMatrix, DVector, Dyn, LU, SVD};

/// Singular values below this share of the largest are 0.
const SINGULAR: f64 = 1e-9;

/// J = [Φ_q; 1_I] at a position, with as many independent rows as coordinates.
///
/// It is factorized in numbers without units: columns are multiplied by the scales of coordinates, rows
/// divided by their largest entry.
#[derive(Clone)]
pub struct Jacobian {
    /// Φ_q, all rows.
    all: DMatrix<f64>,
    /// The rows that do not repeat others.
    independent: Vec<usize>,
    places: Vec<usize>,
    scales: DVector<f64>,
    /// What each row of J is divided by.
    sizes: DVector<f64>,
    scaled: DMatrix<f64>,
    factors: LU<f64, Dyn, Dyn>,
}

impl Jacobian {
    pub fn at(
        mechanism: &dyn Described<f64>,
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
        let independent: Vec<usize> = (0..m).filter(|row| !info.redundant.contains(row)).collect();
        let mut scaled = DMatrix::zeros(n, n);
        let constraints = independent.iter().map(|row| all.row(*row).into_owned());
        let chosen = places
            .iter()
            .map(|place| DVector::from_fn(n, |at, _| f64::from(u8::from(at == *place))).transpose());
        for (mut row, values) in scaled.row_iter_mut().zip(constraints.chain(chosen)) {
            row.copy_from(&values.component_mul(&scales.transpose()));
        }
        let sizes = DVector::from_fn(n, |row, _| {
            let size = scaled.row(row).amax();
            if size > 0.0 { size } else { 1.0 }
        });
        for (mut row, size) in scaled.row_iter_mut().zip(&sizes) {
            row /= *size;
        }
        let factors = scaled.clone().lu();
        let (places, scales) = (places.to_vec(), scales.clone());
        Self { all, independent, places, scales, sizes, scaled, factors }
    }

    /// x with Φ_q x = `rates` and x_I = `chosen`; not finite where J is singular. Rows that repeat others
    /// are not asked.
    pub fn solve(&self, rates: &DVector<f64>, chosen: &DVector<f64>) -> DVector<f64> {
        let right = rates.select_rows(&self.independent);
        let right = DVector::from_iterator(self.sizes.len(), right.iter().chain(chosen).copied());
        let n = right.len();
        let found = self.factors.solve(&right.component_div(&self.sizes));
        found.map_or_else(|| DVector::from_element(n, f64::NAN), |x| x.component_mul(&self.scales))
    }

    /// N with Φ_q N = 0 and N_I = 1.
    pub fn directions(&self) -> DMatrix<f64> {
        let (n, f) = (self.sizes.len(), self.places.len());
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
        if self.independent.len() < m {
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
        let decomposition = SVD::new(matrix, true, true);
        let least = SINGULAR * decomposition.singular_values.amax();
        let y = decomposition.solve(push, least).unwrap_or_else(|_| DVector::from_element(m + f, f64::NAN));
        [y.rows(0, m).clone_owned(), y.rows(m, f).clone_owned()]
    }

    /// Whether the determinant is positive.
    pub fn sign(&self) -> bool {
        let swaps: f64 = self.factors.p().determinant();
        let pivots = self.factors.lu_internal().diagonal();
        pivots.iter().fold(swaps, |sign, pivot| sign * pivot.signum()) > 0.0
    }

    /// Whether a coordinate can move while the prescribed ones stand still.
    pub fn is_singular(&self) -> bool {
        let values = self.decomposed().map(|found| found.singular_values);
        values.is_none_or(|values| values.min() <= SINGULAR * values.max())
    }

    /// Where J is nearest to being singular: the constraint that keeps the mechanism from being led further,
    /// and the coordinate that moves most while the prescribed ones stand still.
    pub fn nearly_singular(&self) -> [usize; 2] {
        let Some(decomposition) = self.decomposed() else { return [0, 0] };
        let least = decomposition.singular_values.imin();
        let rows = self.independent.len();
        let left = decomposition.u.filter(|_| rows > 0);
        let row = left.map_or(0, |left| left.column(least).rows(0, rows).icamax());
        let free = decomposition.v_t.map_or(0, |right| right.row(least).transpose().icamax());
        [self.independent.get(row).copied().unwrap_or(0), free]
    }

    /// Nothing of numbers that are not finite, on which the decomposition would not end.
    fn decomposed(&self) -> Option<SVD<f64, Dyn, Dyn>> {
        let is_finite = !self.scaled.is_empty() && self.scaled.iter().all(|x| x.is_finite());
        is_finite.then(|| self.scaled.clone().svd(true, true))
    }

    /// The largest violation of a constraint, as a share of the scales.
    pub fn violation(&self, phi: &DVector<f64>) -> f64 {
        let size = |row: usize| self.all.row(row).transpose().component_mul(&self.scales).amax();
        let share = |(row, phi): (usize, &f64)| phi.abs() / size(row).max(f64::MIN_POSITIVE);
        phi.iter().enumerate().map(share).fold(0.0, f64::max)
    }
}
