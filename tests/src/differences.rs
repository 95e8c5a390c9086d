//! Derivatives from differences, with what they may be off by.

/// A derivative, and the bound of its error.
#[derive(Clone, Copy, Debug)]
pub struct Slope {
    /// f′(0)
    pub value: f64,
    /// A bound of its errors by truncation and by rounding.
    pub error: f64,
}

impl Slope {
    /// True if a derivative is this one.
    pub fn is(&self, derivative: f64) -> bool {
        (derivative - self.value).abs() <= self.error
    }
}

/// f′(0) of functions that are evaluated together, by the five-point formula
///
/// ```text
/// f′(0) = (8 (f(δ) − f(−δ)) − (f(2δ) − f(−2δ)))/(12 δ) + δ⁴/30 f⁗′
/// ```
///
/// with δ and with δ/4. The difference of both is 255 times the truncation of the second; a
/// fifteenth of it is taken as the bound, which leaves room for terms of higher order.
///
/// A value is off by `roundings` ε of the largest value around, and of what it changes by when the
/// argument `x` itself does by ε; the formula turns an error e of every value into 3e/(2δ) at most.
pub fn slopes(x: f64, step: f64, roundings: f64, f: impl Fn(f64) -> Vec<f64>) -> Vec<Slope> {
    let at = |share: f64| f(share * step);
    let [far, near, half, quarter] = [2.0, 1.0, 0.5, 0.25].map(|share| [at(share), at(-share)]);
    let five = |near: &[Vec<f64>; 2], far: &[Vec<f64>; 2], step: f64, i: usize| {
        (8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i])) / (12.0 * step)
    };
    let slope = |i: usize| {
        let (coarse, fine) = (five(&near, &far, step, i), five(&quarter, &half, 0.25 * step, i));
        let size =
            [&far, &near, &half, &quarter].into_iter().flatten().map(|f| f[i].abs()).fold(0.0, f64::max);
        let size = size + (fine * x).abs();
        let rounding = roundings * f64::EPSILON * size * 1.5 / (0.25 * step);
        Slope { value: fine, error: (coarse - fine).abs() / 15.0 + rounding }
    };
    (0..near[0].len()).map(slope).collect()
}
