//! Derivatives of functions of one variable from differences.
//!
//! Extrapolation estimates the error of a derivative and shows corners. It shows them also where the
//! derivative itself comes from duals.

use nalgebra::DVector;

/// f′(0) by the five-point formula, for a search that corrects itself: the truncation δ⁴ and the
/// rounding ε/δ are both about 10⁻¹² of f where f varies over `scale`.
pub fn five_point(f: impl Fn(f64) -> DVector<f64>, scale: f64) -> DVector<f64> {
    let step = 1e-3 * scale;
    let change = (f(step) - f(-step)) * 8.0 - (f(2.0 * step) - f(-2.0 * step));
    change / (12.0 * step)
}

/// f′(0) and an estimate of its error, in every component, from differences over ±h, ±h/2, ±h/4 and
/// so on, extrapolated to h = 0; from f(0) and one side alone where the other has no values.
///
/// Every component takes the entry of its own table of which the neighbours differ least, rounding
/// of f counted in; a slope that is not larger than its error is 0. So functions that vary over much less than h, such as smooth friction, are
/// differenced as well as others. A corner, where both sides have slopes of their own, shows in the
/// error.
///
/// # Errors
/// Those of f.
///
/// # Source
/// C. J. F. Ridders, Accurate computation of F′(x) and F′(x)F″(x), Advances in Engineering Software 4
/// (1982) 75-76.
pub fn derivative<E>(
    f: impl Fn(f64) -> Result<DVector<f64>, E>,
    longest: f64,
    levels: usize,
    is_one_sided: bool,
) -> Result<[DVector<f64>; 2], E> {
    let here = f(0.0)?;
    let mut best = [DVector::zeros(here.len()), DVector::from_element(here.len(), f64::INFINITY)];
    let mut last: Vec<DVector<f64>> = Vec::new();
    let (mut bends, mut rounding) =
        ([(); 2].map(|()| DVector::zeros(here.len())), DVector::zeros(here.len()));
    let order = if is_one_sided { 2.0 } else { 4.0 };
    for level in 0..levels {
        let h = longest * 0.5_f64.powi(i32::try_from(level).unwrap_or(i32::MAX));
        let (ahead, behind) = (f(h)?, if is_one_sided { here.clone() } else { f(-h)? });
        let width = if is_one_sided { h } else { 2.0 * h };
        rounding = ahead.zip_map(&behind, |a, b| 2.0 * f64::EPSILON * a.abs().max(b.abs()) / width);
        let [_, before] = bends;
        bends = [before, (&ahead + &behind - &here * 2.0) / h];
        let mut row = vec![(ahead - behind) / width];
        let mut factor = 1.0;
        for (at, before) in last.iter().enumerate() {
            factor *= order;
            let finer = &row[at];
            let next = finer + (finer - before) / (factor - 1.0);
            for k in 0..here.len() {
                let error = (next[k] - finer[k]).abs().max((next[k] - before[k]).abs()) + rounding[k];
                if error < best[1][k] {
                    (best[0][k], best[1][k]) = (next[k], error);
                }
            }
            row.push(next);
        }
        last = row;
    }
    // a slope that is less than its error is none
    let [slope, error] = &mut best;
    slope.zip_apply(error, |slope, error| {
        *slope = if slope.abs() <= error && error.is_finite() { 0.0 } else { *slope }
    });
    if !is_one_sided {
        add_corners(&mut best, &bends, &rounding);
    }
    Ok(best)
}

/// (f(h) − 2f(0) + f(−h))/h is hf″ for smooth functions, and the difference of both slopes at a corner:
/// what is left of it at h = 0, if it is more than a share of the slope that no smooth function leaves.
fn add_corners(
    [slope, error]: &mut [DVector<f64>; 2],
    [before, last]: &[DVector<f64>; 2],
    rounding: &DVector<f64>,
) {
    const SHARE: f64 = 1e-6;
    for k in 0..slope.len() {
        let left = (2.0 * last[k] - before[k]).abs();
        if left > SHARE * slope[k].abs() + 16.0 * rounding[k] {
            error[k] = error[k].max(0.5 * left);
        }
    }
}

/// The same from one side: ahead, or behind where there are no values ahead.
///
/// # Errors
/// Those of f ahead, where it has no values behind either.
pub fn from_one_side<E>(
    f: impl Fn(f64) -> Result<DVector<f64>, E>,
    longest: f64,
    levels: usize,
) -> Result<[DVector<f64>; 2], E> {
    derivative(&f, longest, levels, true).or_else(|error| {
        let [slope, open] = derivative(|x| f(-x), longest, levels, true).map_err(|_| error)?;
        Ok([-slope, open])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(f: impl Fn(f64) -> f64, is_one_sided: bool) -> [f64; 2] {
        let found = derivative::<()>(|x| Ok(DVector::from_element(1, f(x))), 0.02, 8, is_one_sided);
        found.map_or([f64::NAN; 2], |found| found.map(|list| list[0]))
    }

    #[test]
    fn derivatives_are_as_exact_as_their_estimate() {
        for one_sided in [false, true] {
            for (f, expected) in [
                (f64::exp as fn(f64) -> f64, 1.0),
                (|x| (1.0 + x).sqrt(), 0.5),
                (|x| 1e6 + 3.0 * x, 3.0),
                // smooth friction, four times as steep as the longest step
                (|x| (200.0 * x).tanh(), 200.0),
            ] {
                let [found, error] = of(f, one_sided);
                assert!((found - expected).abs() <= 2.0 * error, "{found} {expected} {error}");
                assert!(error < 1e-4 * expected, "{error}");
            }
        }
        let [found, error] = of(f64::exp, false);
        assert!((found - 1.0).abs() < 1e-12 && error < 1e-11, "{found} {error}");
    }

    /// |x| + x/2 has no derivative at 0: from the right it is 3/2, and 1/2 ± 1 from both sides.
    #[test]
    fn a_corner_shows_in_the_error() {
        let corner = |x: f64| x.abs() + 0.5 * x;
        assert_eq!(of(corner, true)[0], 1.5);
        let [found, error] = of(corner, false);
        assert!((found - 0.5).abs() < 1e-12 && (error - 1.0).abs() < 1e-9, "{found} {error}");
    }
}
