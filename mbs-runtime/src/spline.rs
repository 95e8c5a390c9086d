//! Splines, whose coefficients the compiler has computed.

use crate::Real;

/// One cubic: c₀ + c₁u + c₂u² + c₃u³ from `from` on, u counted from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Distance from the first point.
    pub from: f64,
    /// c₀ … c₃
    pub coefficients: [f64; 4],
}

/// A function given by a table, cubic from point to point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spline<Segments = &'static [Segment]> {
    /// The argument of the first point.
    pub origin: f64,
    /// The period, of a periodic one.
    pub period: Option<f64>,
    /// In ascending order. The first one holds before its beginning, too, and the last one for ever.
    pub segments: Segments,
}

impl Spline {
    /// The derivative of this order at `x`, the function itself for 0.
    ///
    /// Of lanes one after the other: each may lie in another segment.
    #[inline(always)]
    pub fn derivative<T: Real>(&self, order: u8, x: T) -> T {
        x.interpolate(self, order)
    }
}

impl<Segments: AsRef<[Segment]>> Spline<Segments> {
    /// The same of one number. Where the argument lies is decided in `f64`; what a scalar carries beside
    /// its value (x minus its value) goes through the cubic.
    #[inline]
    pub fn derivative_at<T: Real>(&self, order: u8, x: T) -> T {
        let value = x.to_f64();
        let beside = x - T::from_f64(value);
        let distance = value - self.origin;
        let distance = match self.period {
            Some(period) => distance - floor(distance / period) * period,
            None => distance,
        };
        let segments = self.segments.as_ref();
        let at = segments.partition_point(|segment| segment.from <= distance).saturating_sub(1);
        let Some(Segment { from, coefficients }) = segments.get(at) else { return T::default() };
        let u = T::from_f64(distance - from) + beside;
        let [c0, c1, c2, c3] = coefficients.map(T::from_f64);
        let (two, three) = (T::from_f64(2.0), T::from_f64(3.0));
        match order {
            0 => c0 + u * (c1 + u * (c2 + u * c3)),
            1 => c1 + u * (two * c2 + u * (three * c3)),
            2 => two * c2 + u * (two * three * c3),
            _ => two * three * c3,
        }
    }
}

/// The next integer below: `f64::floor` needs the standard library.
#[inline(always)]
pub(crate) fn floor(x: f64) -> f64 {
    // beyond 2⁶³ every number is one, and no angle means anything
    let truncated = x as i64 as f64;
    if truncated > x { truncated - 1.0 } else { truncated }
}

#[cfg(test)]
mod tests {
    use super::{Segment, Spline, floor};

    /// u² − u on 0 … 1, repeated: its slope jumps, its wrapping shows.
    const ARCH: Spline = Spline {
        origin: 0.0,
        period: Some(1.0),
        segments: &[Segment { from: 0.0, coefficients: [0.0, -1.0, 1.0, 0.0] }],
    };

    #[test]
    fn wraps_by_floor() {
        for (x, expected) in [(0.25, -0.1875), (-0.75, -0.1875), (1.25, -0.1875), (-7.0, 0.0), (8.5, -0.25)] {
            assert_eq!(ARCH.derivative(0, x), expected, "{x}");
        }
        assert_eq!(ARCH.derivative(1, -0.75), -0.5);
        assert_eq!(ARCH.derivative(2, -0.75_f32), 2.0);
        assert_eq!([floor(-0.5), floor(-2.0), floor(2.5)], [-1.0, -2.0, 2.0]);
    }

    #[test]
    fn keeps_what_is_not_a_number() {
        assert!(ARCH.derivative(0, f64::NAN).is_nan());
        assert!(!ARCH.derivative(0, f64::INFINITY).is_finite());
    }
}
