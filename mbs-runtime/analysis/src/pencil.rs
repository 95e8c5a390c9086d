//! The pencil of a linear system, whose eigenvalues and eigenvectors are modes of vibration.

use nalgebra::{Complex, DMatrix, DVector, Schur};

use crate::complex::null_vectors;
use crate::modes::{Mode, SMALL, behaviour, known};
use crate::singular::Singular;
use crate::{Error, Linearization};

/// Differences of coefficients give a stiffness this share of the largest one as well.
const ZERO: f64 = 1e-11;
/// A singular value of the pencil is 0 that is less than this share of it: rounding moves a double root by √ε.
pub(crate) const DEFECT: f64 = 1e-6;

/// λ²1 − λG − K in units of time 1/`rate` and coordinates y = `to` z in which the mass is 1.
pub(crate) struct Pencil {
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    /// In 1/s.
    pub rate: f64,
    to: DMatrix<f64>,
    back: DMatrix<f64>,
}

impl Pencil {
    pub fn of(linear: &Linearization) -> Self {
        let f = linear.dof();
        let [to, back] = unit_mass(linear);
        let within = |first: usize| &to * linear.a.view((f, first), (f, f)) * &back;
        let (stiffness, damping) = (within(0), within(f));
        let rate = stiffness.amax().sqrt().max(damping.amax());
        let rate = if rate > 0.0 { rate } else { 1.0 };
        Self { stiffness: stiffness / (rate * rate), damping: damping / rate, rate, to, back }
    }

    /// A change of ∂z̈/∂z or ∂z̈/∂ż in the coordinates y.
    pub fn changed(&self, of_z: &DMatrix<f64>) -> DMatrix<f64> {
        &self.to * of_z * &self.back
    }

    /// Orthonormal directions without stiffness, and those across.
    pub fn free_and_held(&self, uncertainty: f64) -> (DMatrix<f64>, DMatrix<f64>) {
        let f = self.stiffness.nrows();
        let Singular { values, v_t, .. } = Singular::new(&self.stiffness);
        let zero = ZERO.max(10.0 * uncertainty.min(1e-3)) * values.amax();
        let right = v_t.transpose();
        let (free, held): (Vec<usize>, Vec<usize>) = (0..f).partition(|at| values[*at] <= zero);
        (right.select_columns(&free), right.select_columns(&held))
    }

    /// Eigenvalues with Im λ ≥ 0, ascending by size, of the system of (a, ȧ, ḃ) with y = `held` a +
    /// `free` b, which b itself does not enter.
    pub fn roots(&self, free: &DMatrix<f64>, held: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, Error> {
        let (f, h) = (self.stiffness.nrows(), held.ncols());
        let all =
            DMatrix::from_fn(
                f,
                f,
                |row, column| {
                    if column < h { held[(row, column)] } else { free[(row, column - h)] }
                },
            );
        let mut system = DMatrix::zeros(h + f, h + f);
        system.view_mut((0, h), (h, h)).fill_with_identity();
        system.view_mut((h, 0), (f, h)).copy_from(&(all.transpose() * &self.stiffness * held));
        system.view_mut((h, h), (f, f)).copy_from(&(all.transpose() * &self.damping * &all));
        const ITERATIONS: usize = 10_000;
        let schur = Schur::try_new(system.clone(), f64::EPSILON, ITERATIONS);
        let Some(schur) = schur else { return Err(Error::Eigenvalues { decades: decades(&system) }) };
        let mut roots: Vec<Complex<f64>> = schur.complex_eigenvalues().iter().map(known).collect();
        roots.retain(|root| root.im >= 0.0);
        roots.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        Ok(roots)
    }

    /// The modes of equal eigenvalues. One that is double and has one shape alone, at critical damping, has
    /// that twice.
    pub fn modes(&self, linear: &Linearization, equal: &[Complex<f64>]) -> Vec<Mode> {
        let f = self.stiffness.nrows();
        let Some(&root) = equal.first() else { return Vec::new() };
        let entry = |row: usize, column: usize| {
            let unit = if row == column { root * root } else { Complex::from(0.0) };
            unit - root * self.damping[(row, column)] - self.stiffness[(row, column)]
        };
        let small = DEFECT * root.norm_sqr().max(1.0);
        let [right, left] = null_vectors(&DMatrix::from_fn(f, f, entry), equal.len().min(f), small);
        let pairs = right.into_iter().zip(left).cycle();
        let mode = |(root, [right, left]): (&Complex<f64>, [DVector<Complex<f64>>; 2])| Mode {
            vectors: [right.clone(), left],
            ..self.mode(linear, *root, &right)
        };
        equal.iter().zip(pairs.map(|(right, left)| [right, left])).map(mode).collect()
    }

    pub fn mode(&self, linear: &Linearization, root: Complex<f64>, y: &DVector<Complex<f64>>) -> Mode {
        let z = self.back.map(Complex::from) * y;
        let sizes: Vec<f64> =
            z.iter().zip(linear.scales_of_states()).map(|(z, scale)| z.norm() / scale).collect();
        // among equals the first, whatever rounding says
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let first = sizes.iter().position(|size| *size >= (1.0 - 1e-6) * largest);
        let unit = first.map(|at| z[at]).filter(|unit| unit.norm() > 0.0).unwrap_or(Complex::from(1.0));
        let shape = linear.directions.map(Complex::from) * (z / unit);
        let shape = DVector::from_fn(shape.len(), |at, _| {
            let small = SMALL * largest * linear.scales[at] / unit.norm();
            let known = |x: f64| if x.abs() > small { x } else { 0.0 };
            Complex::new(known(shape[at].re), known(shape[at].im))
        });
        let vectors = [y.clone(), y.clone()];
        Mode { eigenvalue: root * self.rate, shape, behaviour: behaviour(root), vectors }
    }
}

/// Lᵀ and L⁻ᵀ of M_r = L Lᵀ; the scales of the coordinates where a direction has no mass.
fn unit_mass(linear: &Linearization) -> [DMatrix<f64>; 2] {
    let factor = linear.mass.clone().cholesky().map(|factors| factors.l().transpose());
    let pair = factor.and_then(|to| to.clone().try_inverse().map(|back| [to, back]));
    pair.unwrap_or_else(|| {
        let f = linear.dof();
        [DMatrix::identity(f, f), DMatrix::identity(f, f)]
    })
}

/// The decades over which the entries of a matrix go.
pub(crate) fn decades(matrix: &DMatrix<f64>) -> f64 {
    let sizes = || matrix.iter().map(|x| x.abs()).filter(|x| *x > 0.0);
    let (low, high) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    (high / low).log10()
}
