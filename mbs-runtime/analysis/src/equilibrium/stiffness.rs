//! Stiffnesses of small displacements from rest.

use nalgebra::{DMatrix, DVector};

use crate::tangent::{Rest, Tangent};

/// κ and x of K_r x = κ M_r x, with the symmetric part of K_r = −M_r A_r.
pub struct Stiffness {
    /// κ in 1/s², ascending.
    pub values: Vec<f64>,
    /// −κ of the direction in which the mechanism falls away fastest, or 0 if there is none.
    pub falling: f64,
    /// N x for the first κ, with xᵀ M_r x = 1.
    pub weakest: DVector<f64>,
    /// M_r x for the first κ.
    momentum: DVector<f64>,
    tangent: Tangent,
}

impl Stiffness {
    /// Of a mechanism at rest at a position on the constraints; nothing where a derivative is no number.
    pub fn at(rest: &Rest<'_>, q: &DVector<f64>) -> Option<Self> {
        let tangent = rest.tangent(q);
        if tangent.directions.ncols() == 0 {
            let (weakest, momentum) = (DVector::zeros(q.len()), DVector::zeros(0));
            return Some(Self { values: Vec::new(), falling: 0.0, weakest, momentum, tangent });
        }
        let mass = rest.reduced_mass(q, &tangent);
        let stiffness = -(&mass * rest.stiffness_rate(q, &tangent));
        let symmetric = (&stiffness + stiffness.transpose()) * 0.5;
        if !symmetric.iter().all(|x| x.is_finite()) {
            return None;
        }
        let unit = || DMatrix::identity(mass.nrows(), mass.nrows());
        // without a mass the stiffness alone has the signs
        let lower = mass.clone().cholesky().map_or_else(unit, |factors| factors.l());
        // L⁻¹ K L⁻ᵀ with M = L Lᵀ, whose eigenvectors are Lᵀ x
        let half = lower.solve_lower_triangular(&symmetric)?;
        let reduced = lower.solve_lower_triangular(&half.transpose())?;
        let decomposition = reduced.symmetric_eigen();
        let first = decomposition.eigenvalues.imin();
        let x = lower.tr_solve_lower_triangular(&decomposition.eigenvectors.column(first))?;
        let mut values: Vec<f64> = decomposition.eigenvalues.iter().copied().collect();
        values.sort_by(f64::total_cmp);
        let largest = values.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let lowest = values.first().copied()?;
        let falling = if lowest < -rest.resolution() * largest { -lowest } else { 0.0 };
        Some(Self { values, falling, weakest: &tangent.directions * &x, momentum: mass * x, tangent })
    }

    /// The share of the first x in an acceleration: xᵀ M_r z̈.
    pub fn along_weakest(&self, acceleration: &DVector<f64>) -> f64 {
        self.momentum.dot(&self.tangent.minimal(acceleration))
    }
}
