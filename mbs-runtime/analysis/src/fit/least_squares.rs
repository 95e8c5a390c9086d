//! Sums of squares made smallest within bounds, by the method of Levenberg and Marquardt.
//!
//! The Jacobian J of the residuals r is decomposed once in each iteration, J D⁻¹ = U S Vᵀ with D the
//! largest norms that its columns had, and gives the step of every damping μ that is tried:
//!
//! ```text
//! (JᵀJ + μD²) δ = −Jᵀr      δ = −D⁻¹ V S (S² + μ)⁻¹ Uᵀr
//! ```
//!
//! Source: J. J. Moré, The Levenberg–Marquardt algorithm: implementation and theory, Lecture Notes in
//! Mathematics 630 (1978) 105-116, for D; K. Madsen, H. B. Nielsen, O. Tingleff, Methods for non-linear
//! least squares problems, 2nd ed., DTU 2004, algorithm 3.16, for μ. Steps are cut at the bounds, and
//! variables at a bound from which the sum falls outwards are held.
//!
//! # Why it is our own
//!
//! The crate of that name stands on another nalgebra, which would be compiled beside this one. It knows no
//! bounds.

use crate::singular::Singular;
use nalgebra::{DMatrix, DVector};

/// Residuals and their derivatives.
pub struct Local {
    /// r
    pub residuals: DVector<f64>,
    /// J = ∂r/∂x
    pub jacobian: DMatrix<f64>,
}

/// When the iteration ends.
#[derive(Clone, Copy)]
pub struct Stop {
    /// After so many iterations.
    pub iterations: usize,
    /// Where the sum would fall by less than this part of itself, or x change by less than this part of
    /// itself in the norm of D.
    pub change: f64,
}

/// Where the iteration ended.
pub struct Minimum {
    pub x: DVector<f64>,
    pub local: Local,
    /// ½|r|²
    pub cost: f64,
    pub has_converged: bool,
}

impl Local {
    fn cost(&self) -> f64 {
        0.5 * self.residuals.norm_squared()
    }

    fn is_finite(&self) -> bool {
        // so that the decomposition of numbers whose squares are none is not tried
        self.residuals.norm_squared().is_finite() && self.jacobian.norm_squared().is_finite()
    }
}

/// The damping at the start, where 1 is the square of a column of J D⁻¹.
const FIRST: f64 = 1e-3;
/// Where no step makes the sum smaller, the last is this far damped.
const LARGEST: f64 = 1e16;

/// A variable that cannot be negative changes by this factor in a step at most: far from the minimum, a step
/// may ask for a stiffness or a mass of which a run would take for ever.
const FARTHEST: f64 = 4.0;

/// Makes the sum small from `x` on, which lies within the bounds. `of` gives nothing where x is refused;
/// the result is nothing if that is so at the start.
pub fn minimize(
    of: &mut dyn FnMut(&DVector<f64>) -> Option<Local>,
    x: DVector<f64>,
    bounds: &[[f64; 2]],
    stop: Stop,
) -> Option<Minimum> {
    let local = of(&x).filter(Local::is_finite)?;
    let mut here = Minimum { cost: local.cost(), x, local, has_converged: false };
    let mut scales = DVector::zeros(here.x.len());
    let (mut damping, mut growth) = (FIRST, 2.0);
    for _ in 0..stop.iterations {
        grow(&mut scales, &here.local.jacobian);
        let Some(steps) = Steps::new(&here, &scales, bounds) else {
            here.has_converged = true;
            break;
        };
        let x_size = here.x.component_mul(&scales).norm();
        loop {
            let x = within(&here.x + steps.of(damping), &here.x, bounds);
            let change = &x - &here.x;
            let predicted = steps.fall(&here, &change);
            let is_last = change.component_mul(&scales).norm() <= stop.change * x_size
                || predicted.abs() <= stop.change * here.cost
                || damping > LARGEST;
            let there = of(&x).filter(Local::is_finite);
            let fall = there.as_ref().map_or(f64::NAN, |there| here.cost - there.cost());
            // not a number where x is refused
            let ratio = fall / predicted;
            match there {
                Some(local) if fall > 0.0 && predicted > 0.0 => {
                    damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
                    growth = 2.0;
                    here = Minimum { cost: local.cost(), x, local, has_converged: is_last };
                }
                _ if is_last => here.has_converged = true,
                _ => {
                    damping *= growth;
                    growth *= 2.0;
                    continue;
                }
            }
            break;
        }
        if here.has_converged {
            break;
        }
    }
    Some(here)
}

/// The largest norms of columns so far.
fn grow(scales: &mut DVector<f64>, jacobian: &DMatrix<f64>) {
    for (scale, column) in scales.iter_mut().zip(jacobian.column_iter()) {
        *scale = scale.max(column.norm());
    }
}

/// Within the bounds, and not many times larger or smaller than before.
fn within(mut x: DVector<f64>, before: &DVector<f64>, bounds: &[[f64; 2]]) -> DVector<f64> {
    for ((x, before), [low, high]) in x.iter_mut().zip(before).zip(bounds) {
        let (low, high) = if *low >= 0.0 && *before > 0.0 {
            // a bound at 0 itself may be the result
            (if *low > 0.0 { low.max(before / FARTHEST) } else { *low }, high.min(before * FARTHEST))
        } else {
            (*low, *high)
        };
        *x = x.max(low).min(high);
    }
    x
}

/// The steps of every damping from one place.
struct Steps {
    /// The variables that move, by their index,
    free: Vec<usize>,
    /// and D of them.
    scales: DVector<f64>,
    /// Uᵀr, S, V
    along: DVector<f64>,
    singular_values: DVector<f64>,
    v_t: DMatrix<f64>,
    count: usize,
}

impl Steps {
    /// Nothing where no variable can make the sum smaller.
    fn new(here: &Minimum, scales: &DVector<f64>, bounds: &[[f64; 2]]) -> Option<Self> {
        let Local { residuals, jacobian } = &here.local;
        let gradient = jacobian.tr_mul(residuals);
        let moves = |at: &usize| {
            let ([low, high], x, slope) = (bounds[*at], here.x[*at], gradient[*at]);
            let is_held = (x <= low && slope > 0.0) || (x >= high && slope < 0.0);
            scales[*at] > 0.0 && !is_held
        };
        let free: Vec<usize> = (0..here.x.len()).filter(moves).collect();
        let of_free = DVector::from_fn(free.len(), |at, _| scales[free[at]]);
        let scaled = DMatrix::from_fn(jacobian.nrows(), free.len(), |row, column| {
            jacobian[(row, free[column])] / of_free[column]
        });
        if free.is_empty() || here.cost == 0.0 {
            return None;
        }
        // a triangle instead of all rows: JD⁻¹ = QR, R = U S Vᵀ
        let (q, r) = scaled.qr().unpack();
        let Singular { u, values: singular_values, v_t } = Singular::new(&r);
        let along = u.tr_mul(&q.tr_mul(residuals));
        Some(Self { free, scales: of_free, along, singular_values, v_t, count: here.x.len() })
    }

    /// δ of a damping μ.
    fn of(&self, damping: f64) -> DVector<f64> {
        let damped = self.along.zip_map(&self.singular_values, |along, s| -along * s / (s * s + damping));
        let scaled = self.v_t.tr_mul(&damped).component_div(&self.scales);
        let mut step = DVector::zeros(self.count);
        self.free.iter().zip(&scaled).for_each(|(at, change)| step[*at] = *change);
        step
    }

    /// By how much the sum falls along a step if residuals are linear.
    fn fall(&self, here: &Minimum, step: &DVector<f64>) -> f64 {
        let change = &here.local.jacobian * step;
        -change.dot(&here.local.residuals) - 0.5 * change.norm_squared()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STOP: Stop = Stop { iterations: 200, change: 1e-14 };
    const FREE: [[f64; 2]; 2] = [[f64::NEG_INFINITY, f64::INFINITY]; 2];

    /// Rosenbrock's valley, r = (10(y − x²), 1 − x).
    fn valley(x: &DVector<f64>) -> Option<Local> {
        let residuals = DVector::from_vec(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]);
        let jacobian = DMatrix::from_row_slice(2, 2, &[-20.0 * x[0], 10.0, -1.0, 0.0]);
        Some(Local { residuals, jacobian })
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        let start = DVector::from_vec(vec![-1.2, 1.0]);
        let found = minimize(&mut valley, start, &FREE, STOP).unwrap();
        assert!(found.has_converged && found.cost < 1e-25, "{}", found.cost);
        assert!((found.x[0] - 1.0).abs() < 1e-12 && (found.x[1] - 1.0).abs() < 1e-12);
    }

    /// On x = 0.5 the sum is smallest at y = x² = 0.25.
    #[test]
    fn a_bound_holds_what_would_cross_it() {
        let start = DVector::from_vec(vec![-1.2, 1.0]);
        let found = minimize(&mut valley, start, &[[-2.0, 0.5], FREE[1]], STOP).unwrap();
        assert!(found.has_converged && found.x[0] == 0.5, "{}", found.x);
        // the iteration ends where the sum, 1/8, would fall by 10⁻¹⁴ of itself: 50 (y − x²)² of it
        assert!((found.x[1] - 0.25).abs() < 1e-8);
    }

    /// Half of the plane is refused, as a negative mass is.
    #[test]
    fn what_is_refused_is_gone_around() {
        let mut refusing = |x: &DVector<f64>| if x[0] > 1.5 || x[1] < 0.0 { None } else { valley(x) };
        let found = minimize(&mut refusing, DVector::from_vec(vec![1.4, 0.1]), &FREE, STOP).unwrap();
        assert!(found.cost < 1e-25);
        assert!(minimize(&mut refusing, DVector::from_vec(vec![2.0, 0.1]), &FREE, STOP).is_none());
    }

    /// A variable without influence stays where it is, and so does one that moves with another.
    #[test]
    fn what_is_not_determined_stays() {
        let mut line = |x: &DVector<f64>| {
            let residuals = DVector::from_vec(vec![x[0] + x[1] - 3.0, 2.0 * (x[0] + x[1]) - 6.0]);
            let jacobian = DMatrix::from_row_slice(2, 3, &[1.0, 1.0, 0.0, 2.0, 2.0, 0.0]);
            Some(Local { residuals, jacobian })
        };
        let bounds = [FREE[0]; 3];
        let found = minimize(&mut line, DVector::from_vec(vec![0.0, 1.0, 7.0]), &bounds, STOP).unwrap();
        assert!(found.cost < 1e-20 && found.x[2] == 7.0);
        assert!((found.x[0] - 1.0).abs() < 1e-8 && (found.x[1] - 2.0).abs() < 1e-8, "{}", found.x);
    }
}
