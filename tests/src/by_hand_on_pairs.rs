//! The slider-crank as a person writes it who keeps everything in vector registers:
//! the elimination of [`by_hand`](crate::by_hand) with x and y in the lanes of a pair,
//! both angles in another, and the sines of both stages at the start of a step.

use mbs_runtime::{Pair as _, Real, Single as _};

use crate::by_hand::{Gains, SliderCrank};

/// Two lanes.
pub type Pair = <f64 as Real>::Pair;

/// Gravity in m/s², along −y.
const G: f64 = 9.81;

/// Coordinates, or their rates.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    /// The middle of the crank.
    crank: Pair,
    /// The middle of the rod.
    rod: Pair,
    /// The slider, and 0 for the guide.
    slider: Pair,
    /// Of crank and rod.
    angles: Pair,
}

#[inline(always)]
fn pair(first: f64, second: f64) -> Pair {
    Pair::join(number(first), number(second))
}

#[inline(always)]
fn both(x: f64) -> Pair {
    Pair::splat(number(x))
}

#[inline(always)]
fn number(x: f64) -> <Pair as mbs_runtime::Pair<f64>>::Single {
    mbs_runtime::Single::new(x)
}

/// The first lanes of two pairs.
#[inline(always)]
fn firsts(a: Pair, b: Pair) -> Pair {
    Pair::join(a.first(), b.first())
}

#[inline(always)]
fn seconds(a: Pair, b: Pair) -> Pair {
    Pair::join(a.second(), b.second())
}

#[inline(always)]
fn sum(a: Pair) -> f64 {
    a.first().get() + a.second().get()
}

impl Places {
    /// From (x1, y1, θ1, x2, y2, θ2, x3).
    pub fn new([x1, y1, theta1, x2, y2, theta2, x3]: [f64; 7]) -> Self {
        Self { crank: pair(x1, y1), rod: pair(x2, y2), slider: pair(x3, 0.0), angles: pair(theta1, theta2) }
    }

    /// Angle of the crank.
    pub fn theta1(&self) -> f64 {
        self.angles.first().get()
    }

    /// self + factor·other
    #[inline(always)]
    fn plus(&self, factor: Pair, other: &Self) -> Self {
        Self {
            crank: self.crank + factor * other.crank,
            rod: self.rod + factor * other.rod,
            slider: self.slider + factor * other.slider,
            angles: self.angles + factor * other.angles,
        }
    }

    #[inline(always)]
    fn sum(&self, other: &Self) -> Self {
        Self {
            crank: self.crank + other.crank,
            rod: self.rod + other.rod,
            slider: self.slider + other.slider,
            angles: self.angles + other.angles,
        }
    }
}

impl SliderCrank {
    /// A step of Heun's method with feedback in both stages.
    #[inline(always)]
    pub fn step_on_pairs<const IS_DRIVEN: bool>(
        &self,
        (q, v): (&Places, &Places),
        gains: &Gains,
        h: f64,
        [t, t_next]: [f64; 2],
    ) -> (Places, Places) {
        let (step, half_step) = (both(h), both(0.5 * h));
        let predicted_q = q.plus(step, v);
        let (turn, predicted_turn) = (q.angles.sin_cos(), predicted_q.angles.sin_cos());
        let here = self.accelerations_on_pairs::<IS_DRIVEN>(q, v, turn, t, gains);
        let predicted_v = v.plus(step, &here);
        let there = self.accelerations_on_pairs::<IS_DRIVEN>(
            &predicted_q,
            &predicted_v,
            predicted_turn,
            t_next,
            gains,
        );
        (q.plus(half_step, &v.sum(&predicted_v)), v.plus(half_step, &here.sum(&there)))
    }

    #[inline(always)]
    fn accelerations_on_pairs<const IS_DRIVEN: bool>(
        &self,
        q: &Places,
        v: &Places,
        (sines, cosines): (Pair, Pair),
        t: f64,
        gains: &Gains,
    ) -> Places {
        let lengths = pair(self.l1, self.l2);
        let (ls, lc) = (lengths * sines, lengths * cosines);
        let minus_ls = both(0.0) - ls;
        // along crank and rod, and across
        let (r1, r2) = (firsts(lc, ls), seconds(lc, ls));
        let (d1, d2) = (firsts(minus_ls, lc), seconds(minus_ls, lc));
        let half = both(0.5);
        let squares = v.angles * v.angles;
        let (w1, w2) = (Pair::splat(v.angles.first()), Pair::splat(v.angles.second()));
        let (ww1, ww2) = (Pair::splat(squares.first()), Pair::splat(squares.second()));
        let (damping, stiffness) = (both(-gains.two_alpha), both(-gains.beta_squared));

        // γ + feedback; of the guide with the other sign
        let (half_r1, half_r2, half_d1, half_d2) = (half * r1, half * r2, half * d1, half * d2);
        let (t1, t2, c1) = (d1 * w1, d2 * w2, r1 * ww1);
        let crank = damping * (v.crank - half_d1 * w1) + stiffness * (q.crank - half_r1) - half_r1 * ww1;
        let rod =
            damping * (v.rod - t1 - half_d2 * w2) + stiffness * (q.rod - r1 - half_r2) - c1 - half_r2 * ww2;
        let slider = damping * (v.slider - t1 - t2) + stiffness * (q.slider - r1 - r2) - c1 - r2 * ww2;

        let (guide, lc1, lc2) = (-slider.second().get(), lc.first().get(), lc.second().get());
        let (a1, a2);
        if IS_DRIVEN {
            let (theta1, omega1) = (q.angles.first().get(), v.angles.first().get());
            a1 = -gains.two_alpha * (omega1 - self.omega) - gains.beta_squared * (theta1 - self.omega * t);
            a2 = (guide - lc1 * a1) / lc2;
        } else {
            let ([m1, m2, m3], [j1, j2]) = (self.m, self.j);
            // q̈ = p + n θ̈1 with p the accelerations at θ̈1 = 0
            let inverse = 1.0 / lc2;
            let (p2, n2) = (guide * inverse, -lc1 * inverse);
            let (p, n) = (rod + half_d2 * both(p2), d1 + half_d2 * both(n2));
            let p3 = slider.first().get() + d2.first().get() * p2;
            let n3 = d1.first().get() + d2.first().get() * n2;
            let gravity = pair(0.0, G);
            let inertia = j1 + 0.25 * m1 * self.l1 * self.l1 + j2 * n2 * n2 + m2 * sum(n * n) + m3 * n3 * n3;
            let weights = m1 * sum(half_d1 * (crank + gravity)) + m2 * sum(n * (p + gravity));
            a1 = (self.torque - weights - j2 * n2 * p2 - m3 * n3 * p3) / inertia;
            a2 = p2 + n2 * a1;
        }
        let (e1, e2) = (d1 * both(a1), d2 * both(a2));
        let ends = slider + e1 + e2;
        Places {
            crank: crank + half * e1,
            rod: rod + e1 + half * e2,
            slider: Pair::join(ends.first(), number(0.0)),
            angles: pair(a1, a2),
        }
    }
}
