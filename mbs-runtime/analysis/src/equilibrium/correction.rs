//! A correction of a position by Newton's method.

use nalgebra::{DMatrix, DVector};

use crate::singular::Singular;
use crate::tangent::Rest;

/// Accelerations are rounded by up to this share of their terms, in scales per s².
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Accelerations are rounded by up to this many scales per s², whatever their terms are.
const STILL: f64 = 1e-11;

/// The displacement N z, of positions and own states, that takes an acceleration q̈ away: (s − A_r) z = z̈, with z̈ of q̈ and
/// A_r = ∂z̈/∂z.
pub struct Correction {
    /// N z. The solution is that of least norm, so that a direction without stiffness is not moved along.
    pub step: DVector<f64>,
    /// Its length, measured by the scales.
    pub length: f64,
    /// How much of the length may be rounding. Accelerations are rounded in proportion to the stiffest
    /// direction, and the softest direction turns that into a displacement.
    pub rounding: f64,
    /// The part of z̈ in directions without stiffness, in scales per s².
    left: f64,
    /// The size of A_r in 1/s².
    rate: f64,
}

impl Correction {
    /// At a position on the constraints; nothing where a derivative is no number.
    pub fn at(rest: &Rest<'_>, q: &DVector<f64>, acceleration: &DVector<f64>, s: f64) -> Option<Self> {
        let tangent = rest.unknowns(q);
        let rate = rest.stiffness_rate(q, &tangent);
        let system = DMatrix::identity(rate.nrows(), rate.nrows()) * s - &rate;
        let right = tangent.minimal(acceleration);
        if !system.iter().chain(&right).all(|x| x.is_finite()) {
            return None;
        }
        let decomposition = Singular::new(&system);
        let values = &decomposition.values;
        let (stiffest, zero) = (values.amax(), rest.resolution() * values.amax());
        let softest = values.iter().copied().filter(|x| *x > zero).fold(f64::INFINITY, f64::min);
        let z = decomposition.solve(&right, zero);
        let left = rest.measure(&(&tangent.directions * (right - system * &z)));
        let step = tangent.directions * z;
        let (length, rounding) = (rest.measure(&step), ROUNDING * stiffest / softest);
        length.is_finite().then_some(Self { step, length, rounding, left, rate: rate.amax() })
    }

    /// True if what acts in directions without stiffness is a rounding of accelerations as large as
    /// `strongest`, in scales per s².
    pub fn is_balanced(&self, strongest: f64) -> bool {
        self.left <= ROUNDING * (strongest + self.rate) + STILL
    }
}
