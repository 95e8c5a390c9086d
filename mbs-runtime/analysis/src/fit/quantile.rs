//! How many standard errors an interval reaches to each side.

use std::f64::consts::PI;

/// From as many degrees of freedom on, Student's distribution is taken from its expansion about the normal
/// one, whose next term is below 10⁻⁹ there.
const MANY: u64 = 400;

/// t with P(|T| ≤ t) = `confidence` for Student's distribution of so many degrees of freedom; of infinitely
/// many, which is the normal distribution, for `None`.
///
/// # Source
/// M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 1964: 26.2.10, 26.7.3 to 26.7.5.
pub fn two_sided(confidence: f64, freedom: Option<u64>) -> f64 {
    match freedom {
        Some(freedom) if freedom < MANY => inverse(confidence, |t| within_student(t, freedom.max(1))),
        Some(freedom) => {
            let (x, n) = (inverse(confidence, within_normal), freedom as f64);
            let first = x.powi(3) + x;
            let second = 5.0 * x.powi(5) + 16.0 * x.powi(3) + 3.0 * x;
            let third = 3.0 * x.powi(7) + 19.0 * x.powi(5) + 17.0 * x.powi(3) - 15.0 * x;
            x + first / (4.0 * n) + second / (96.0 * n.powi(2)) + third / (384.0 * n.powi(3))
        }
        None => inverse(confidence, within_normal),
    }
}

/// Where a rising function of t ≥ 0 has a value, by bisection to rounding.
fn inverse(value: f64, of: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while of(high) < value && high < 1e12 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if of(middle) < value { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// P(|T| ≤ t), the finite sum over powers of cos θ with tan θ = t/√n.
fn within_student(t: f64, n: u64) -> f64 {
    let theta = (t / (n as f64).sqrt()).atan();
    let (sin, cos) = theta.sin_cos();
    // of an odd n: cos θ + 2/3 cos³θ + …; of an even one: 1 + 1/2 cos²θ + …
    let is_odd = n % 2 == 1;
    let (mut term, mut sum, mut k) = if is_odd { (cos, 0.0, 1) } else { (1.0, 0.0, 0) };
    while k + 2 <= n {
        sum += term;
        k += 2;
        term *= cos * cos * (k - 1) as f64 / k as f64;
    }
    if is_odd { 2.0 / PI * (theta + sin * sum) } else { sin * sum }
}

/// P(|X| ≤ x) = 2φ(x)(x + x³/3 + x⁵/(3·5) + …)
fn within_normal(x: f64) -> f64 {
    let (mut term, mut sum, mut k) = (x, 0.0, 1.0);
    while term > f64::EPSILON * sum {
        sum += term;
        k += 2.0;
        term *= x * x / k;
    }
    (2.0 / PI).sqrt() * (-0.5 * x * x).exp() * sum
}

#[cfg(test)]
mod tests {
    use super::two_sided;

    /// By SciPy: `t.ppf(0.975, n)`, `norm.ppf(0.995)`.
    #[test]
    fn quantiles_of_the_tables() {
        let near = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} and not {expected}");
        };
        near(two_sided(0.95, Some(1)), 12.706204736174694);
        near(two_sided(0.95, Some(2)), 4.302652729749462);
        near(two_sided(0.95, Some(5)), 2.5705818356363146);
        near(two_sided(0.95, Some(30)), 2.0422724563012378);
        near(two_sided(0.95, Some(399)), 1.965927295920882);
        near(two_sided(0.95, Some(400)), 1.9659123432294627);
        near(two_sided(0.99, Some(10_000)), 2.5763210466685282);
        near(two_sided(0.95, None), 1.959963984540054);
        near(two_sided(0.99, None), 2.5758293035489004);
    }
}
