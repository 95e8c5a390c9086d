//! Complex matrices by real ones of twice the size, ⎡Re −Im; Im Re⎤, so that the decompositions of real
//! matrices, which are compiled once, serve both.

use crate::singular::Singular;
use nalgebra::{Complex, DMatrix, DVector, Schur};

type Matrix = DMatrix<Complex<f64>>;
type Vector = DVector<Complex<f64>>;

fn embedded(matrix: &Matrix) -> DMatrix<f64> {
    let (rows, columns) = matrix.shape();
    DMatrix::from_fn(2 * rows, 2 * columns, |row, column| {
        let entry = matrix[(row % rows, column % columns)];
        match (row < rows, column < columns) {
            (true, true) | (false, false) => entry.re,
            (true, false) => -entry.im,
            (false, true) => entry.im,
        }
    })
}

/// a + ib of (a, b).
fn unembedded(both: &[f64]) -> Vector {
    let n = both.len() / 2;
    DVector::from_fn(n, |at, _| Complex::new(both[at], both[n + at]))
}

/// The solution of `matrix` x = `right`, unless the matrix is singular.
pub fn solved(matrix: &Matrix, right: &Matrix) -> Option<Matrix> {
    let n = right.nrows();
    let stacked = DMatrix::from_fn(2 * n, right.ncols(), |row, column| {
        let entry = right[(row % n, column)];
        if row < n { entry.re } else { entry.im }
    });
    let found = embedded(matrix).lu().solve(&stacked)?;
    let entry = |row: usize, column: usize| Complex::new(found[(row, column)], found[(n + row, column)]);
    Some(DMatrix::from_fn(n, right.ncols(), entry))
}

/// All eigenvalues of a small matrix, unless the QR algorithm does not converge.
pub fn eigenvalues(matrix: &Matrix) -> Option<Vec<Complex<f64>>> {
    if matrix.nrows() == 1 {
        return Some(vec![matrix[(0, 0)]]);
    }
    // the real matrix has those of the conjugate too, which a shift puts on the other side of the real axis
    let shift = Complex::new(0.0, 2.0 * matrix.norm());
    let shifted = matrix + DMatrix::from_diagonal_element(matrix.nrows(), matrix.nrows(), shift);
    let schur = Schur::try_new(embedded(&shifted), f64::EPSILON, 1000)?;
    let all = schur.complex_eigenvalues();
    let mut above: Vec<Complex<f64>> = all.iter().copied().collect();
    above.sort_by(|a, b| b.im.total_cmp(&a.im));
    above.truncate(matrix.nrows());
    Some(above.into_iter().map(|value| value - shift).collect())
}

/// Right and left vectors, matrix · z ≈ 0 and yᴴ · matrix ≈ 0: orthonormal ones, at most `most`, of singular values
/// below `small`, and the best one if there is none.
pub fn null_vectors(matrix: &Matrix, most: usize, small: f64) -> [Vec<Vector>; 2] {
    let Singular { u: columns, values, v_t } = Singular::new(&embedded(matrix));
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    // every vector comes with i times it
    order.truncate(2 * most);
    let count = order.iter().filter(|at| values[**at] <= small).count().div_ceil(2).max(1);
    order.truncate(2 * count);
    [v_t.transpose(), columns].map(|all| {
        let candidates = order.iter().filter(|at| **at < all.ncols());
        let candidates = candidates.map(|at| unembedded(all.column(*at).as_slice())).collect();
        independent(candidates, count)
    })
}

/// Some orthonormal vectors, the longest first of what is left without the ones before.
fn independent(mut candidates: Vec<Vector>, count: usize) -> Vec<Vector> {
    let mut found = Vec::new();
    for _ in 0..count {
        let norms = candidates.iter().map(|vector| vector.norm());
        // among equals the first, whatever rounding says
        let longest = norms.clone().fold(0.0, f64::max);
        let Some(at) = norms.clone().position(|norm| norm >= (1.0 - 1e-6) * longest) else { break };
        let unit = candidates.swap_remove(at);
        let unit = &unit / Complex::from(unit.norm());
        for candidate in &mut candidates {
            *candidate -= &unit * unit.dotc(candidate);
        }
        found.push(unit);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complex(re: f64, im: f64) -> Complex<f64> {
        Complex::new(re, im)
    }

    #[test]
    fn a_complex_matrix_is_solved_and_has_its_eigenvalues() {
        let matrix = DMatrix::from_row_slice(
            2,
            2,
            &[complex(1.0, 2.0), complex(0.0, -1.0), complex(3.0, 0.0), complex(-2.0, 1.0)],
        );
        let right = DMatrix::from_row_slice(2, 1, &[complex(1.0, 0.0), complex(0.0, 4.0)]);
        let x = solved(&matrix, &right).expect("regular");
        assert!((&matrix * x - right).norm() < 1e-14);
        let values = eigenvalues(&matrix).expect("they converge");
        assert!((values[0] + values[1] - matrix.trace()).norm() < 1e-13);
        let determinant = matrix[(0, 0)] * matrix[(1, 1)] - matrix[(0, 1)] * matrix[(1, 0)];
        assert!((values[0] * values[1] - determinant).norm() < 1e-12);
    }

    #[test]
    fn null_vectors_are_as_many_as_there_are() {
        // of rank 1: two right and two left vectors, independent of each other
        let column = DVector::from_row_slice(&[complex(1.0, 1.0), complex(0.0, 2.0), complex(-1.0, 0.5)]);
        let matrix = &column * column.map(|x| x * complex(0.3, -1.0)).transpose();
        let [right, left] = null_vectors(&matrix, 3, 1e-9);
        assert_eq!((right.len(), left.len()), (2, 2));
        for (z, y) in right.iter().zip(&left) {
            let (of_z, of_y) = ((&matrix * z).norm(), (y.adjoint() * &matrix).norm());
            assert!(of_z < 1e-13 && of_y < 1e-13, "{of_z} {of_y}");
        }
        assert!(right[0].dotc(&right[1]).norm() < 1e-13);
    }
}
