//! The elimination of `tests::by_hand` over lanes, in a loop that does nothing
//! else: no watched pivots, no test for finite values, no time but that of the drive.

use std::array::from_fn;

use mbs_runtime::{Lanes, Real};

pub const N: usize = 8;
type L = Lanes<f64, N>;
type Seven = [L; 7];

/// Eight slider-cranks.
#[derive(Clone, Copy)]
pub struct Hand {
    pub l1: L,
    pub l2: L,
    pub m: [L; 3],
    pub j: [L; 2],
    pub omega: L,
    pub torque: L,
    pub minus_two_alpha: L,
    pub minus_beta_squared: L,
}

/// l1 sin θ1, l1 cos θ1, l2 sin θ2, l2 cos θ2.
struct Angles([L; 4]);

#[inline(always)]
fn c(x: f64) -> L {
    L::from_f64(x)
}

impl Hand {
    #[inline(always)]
    fn angles(&self, q: &Seven) -> Angles {
        let ((s1, c1), (s2, c2)) = (q[2].sin_cos(), q[5].sin_cos());
        Angles([self.l1 * s1, self.l1 * c1, self.l2 * s2, self.l2 * c2])
    }

    #[inline(always)]
    fn feedback(&self, angles: &Angles, q: &Seven, v: &Seven, t: L) -> Seven {
        let [s1, c1, s2, c2] = angles.0;
        let half = c(0.5);
        let phi = [
            q[0] - half * c1,
            q[1] - half * s1,
            q[2] - self.omega * t,
            q[3] - c1 - half * c2,
            q[4] - s1 - half * s2,
            s1 + s2,
            q[6] - c1 - c2,
        ];
        let (xs, xc, ys, yc) = (s1 * v[2], c1 * v[2], s2 * v[5], c2 * v[5]);
        let phi_dot = [
            v[0] + half * xs,
            v[1] - half * xc,
            v[2] - self.omega,
            v[3] + xs + half * ys,
            v[4] - xc - half * yc,
            xc + yc,
            v[6] + xs + ys,
        ];
        from_fn(|i| self.minus_two_alpha * phi_dot[i] + self.minus_beta_squared * phi[i])
    }

    #[inline(always)]
    fn offsets(angles: &Angles, v: &Seven, f: &Seven) -> Seven {
        let [s1, c1, s2, c2] = angles.0;
        let half = c(0.5);
        let (w1, w2) = (v[2] * v[2], v[5] * v[5]);
        let (ac, a_s, bc, bs) = (c1 * w1, s1 * w1, c2 * w2, s2 * w2);
        [
            f[0] - half * ac,
            f[1] - half * a_s,
            f[2],
            f[3] - ac - half * bc,
            f[4] - a_s - half * bs,
            f[5] + a_s + bs,
            f[6] - ac - bc,
        ]
    }

    #[inline(always)]
    fn from_angles(angles: &Angles, g: &Seven, a1: L, a2: L) -> Seven {
        let [s1, c1, s2, c2] = angles.0;
        let half = c(0.5);
        let (xs, xc, ys, yc) = (s1 * a1, c1 * a1, s2 * a2, c2 * a2);
        [
            g[0] - half * xs,
            g[1] + half * xc,
            a1,
            g[3] - xs - half * ys,
            g[4] + xc + half * yc,
            a2,
            g[6] - xs - ys,
        ]
    }

    #[inline(always)]
    fn driven(&self, angles: &Angles, v: &Seven, f: &Seven) -> Seven {
        let g = Self::offsets(angles, v, f);
        let [_, c1, _, c2] = angles.0;
        Self::from_angles(angles, &g, g[2], (g[5] - c1 * g[2]) / c2)
    }

    #[inline(always)]
    fn free(&self, angles: &Angles, v: &Seven, f: &Seven) -> Seven {
        let ([m1, m2, m3], [j1, j2]) = (self.m, self.j);
        let [s1, c1, s2, c2] = angles.0;
        let (half, weight) = (c(0.5), c(9.81));
        let g = Self::offsets(angles, v, f);
        let inverse = c(1.0) / c2;
        let (p2, n2) = (g[5] * inverse, -c1 * inverse);
        let (px, py, p3) = (g[3] - half * s2 * p2, g[4] + half * c2 * p2, g[6] - s2 * p2);
        let (nx, ny, n3) = (-s1 - half * s2 * n2, c1 + half * c2 * n2, -s1 - s2 * n2);
        let inertia =
            j1 + c(0.25) * m1 * self.l1 * self.l1 + j2 * n2 * n2 + m2 * (nx * nx + ny * ny) + m3 * n3 * n3;
        let crank = half * m1 * (c1 * (g[1] + weight) - s1 * g[0]);
        let force = self.torque - crank - j2 * n2 * p2 - m2 * (nx * px + ny * (py + weight)) - m3 * n3 * p3;
        let a1 = force / inertia;
        Self::from_angles(angles, &g, a1, p2 + n2 * a1)
    }

    #[inline(always)]
    fn step<const DRIVEN: bool>(&self, q: &mut Seven, v: &mut Seven, t: L, h: L) {
        let solve = |angles: &Angles, v: &Seven, f: &Seven| {
            if DRIVEN { self.driven(angles, v, f) } else { self.free(angles, v, f) }
        };
        let angles = self.angles(q);
        let mut feedback = self.feedback(&angles, q, v, t);
        if !DRIVEN {
            feedback[2] = c(0.0);
        }
        let here = solve(&angles, v, &feedback);
        let q1: Seven = from_fn(|i| q[i] + h * v[i]);
        let v1: Seven = from_fn(|i| v[i] + h * here[i]);
        let there = solve(&self.angles(&q1), &v1, &feedback);
        let half_h = c(0.5) * h;
        for i in 0..7 {
            q[i] = q[i] + half_h * (v[i] + v1[i]);
            v[i] = v[i] + half_h * (here[i] + there[i]);
        }
    }
}

/// Steps of eight slider-cranks, compiled for the same targets as an ensemble's.
#[multiversion::multiversion(targets(
    "x86_64+avx+avx2+fma+avx512f+avx512dq+avx512vl+avx512bw+avx512cd",
    "x86_64+avx+avx2+fma",
))]
pub fn advance<const DRIVEN: bool>(hand: &Hand, q: &mut Seven, v: &mut Seven, h: f64, steps: u64) {
    let (mut q1, mut v1) = (*q, *v);
    for k in 0..steps {
        hand.step::<DRIVEN>(&mut q1, &mut v1, c(k as f64 * h), c(h));
    }
    (*q, *v) = (q1, v1);
}
