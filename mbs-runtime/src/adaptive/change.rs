//! Where a value stops being negative.

use crate::Real;

/// An iteration that halves its interval at least every third time ends before this.
const ITERATIONS: u32 = 200;

/// The end of the smallest interval of numbers in which `value` stops being negative, if it is
/// negative at the first time and not at the second.
///
/// Secants through both ends, of which one that stays counts half the next time (the Illinois
/// rule), with a bisection where they do not shorten the interval; Dahlquist, Björck, Numerical
/// Methods in Scientific Computing I, 6.2.
pub fn last_change<T: Real>([mut low, mut high]: [T; 2], mut value: impl FnMut(T) -> T) -> T {
    let (zero, half) = (T::default(), T::from_f64(0.5));
    let (mut below, mut above) = (value(low), value(high));
    let mut width = high - low;
    let (mut side, mut is_exact) = (0, false);
    for iteration in 0..ITERATIONS {
        let middle = low + half * (high - low);
        // no number between
        let is_divisible = low < middle && middle < high;
        if !is_divisible || is_exact {
            break;
        }
        if iteration % 3 == 0 {
            width = high - low;
        }
        let secant = high - above * (high - low) / (above - below);
        let is_slow = iteration % 3 == 2 && high - low > half * width;
        let t = if is_slow || !(low < secant && secant < high) { middle } else { secant };
        let found = value(t);
        is_exact = found == zero;
        if found < zero {
            (low, below) = (t, found);
            above = if side < 0 { half * above } else { above };
            side = -1;
        } else {
            (high, above) = (t, found);
            below = if side > 0 { half * below } else { below };
            side = 1;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value is negative at the number before, and the evaluations are few.
    fn is_found(interval: [f64; 2], value: impl Fn(f64) -> f64, most: u32) {
        let mut count = 0;
        let found = last_change(interval, |t| {
            count += 1;
            value(t)
        });
        assert!(value(found) >= 0.0 && value(found.next_down()) < 0.0, "{found}");
        assert!(count <= most, "{count}");
    }

    #[test]
    fn the_number_behind_a_change_is_found() {
        is_found([0.0, 1.0], |t| t - 0.3, 60);
        is_found([0.0, 2.0], |t| t * t * t - 2.0, 80);
        is_found([0.0, 3.0], |t| (t - 1.0) * (t - 1.0) * (t - 1.0), 200);
        is_found([0.0, 1.0], |t| if t < 0.7 { -1.0 } else { 1e-9 }, 200);
        is_found([0.0, 1.0], |t| t.exp() - 1.5, 60);
    }
}
