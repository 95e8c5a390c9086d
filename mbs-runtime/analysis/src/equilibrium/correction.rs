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
    /// N z. The solution is that of least norm, so that a direction without stiffness is not moved along; with own
    /// states it is that by which nothing changes that no motion changes.
    pub step: DVector<f64>,
    /// Its length, measured by the scales.
    pub length: f64,
    /// How much of the length may be rounding. Accelerations are rounded in proportion to the stiffest
    /// direction, and the softest direction turns that into a displacement.
    pub rounding: f64,
    /// The part of z̈ in directions without stiffness, a number per coordinate and own state.
    left: DVector<f64>,
    /// That part of coordinates, in scales per s².
    left_of_lines: f64,
    /// The size of A_r in 1/s².
    rate: f64,
    /// What the terms of each coordinate's z̈ may be: the sum of its row of A_r, each entry times the scale of what it
    /// is multiplied with.
    terms: DVector<f64>,
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
        let lines = rest.mechanism.info().lines;
        let mut z = decomposition.solve(&right, zero);
        if lines < q.len() {
            z = kept(&decomposition, zero, z);
        }
        let left = &tangent.directions * (right - system * &z);
        let terms = tangent.directions.abs() * (rate.abs() * tangent.minimal_sizes(&rest.scales()));
        let of_lines = DVector::from_fn(left.len(), |at, _| if at < lines { left[at] } else { 0.0 });
        let step = tangent.directions * z;
        let (length, rounding) = (rest.measure(&step), ROUNDING * stiffest / softest);
        let left_of_lines = rest.measure(&of_lines);
        let rate = rate.amax();
        length.is_finite().then_some(Self { step, length, rounding, left, left_of_lines, rate, terms })
    }

    /// True if what acts in directions without stiffness is a rounding of accelerations as large as
    /// `strongest`, in scales per s².
    ///
    /// The rate of an own state that nothing brings to rest stays as it is while the state, and the scale with it,
    /// grows. So it is compared with its own terms, and with the scales `at_first`.
    pub fn is_balanced(&self, strongest: f64, at_first: &Rest<'_>) -> bool {
        let lines = at_first.mechanism.info().lines;
        let scales = at_first.scales();
        let is_small = |at: usize| {
            let scale = (ROUNDING * strongest + STILL) * scales[at];
            self.left[at].abs() <= ROUNDING * self.terms[at] + scale
        };
        let is_still = self.left_of_lines <= ROUNDING * (strongest + self.rate) + STILL;
        is_still && (lines..self.left.len()).all(is_small)
    }
}

/// The solution that keeps what no motion changes: yᵀz = 0 for each y with yᵀA = 0, such as a state whose rate is 0. It
/// differs from `z` by vectors x with A x = 0; where these do not change it, `z` stays.
fn kept(decomposition: &Singular, zero: f64, z: DVector<f64>) -> DVector<f64> {
    let order = decomposition.values.iter().enumerate();
    let vanishing: Vec<usize> = order.filter(|(_, value)| **value <= zero).map(|(at, _)| at).collect();
    if vanishing.is_empty() {
        return z;
    }
    let left = decomposition.u.select_columns(&vanishing);
    let right = decomposition.v_t.select_rows(&vanishing).transpose();
    let share = (left.transpose() * &right).try_inverse().map(|inverse| inverse * (left.transpose() * &z));
    match share {
        Some(share) if share.iter().all(|x| x.is_finite()) => z - right * share,
        _ => z,
    }
}
