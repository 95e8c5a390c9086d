//! The steps of `by_hand`.

use std::array::from_fn;

use crate::by_hand::{Hand, Seven};
use crate::vector::Vector;

/// The same in registers, and what is worth being computed once.
#[derive(Clone, Copy)]
struct Constants {
    l1: Vector,
    l2: Vector,
    half_l1: Vector,
    half_l2: Vector,
    m2: Vector,
    m3: Vector,
    j2: Vector,
    half_m1: Vector,
    /// J1 + m1 l1²/4
    crank: Vector,
    omega: Vector,
    torque: Vector,
    minus_two_alpha: Vector,
    minus_beta_squared: Vector,
}

/// l1 sin θ1, l1 cos θ1, l2 sin θ2, l2 cos θ2, and their halves.
struct Angles {
    whole: [Vector; 4],
    half: [Vector; 4],
}

impl Constants {
    #[inline(always)]
    fn of(hand: &Hand) -> Self {
        let v = Vector::of;
        let ([m1, m2, m3], [j1, j2]) = (hand.m.map(v), hand.j.map(v));
        let (l1, l2, half) = (v(hand.l1), v(hand.l2), Vector::all(0.5));
        Self {
            l1,
            l2,
            half_l1: half * l1,
            half_l2: half * l2,
            m2,
            m3,
            j2,
            half_m1: half * m1,
            crank: j1 + Vector::all(0.25) * m1 * l1 * l1,
            omega: v(hand.omega),
            torque: v(hand.torque),
            minus_two_alpha: v(hand.minus_two_alpha),
            minus_beta_squared: v(hand.minus_beta_squared),
        }
    }

    #[inline(always)]
    fn angles<const FUSED: bool>(&self, q: &[Vector; 7]) -> Angles {
        let ((s1, c1), (s2, c2)) = (q[2].sin_cos::<FUSED>(), q[5].sin_cos::<FUSED>());
        let whole = [self.l1 * s1, self.l1 * c1, self.l2 * s2, self.l2 * c2];
        let half = [self.half_l1 * s1, self.half_l1 * c1, self.half_l2 * s2, self.half_l2 * c2];
        Angles { whole, half }
    }

    #[inline(always)]
    fn feedback<const FUSED: bool>(
        &self,
        angles: &Angles,
        q: &[Vector; 7],
        v: &[Vector; 7],
        t: Vector,
    ) -> [Vector; 7] {
        let Angles { whole: [s1, c1, s2, c2], half: [hs1, hc1, hs2, hc2] } = *angles;
        let phi = [
            q[0] - hc1,
            q[1] - hs1,
            q[2].minus::<FUSED>(self.omega, t),
            q[3] - c1 - hc2,
            q[4] - s1 - hs2,
            s1 + s2,
            q[6] - c1 - c2,
        ];
        let (w1, w2) = (v[2], v[5]);
        let (xs, xc) = (s1 * w1, c1 * w1);
        let phi_dot = [
            v[0].plus::<FUSED>(hs1, w1),
            v[1].minus::<FUSED>(hc1, w1),
            w1 - self.omega,
            (v[3] + xs).plus::<FUSED>(hs2, w2),
            (v[4] - xc).minus::<FUSED>(hc2, w2),
            xc.plus::<FUSED>(c2, w2),
            (v[6] + xs).plus::<FUSED>(s2, w2),
        ];
        from_fn(|i| (self.minus_two_alpha * phi_dot[i]).plus::<FUSED>(self.minus_beta_squared, phi[i]))
    }

    /// γ + feedback, the accelerations that angles at rest would leave.
    #[inline(always)]
    fn offsets<const FUSED: bool>(angles: &Angles, v: &[Vector; 7], f: &[Vector; 7]) -> [Vector; 7] {
        let Angles { whole: [s1, c1, s2, c2], half: [hs1, hc1, hs2, hc2] } = *angles;
        let (w1, w2) = (v[2] * v[2], v[5] * v[5]);
        let (ac, a_s) = (c1 * w1, s1 * w1);
        [
            f[0].minus::<FUSED>(hc1, w1),
            f[1].minus::<FUSED>(hs1, w1),
            f[2],
            (f[3] - ac).minus::<FUSED>(hc2, w2),
            (f[4] - a_s).minus::<FUSED>(hs2, w2),
            (f[5] + a_s).plus::<FUSED>(s2, w2),
            (f[6] - ac).minus::<FUSED>(c2, w2),
        ]
    }

    #[inline(always)]
    fn from_angles<const FUSED: bool>(
        angles: &Angles,
        g: &[Vector; 7],
        a1: Vector,
        a2: Vector,
    ) -> [Vector; 7] {
        let Angles { whole: [s1, c1, s2, _], half: [hs1, hc1, hs2, hc2] } = *angles;
        let (xs, xc) = (s1 * a1, c1 * a1);
        [
            g[0].minus::<FUSED>(hs1, a1),
            g[1].plus::<FUSED>(hc1, a1),
            a1,
            (g[3] - xs).minus::<FUSED>(hs2, a2),
            (g[4] + xc).plus::<FUSED>(hc2, a2),
            a2,
            (g[6] - xs).minus::<FUSED>(s2, a2),
        ]
    }

    #[inline(always)]
    fn driven<const FUSED: bool>(&self, angles: &Angles, v: &[Vector; 7], f: &[Vector; 7]) -> [Vector; 7] {
        let g = Self::offsets::<FUSED>(angles, v, f);
        let [_, c1, _, c2] = angles.whole;
        Self::from_angles::<FUSED>(angles, &g, g[2], g[5].minus::<FUSED>(c1, g[2]) / c2)
    }

    #[inline(always)]
    fn free<const FUSED: bool>(&self, angles: &Angles, v: &[Vector; 7], f: &[Vector; 7]) -> [Vector; 7] {
        let Angles { whole: [s1, c1, s2, c2], half: [_, _, hs2, hc2] } = *angles;
        let Self { m2, m3, j2, .. } = *self;
        let g = Self::offsets::<FUSED>(angles, v, f);
        let weight = Vector::all(9.81);
        // q̈ = p − n θ̈1 with p the accelerations at θ̈1 = 0
        let inverse = Vector::all(1.0) / c2;
        let (p2, n2) = (g[5] * inverse, c1 * inverse);
        let (px, py) = (g[3].minus::<FUSED>(hs2, p2), (g[4] + weight).plus::<FUSED>(hc2, p2));
        let p3 = g[6].minus::<FUSED>(s2, p2);
        let (nx, ny) = (s1.minus::<FUSED>(hs2, n2), hc2 * n2 - c1);
        let n3 = s1.minus::<FUSED>(s2, n2);
        let squares = (nx * nx).plus::<FUSED>(ny, ny);
        let inertia =
            self.crank.plus::<FUSED>(j2 * n2, n2).plus::<FUSED>(m2, squares).plus::<FUSED>(m3 * n3, n3);
        let crank = (c1 * (g[1] + weight)).minus::<FUSED>(s1, g[0]);
        let products = (nx * px).plus::<FUSED>(ny, py);
        let force = self
            .torque
            .minus::<FUSED>(self.half_m1, crank)
            .plus::<FUSED>(j2 * n2, p2)
            .plus::<FUSED>(m2, products)
            .plus::<FUSED>(m3 * n3, p3);
        let a1 = force / inertia;
        Self::from_angles::<FUSED>(angles, &g, a1, p2.minus::<FUSED>(n2, a1))
    }

    #[inline(always)]
    fn step<const DRIVEN: bool, const FUSED: bool>(
        &self,
        q: &mut [Vector; 7],
        v: &mut [Vector; 7],
        t: Vector,
        h: Vector,
    ) {
        let solve = |angles: &Angles, v: &[Vector; 7], f: &[Vector; 7]| {
            if DRIVEN { self.driven::<FUSED>(angles, v, f) } else { self.free::<FUSED>(angles, v, f) }
        };
        let angles = self.angles::<FUSED>(q);
        let feedback = self.feedback::<FUSED>(&angles, q, v, t);
        let here = solve(&angles, v, &feedback);
        let q1: [Vector; 7] = from_fn(|i| q[i].plus::<FUSED>(h, v[i]));
        let v1: [Vector; 7] = from_fn(|i| v[i].plus::<FUSED>(h, here[i]));
        let there = solve(&self.angles::<FUSED>(&q1), &v1, &feedback);
        let half_h = Vector::all(0.5) * h;
        for i in 0..7 {
            q[i] = q[i].plus::<FUSED>(half_h, v[i] + v1[i]);
            v[i] = v[i].plus::<FUSED>(half_h, here[i] + there[i]);
        }
    }
}

/// Steps of eight slider-cranks.
#[target_feature(enable = "avx512f,avx512dq,avx512vl,fma")]
pub fn steps<const DRIVEN: bool, const FUSED: bool>(
    hand: &Hand,
    q: &mut Seven,
    v: &mut Seven,
    h: f64,
    steps: u64,
) {
    let constants = Constants::of(hand);
    let (mut q1, mut v1) = (q.map(Vector::of), v.map(Vector::of));
    for k in 0..steps {
        let t = Vector::all(k as f64 * h);
        constants.step::<DRIVEN, FUSED>(&mut q1, &mut v1, t, Vector::all(h));
    }
    (*q, *v) = (q1.map(Vector::lanes), v1.map(Vector::lanes));
}
