//! Least squares over unknowns that all positions share and coordinates of each position alone.
//!
//! The Jacobian has a block for each position j: A_j by its coordinates, B_j by the unknowns,
//!
//! ```text
//! ⎡ A₁         B₁ ⎤ ⎡δq₁⎤     ⎡r₁⎤
//! ⎢    ⋱       ⋮  ⎥ ⎢ ⋮ ⎥ = − ⎢⋮ ⎥
//! ⎣       A_n  B_n⎦ ⎣δp ⎦     ⎣r_n⎦
//! ```
//!
//! and a damping row √μ D for each unknown. A Householder triangle of each block takes the coordinates out;
//! what is left over of all blocks is a small system of the unknowns.

use nalgebra::{DMatrix, DVector};

/// The residuals at a position, with their derivatives.
pub struct Block {
    pub residuals: DVector<f64>,
    /// A
    pub by_coordinates: DMatrix<f64>,
    /// B
    pub by_unknowns: DMatrix<f64>,
}

/// δq of every position, and δp.
pub struct Step {
    pub coordinates: Vec<DVector<f64>>,
    pub unknowns: DVector<f64>,
}

/// The damped step of Gauss and Newton; `held` says which unknowns stay where they are, and `scales` are
/// the sizes by which changes of coordinates and of unknowns are measured.
pub fn step(blocks: &[Block], damping: f64, scales: [&DVector<f64>; 2], held: &[bool]) -> Option<Step> {
    let [of_q, of_p] = scales;
    let (n, p) = (of_q.len(), of_p.len());
    let root = damping.sqrt();
    let mut triangles = Vec::with_capacity(blocks.len());
    let mut left = Vec::with_capacity(blocks.len());
    for block in blocks {
        let m = block.residuals.len();
        let mut all = DMatrix::zeros(m + n, n + p + 1);
        all.view_mut((0, 0), (m, n)).copy_from(&block.by_coordinates);
        all.view_mut((0, n), (m, p)).copy_from(&block.by_unknowns);
        for (at, _) in held.iter().enumerate().filter(|(_, held)| **held) {
            all.column_mut(n + at).fill(0.0);
        }
        all.view_mut((0, n + p), (m, 1)).copy_from(&-&block.residuals);
        (0..n).for_each(|at| all[(m + at, at)] = root / of_q[at]);
        let r = all.qr().r();
        let rest = r.nrows().saturating_sub(n);
        left.push(r.view((n, n), (rest, p + 1)).clone_owned());
        triangles.push(r.rows(0, n).clone_owned());
    }
    let rows: usize = left.iter().map(DMatrix::nrows).sum();
    let mut shared = DMatrix::zeros(rows + p, p + 1);
    let mut row = 0;
    for left in &left {
        shared.view_mut((row, 0), left.shape()).copy_from(left);
        row += left.nrows();
    }
    (0..p).for_each(|at| shared[(rows + at, at)] = root / of_p[at]);
    let r = shared.qr().r();
    let unknowns = r.view((0, 0), (p, p)).clone_owned().solve_upper_triangular(&r.column(p).rows(0, p))?;
    let solve = |triangle: &DMatrix<f64>| {
        let right = triangle.column(n + p) - triangle.columns(n, p) * &unknowns;
        triangle.columns(0, n).clone_owned().solve_upper_triangular(&right)
    };
    let coordinates = triangles.iter().map(solve).collect::<Option<Vec<_>>>()?;
    Some(Step { coordinates, unknowns })
}

/// ½|r|² of all blocks.
pub fn cost(blocks: &[Block]) -> f64 {
    0.5 * blocks.iter().map(|block| block.residuals.norm_squared()).sum::<f64>()
}

/// By how much that falls along a step if residuals are linear.
pub fn fall(blocks: &[Block], step: &Step) -> f64 {
    let of = |(block, change): (&Block, &DVector<f64>)| {
        let change = &block.by_coordinates * change + &block.by_unknowns * &step.unknowns;
        -change.dot(&block.residuals) - 0.5 * change.norm_squared()
    };
    blocks.iter().zip(&step.coordinates).map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::singular::Singular;

    /// The step is that of the whole system with its damping rows.
    #[test]
    fn the_step_is_that_of_the_whole_system() {
        let number = |seed: usize| ((seed as f64 * 12.9898).sin() * 43_758.547).fract();
        let matrix = |rows: usize, columns: usize, seed: usize| {
            DMatrix::from_fn(rows, columns, |a, b| number(seed + 31 * a + 7 * b))
        };
        let (n, p, m, positions, damping) = (3, 2, 4, 3, 0.01);
        let block = |at: usize| Block {
            residuals: matrix(m, 1, 3 * at).column(0).clone_owned(),
            by_coordinates: matrix(m, n, 100 + at),
            by_unknowns: matrix(m, p, 200 + at),
        };
        let blocks: Vec<Block> = (0..positions).map(block).collect();
        let scales = [DVector::from_vec(vec![1.0, 2.0, 0.5]), DVector::from_vec(vec![1.0, 3.0])];
        let found = step(&blocks, damping, [&scales[0], &scales[1]], &[false; 2]).unwrap();
        let unknowns = positions * n + p;
        let mut whole = DMatrix::zeros(positions * m + unknowns, unknowns);
        let mut right = DVector::zeros(positions * m + unknowns);
        for (at, block) in blocks.iter().enumerate() {
            whole.view_mut((at * m, at * n), (m, n)).copy_from(&block.by_coordinates);
            whole.view_mut((at * m, positions * n), (m, p)).copy_from(&block.by_unknowns);
            right.rows_mut(at * m, m).copy_from(&-&block.residuals);
            (0..n).for_each(|k| whole[(positions * m + at * n + k, at * n + k)] = 0.1 / scales[0][k]);
        }
        for k in 0..p {
            whole[(positions * m + positions * n + k, positions * n + k)] = 0.1 / scales[1][k];
        }
        let expected = Singular::new(&whole).solve(&right, 0.0);
        for (at, change) in found.coordinates.iter().enumerate() {
            assert!((change - expected.rows(at * n, n)).norm() < 1e-12);
        }
        assert!((found.unknowns - expected.rows(positions * n, p)).norm() < 1e-12);
    }
}
