//! Roots, at compile time.

/// √x of a positive number that is neither huge nor tiny, as near as the square root of the
/// hardware.
pub const fn sqrt(x: f64) -> f64 {
    let mut root = if x > 1.0 { x } else { 1.0 };
    // Newton's iteration falls until it rests, or until it turns around at rounding.
    loop {
        let next = 0.5 * (root + x / root);
        if next >= root {
            break;
        }
        root = next;
    }
    // x − root² without rounding: halves of 26 bits have exact products (Dekker 1971).
    let scaled = 134_217_729.0 * root;
    let high = scaled - (scaled - root);
    let low = root - high;
    let rest = ((x - high * high) - 2.0 * high * low) - low * low;
    root + rest / (2.0 * root)
}

/// The factor z² + a z + b of a polynomial, its coefficients given from the constant one on,
/// to which Bairstow's iteration leads from z² + 2z + 2; its a and b.
///
/// # Source
/// J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, 5.5.
pub const fn quadratic_factor<const N: usize>(polynomial: &[f64; N]) -> [f64; 2] {
    let (mut a, mut b) = (2.0, 2.0);
    let mut left = 64;
    while left > 0 {
        let (quotient, rest) = divide(polynomial, a, b);
        let (_, slope) = divide(&quotient, a, b);
        // The rest r₁ z + r₀ changes by −(s₁ z + s₀) z and −(s₁ z + s₀) with a and b, where
        // s₁ z + s₀ is the rest of the quotient, and z² = −a z − b.
        let [r0, r1] = rest;
        let [s0, s1] = slope;
        let [along_a0, along_a1] = [b * s1, a * s1 - s0];
        let determinant = along_a0 * s1 - along_a1 * s0;
        let (da, db) = ((r0 * s1 - r1 * s0) / determinant, (along_a0 * r1 - along_a1 * r0) / determinant);
        a -= da;
        b += db;
        left -= 1;
    }
    [a, b]
}

/// Quotient and rest by z² + a z + b.
const fn divide<const N: usize>(polynomial: &[f64; N], a: f64, b: f64) -> ([f64; N], [f64; 2]) {
    let mut rest = *polynomial;
    let mut quotient = [0.0; N];
    let mut at = N;
    while at > 2 {
        at -= 1;
        let lead = rest[at];
        quotient[at - 2] = lead;
        rest[at] = 0.0;
        rest[at - 1] -= a * lead;
        rest[at - 2] -= b * lead;
    }
    (quotient, [rest[0], rest[1]])
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::sqrt;

    #[test]
    fn square_roots_are_those_of_the_hardware() {
        for at in 1..2000_u32 {
            let x = f64::from(at) * 0.0137;
            assert_eq!(sqrt(x), x.sqrt(), "{x}");
        }
    }
}
