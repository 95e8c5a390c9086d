//! The motion within a step, from what is known at both of its ends.

use crate::equations::At;
use crate::{Real, vectors};

/// Time, q, v and q̈ at an end of a step.
///
/// # Example
/// A free fall is met everywhere between two of its moments:
/// ```
/// use mbs_runtime::Moment;
///
/// let at = |t: f64| Moment { t, q: [1.0 - 4.905 * t * t], v: [-9.81 * t], a: [-9.81] };
/// let (start, end, between) = (at(0.0), at(0.4), at(0.1));
/// let (mut q, mut v) = ([0.0], [0.0]);
/// start.interpolate(&end, 0.1, &mut q, &mut v);
/// assert!((q[0] - between.q[0]).abs() < 1e-15 && (v[0] - between.v[0]).abs() < 1e-15);
/// // without terms of a scheme, cubics remain
/// start.interpolate_by(&[[[0.0]; 2]; 4], &end, 0.1, &mut q, &mut v);
/// assert!((q[0] - between.q[0]).abs() < 1e-15 && (v[0] - between.v[0]).abs() < 1e-15);
/// // a step over a corner is as short as rounding
/// assert!(at(1.0).is_instant(&at(1.0 + 1e-15)) && !start.is_instant(&end));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Moment<T, V> {
    /// Time in s.
    pub t: T,
    /// Positions,
    pub q: V,
    /// velocities,
    pub v: V,
    /// and accelerations.
    pub a: V,
}

/// A step of so many roundings of the time leads over a corner.
const OVER_CORNER: f64 = 64.0;

/// True if a step of `h` seconds to `t` is one over a corner.
pub fn is_instant(h: f64, t: f64, epsilon: f64) -> bool {
    h <= OVER_CORNER * epsilon * t.abs()
}

impl<T: Real, V: AsRef<[T]> + AsMut<[T]>> Moment<T, V> {
    /// Time, positions and velocities.
    pub fn at(&self) -> At<'_, T> {
        At { t: self.t, q: self.q.as_ref(), v: self.v.as_ref() }
    }

    /// Writes positions and velocities at a time between this moment and `end`, by the terms of a scheme
    /// where there are such. In the step over a corner, which is as short as rounding, they are those of this moment:
    /// the roundings of positions over such a time are no velocities.
    pub fn between(&self, terms: Option<&[[V; 2]; 4]>, end: &Self, t: T, q: &mut V, v: &mut V) {
        match terms {
            _ if self.is_instant(end) => {
                vectors::copy(q.as_mut(), self.q.as_ref());
                vectors::copy(v.as_mut(), self.v.as_ref());
            }
            Some(terms) => self.interpolate_by(terms, end, t, q, v),
            None => self.interpolate(end, t, q, v),
        }
    }

    /// True if `end` is as near as the step over a corner.
    pub fn is_instant(&self, end: &Self) -> bool {
        is_instant((end.t - self.t).to_f64(), end.t.to_f64(), T::EPSILON.to_f64())
    }

    /// Writes positions and velocities at a time between this moment and `end`: the quintic that
    /// has q, v and q̈ of both, and its derivative.
    ///
    /// With s = (t − t₀)/h and c = s − 1,
    ///
    /// ```text
    /// q(s) = q₀ + h v₀ s + ½h²q̈₀ s² + s³ (d₃ + d₄ c + d₅ c²)
    /// d₃ = q₁ − q₀ − h v₀ − ½h²q̈₀
    /// d₄ = h (v₁ − v₀) − h²q̈₀ − 3 d₃
    /// d₅ = ½h²(q̈₁ − q̈₀) − 3 (h (v₁ − v₀) − h²q̈₀) + 6 d₃
    /// ```
    ///
    /// Positions are off by O(h⁶), velocities by O(h⁵).
    pub fn interpolate(&self, end: &Self, t: T, q: &mut V, v: &mut V) {
        let number = T::from_f64;
        let h = end.t - self.t;
        let s = (t - self.t) / h;
        let c = s - number(1.0);
        let (half, three) = (number(0.5), number(3.0));
        let targets = q.as_mut().iter_mut().zip(v.as_mut());
        for (([q0, v0, a0], [q1, v1, a1]), (q, v)) in self.scaled(h).zip(end.scaled(h)).zip(targets) {
            let (dq, dv, da) = (q1 - q0 - v0 - half * a0, v1 - v0 - a0, a1 - a0);
            let d3 = dq;
            let d4 = dv - three * dq;
            let d5 = half * da - three * dv + number(6.0) * dq;
            let cubic = d3 + c * (d4 + c * d5);
            let slope = d4 + number(2.0) * c * d5;
            *q = q0 + s * (v0 + s * (half * a0 + s * cubic));
            *v = (v0 + s * (a0 + s * (three * cubic + s * slope))) / h;
        }
    }

    /// Writes the acceleration at a time between this moment and `end`: the parabola that has the accelerations of
    /// both, and between them the change of the velocities.
    ///
    /// ```text
    /// q̈(s) = q̈₀ + s (q̈₁ − q̈₀) + 6 s (1 − s) ((v₁ − v₀)/h − ½(q̈₀ + q̈₁))
    /// ```
    ///
    /// It is off by O(h³), and by the error of a velocity over h. The second derivative of the quintic would be off by
    /// that of a position times 60/h².
    pub fn acceleration(&self, end: &Self, t: T, a: &mut V) {
        if self.is_instant(end) {
            vectors::copy(a.as_mut(), self.a.as_ref());
            return;
        }
        let number = T::from_f64;
        let h = end.t - self.t;
        let s = (t - self.t) / h;
        let between = number(6.0) * s * (number(1.0) - s);
        for (([_, v0, a0], [_, v1, a1]), a) in self.scaled(h).zip(end.scaled(h)).zip(a.as_mut()) {
            *a = (a0 + s * (a1 - a0) + between * (v1 - v0 - number(0.5) * (a0 + a1))) / (h * h);
        }
    }

    /// The same by the polynomial of a scheme's own, with the terms of positions and of velocities; see
    /// [`Interpolant`](mbs_interface::Interpolant).
    pub fn interpolate_by(&self, terms: &[[V; 2]; 4], end: &Self, t: T, q: &mut V, v: &mut V) {
        let h = end.t - self.t;
        let s = (t - self.t) / h;
        let c = T::from_f64(1.0) - s;
        let of_q = [&self.q, &end.q, &self.v, &end.v].map(|vector| vector.as_ref());
        let of_v = [&self.v, &end.v, &self.a, &end.a].map(|vector| vector.as_ref());
        for (which, ([x0, x1, k0, k1], to)) in [(of_q, q), (of_v, v)].into_iter().enumerate() {
            let terms = terms.each_ref().map(|term| term.get(which).map_or(&[][..], |term| term.as_ref()));
            let [t1, t2, t3, t4] = terms;
            vectors::zip_into([to.as_mut()], [x0, x1, k0, k1, t1, t2, t3, t4], |of| {
                let [x0, x1, k0, k1, t1, t2, t3, t4] = of;
                let change = x1 - x0;
                let first = h * k0 - change;
                let second = change - h * k1 - first;
                let terms = t1 + s * (t2 + c * (t3 + s * t4));
                [x0 + s * (change + c * (first + s * (second + c * terms)))]
            });
        }
    }

    /// q, hv and h²q̈ of every coordinate.
    fn scaled(&self, h: T) -> impl Iterator<Item = [T; 3]> {
        let [q, v, a] = [&self.q, &self.v, &self.a].map(|vector| vector.as_ref().iter().copied());
        q.zip(v).zip(a).map(move |((q, v), a)| [q, h * v, h * h * a])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial of fifth degree is its own interpolant, to a few roundings of its terms.
    #[test]
    fn quintics_are_met_and_velocities_are_derivatives() {
        let coefficients = [0.3, -1.2, 0.7, 2.0, -0.4, 1.1];
        let at = |t: f64| {
            let sum = |derivative: i32| -> f64 {
                let terms = coefficients.iter().zip(0..).filter(|(_, power)| *power >= derivative);
                let factor = |power: i32| (0..derivative).map(|k| f64::from(power - k)).product::<f64>();
                terms.map(|(c, power)| c * factor(power) * t.powi(power - derivative)).sum()
            };
            Moment { t, q: [sum(0)], v: [sum(1)], a: [sum(2)] }
        };
        let (start, end) = (at(0.4), at(1.3));
        for step in 0..=20 {
            let t = 0.4 + 0.045 * f64::from(step);
            let (mut q, mut v) = ([0.0], [0.0]);
            start.interpolate(&end, t, &mut q, &mut v);
            let expected = at(t);
            assert!((q[0] - expected.q[0]).abs() < 1e-14 && (v[0] - expected.v[0]).abs() < 1e-13, "{t}");
        }
    }

    /// A parabola is its own interpolant: ẍ = 1 + 2 t − 3 t².
    #[test]
    fn accelerations_are_met_and_velocities_are_their_integrals() {
        let at =
            |t: f64| Moment { t, q: [0.0], v: [t + t * t - t * t * t], a: [1.0 + 2.0 * t - 3.0 * t * t] };
        let (start, end) = (at(0.4), at(1.3));
        for t in [0.4, 0.7, 1.1, 1.3] {
            let mut a = [0.0];
            start.acceleration(&end, t, &mut a);
            assert!((a[0] - at(t).a[0]).abs() < 1e-14, "{t}: {a:?}");
        }
    }
}
