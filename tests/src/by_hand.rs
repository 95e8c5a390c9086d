//! The slider-crank as a person writes it: the paper's formulas with its slips
//! put right, the dense system of Eq. (8), and the same eliminated by hand.
//!
//! Coordinates (x1, y1, θ1, x2, y2, θ2, x3) and rows in the order of Eq. (3).
//! The paper prints γ with ω in the place of θ̇1, and its row 6 with a stray ω²;
//! here it is what differentiating Eq. (3) twice gives.

use mbs_runtime::Real;
use nalgebra::{SMatrix, SVector};

/// Seven coordinates, or their rates.
pub type Coordinates = SVector<f64, 7>;
/// One value per row of Eq. (3).
pub type Rows = SVector<f64, 7>;

/// The row of Eq. (3) that drives the crank.
pub const DRIVER: usize = 2;

/// Dimensions, masses and what acts on the crank.
#[derive(Clone, Copy, Debug)]
pub struct SliderCrank {
    /// Length of the crank in m.
    pub l1: f64,
    /// Length of the rod in m.
    pub l2: f64,
    /// Masses of crank, rod and slider in kg.
    pub m: [f64; 3],
    /// Moments of inertia of crank and rod about their middles in kg m².
    pub j: [f64; 2],
    /// Speed of the driver in rad/s.
    pub omega: f64,
    /// Torque on the crank in N m.
    pub torque: f64,
}

/// Gravity in m/s², along −y.
const G: f64 = 9.81;

/// The terms 2α and β² of Eq. (8).
#[derive(Clone, Copy, Debug, Default)]
pub struct Gains {
    /// 2α in 1/s.
    pub two_alpha: f64,
    /// β² in 1/s².
    pub beta_squared: f64,
}

/// Accelerations and multipliers.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// q̈
    pub acceleration: Coordinates,
    /// λ, with 0 for the driver of a free slider-crank.
    pub multipliers: Rows,
}

impl SliderCrank {
    /// Table 1 of the paper at 200 rpm, with J = `inertia_factor`·m l².
    pub fn paper(inertia_factor: f64) -> Self {
        let (l1, l2, m) = (0.06, 0.18, [0.5, 1.2, 2.0]);
        Self {
            l1,
            l2,
            m,
            j: [inertia_factor * m[0] * l1 * l1, inertia_factor * m[1] * l2 * l2],
            omega: 200.0 * std::f64::consts::TAU / 60.0,
            torque: 0.0,
        }
    }

    /// Φ, Eq. (3).
    pub fn phi(&self, t: f64, q: &Coordinates) -> Rows {
        let Self { l1, l2, .. } = *self;
        let [x1, y1, θ1, x2, y2, θ2, x3] = q.data.0[0];
        let ((s1, c1), (s2, c2)) = (θ1.sin_cos(), θ2.sin_cos());
        Rows::from([
            x1 - l1 / 2.0 * c1,
            y1 - l1 / 2.0 * s1,
            θ1 - self.omega * t,
            x2 - l1 * c1 - l2 / 2.0 * c2,
            y2 - l1 * s1 - l2 / 2.0 * s2,
            l1 * s1 + l2 * s2,
            x3 - l1 * c1 - l2 * c2,
        ])
    }

    /// Φ_q.
    #[rustfmt::skip]
    pub fn phi_q(&self, q: &Coordinates) -> SMatrix<f64, 7, 7> {
        let Self { l1, l2, .. } = *self;
        let [_, _, θ1, _, _, θ2, _] = q.data.0[0];
        let ((s1, c1), (s2, c2)) = (θ1.sin_cos(), θ2.sin_cos());
        SMatrix::from_row_slice(&[
            1.0, 0.0,  l1 / 2.0 * s1, 0.0, 0.0,  0.0,           0.0,
            0.0, 1.0, -l1 / 2.0 * c1, 0.0, 0.0,  0.0,           0.0,
            0.0, 0.0,  1.0,           0.0, 0.0,  0.0,           0.0,
            0.0, 0.0,  l1 * s1,       1.0, 0.0,  l2 / 2.0 * s2, 0.0,
            0.0, 0.0, -l1 * c1,       0.0, 1.0, -l2 / 2.0 * c2, 0.0,
            0.0, 0.0,  l1 * c1,       0.0, 0.0,  l2 * c2,       0.0,
            0.0, 0.0,  l1 * s1,       0.0, 0.0,  l2 * s2,       1.0,
        ])
    }

    /// Φ_t.
    pub fn phi_t(&self) -> Rows {
        let mut rows = Rows::zeros();
        rows[DRIVER] = -self.omega;
        rows
    }

    /// Φ̇ = Φ_q v + Φ_t.
    pub fn phi_dot(&self, q: &Coordinates, v: &Coordinates) -> Rows {
        self.phi_q(q) * v + self.phi_t()
    }

    /// γ = −(Φ_q v)_q v.
    pub fn gamma(&self, q: &Coordinates, v: &Coordinates) -> Rows {
        let Self { l1, l2, .. } = *self;
        let ((s1, c1), (s2, c2)) = (q[2].sin_cos(), q[5].sin_cos());
        let (a, b) = (l1 * v[2] * v[2], l2 * v[5] * v[5]);
        Rows::from([
            -a / 2.0 * c1,
            -a / 2.0 * s1,
            0.0,
            -a * c1 - b / 2.0 * c2,
            -a * s1 - b / 2.0 * s2,
            a * s1 + b * s2,
            -a * c1 - b * c2,
        ])
    }

    /// The diagonal of M.
    pub fn mass(&self) -> Coordinates {
        let ([m1, m2, m3], [j1, j2]) = (self.m, self.j);
        Coordinates::from([m1, m1, j1, m2, m2, j2, m3])
    }

    /// g of Eq. (6): weights, and the torque on the crank.
    pub fn forces(&self) -> Coordinates {
        let [m1, m2, _] = self.m;
        Coordinates::from([0.0, -m1 * G, self.torque, 0.0, -m2 * G, 0.0, 0.0])
    }

    /// −2αΦ̇ − β²Φ.
    pub fn feedback(&self, t: f64, q: &Coordinates, v: &Coordinates, gains: &Gains) -> Rows {
        self.phi_dot(q, v) * -gains.two_alpha - self.phi(t, q) * gains.beta_squared
    }

    /// Eq. (8) with the driver: LU of all 14 unknowns.
    pub fn solve_driven(&self, q: &Coordinates, v: &Coordinates, feedback: &Rows) -> Option<Solution> {
        let phi_q = self.phi_q(q);
        let mut kkt = SMatrix::<f64, 14, 14>::zeros();
        kkt.fixed_view_mut::<7, 7>(0, 0).set_diagonal(&self.mass());
        kkt.fixed_view_mut::<7, 7>(0, 7).copy_from(&phi_q.transpose());
        kkt.fixed_view_mut::<7, 7>(7, 0).copy_from(&phi_q);
        let mut rhs = SVector::<f64, 14>::zeros();
        rhs.fixed_rows_mut::<7>(0).copy_from(&self.forces());
        rhs.fixed_rows_mut::<7>(7).copy_from(&(self.gamma(q, v) + feedback));
        let solution = kkt.lu().solve(&rhs)?;
        Some(Solution {
            acceleration: solution.fixed_rows::<7>(0).into_owned(),
            multipliers: solution.fixed_rows::<7>(7).into_owned(),
        })
    }

    /// Eq. (8) without the driver: LU of 13 unknowns.
    pub fn solve_free(&self, q: &Coordinates, v: &Coordinates, feedback: &Rows) -> Option<Solution> {
        let phi_q = self.phi_q(q).remove_row(DRIVER);
        let mut kkt = SMatrix::<f64, 13, 13>::zeros();
        kkt.fixed_view_mut::<7, 7>(0, 0).set_diagonal(&self.mass());
        kkt.fixed_view_mut::<7, 6>(0, 7).copy_from(&phi_q.transpose());
        kkt.fixed_view_mut::<6, 7>(7, 0).copy_from(&phi_q);
        let mut rhs = SVector::<f64, 13>::zeros();
        rhs.fixed_rows_mut::<7>(0).copy_from(&self.forces());
        rhs.fixed_rows_mut::<6>(7).copy_from(&(self.gamma(q, v) + feedback).remove_row(DRIVER));
        let solution = kkt.lu().solve(&rhs)?;
        Some(Solution {
            acceleration: solution.fixed_rows::<7>(0).into_owned(),
            multipliers: solution.fixed_rows::<6>(7).insert_row(DRIVER, 0.0),
        })
    }

    /// q̈ with the driver, eliminated by hand: θ̈1 from the driver, θ̈2 from the
    /// guide, the rest by substitution.
    #[inline(always)]
    pub fn accelerations_driven(
        &self,
        q: &[f64; 7],
        v: &[f64; 7],
        t: f64,
        gains: &Gains,
    ) -> ([f64; 7], [f64; 7]) {
        let trig = Trigonometry::new(self, q);
        let feedback = self.feedback_by_hand(&trig, q, v, t, gains);
        (self.substitute_driven(&trig, v, &feedback), feedback)
    }

    /// As [`accelerations_driven`](Self::accelerations_driven) with the
    /// feedback given.
    #[inline(always)]
    pub fn accelerations_driven_held(&self, q: &[f64; 7], v: &[f64; 7], feedback: &[f64; 7]) -> [f64; 7] {
        self.substitute_driven(&Trigonometry::new(self, q), v, feedback)
    }

    #[inline(always)]
    fn substitute_driven(&self, trig: &Trigonometry, v: &[f64; 7], f: &[f64; 7]) -> [f64; 7] {
        let g = self.offsets(trig, v, f);
        let a1 = g[2];
        let a2 = (g[5] - trig.l1c1 * a1) / trig.l2c2;
        trig.all_from_angles(&g, a1, a2)
    }

    /// q̈ without the driver, eliminated by hand: all accelerations written
    /// through θ̈1, then one scalar equation of motion.
    #[inline(always)]
    pub fn accelerations_free(&self, q: &[f64; 7], v: &[f64; 7], gains: &Gains) -> ([f64; 7], [f64; 7]) {
        let trig = Trigonometry::new(self, q);
        let feedback = self.feedback_by_hand(&trig, q, v, 0.0, gains);
        (self.substitute_free(&trig, v, &feedback), feedback)
    }

    /// As [`accelerations_free`](Self::accelerations_free) with the feedback
    /// given.
    #[inline(always)]
    pub fn accelerations_free_held(&self, q: &[f64; 7], v: &[f64; 7], feedback: &[f64; 7]) -> [f64; 7] {
        self.substitute_free(&Trigonometry::new(self, q), v, feedback)
    }

    #[inline(always)]
    fn substitute_free(&self, trig: &Trigonometry, v: &[f64; 7], f: &[f64; 7]) -> [f64; 7] {
        let ([m1, m2, m3], [j1, j2]) = (self.m, self.j);
        let Trigonometry { l1s1, l1c1, l2s2, l2c2 } = *trig;
        let g = self.offsets(trig, v, f);
        // q̈ = p + n θ̈1 with p the accelerations at θ̈1 = 0
        let inverse = 1.0 / l2c2;
        let (p2, n2) = (g[5] * inverse, -l1c1 * inverse);
        let (px, py, p3) = (g[3] - 0.5 * l2s2 * p2, g[4] + 0.5 * l2c2 * p2, g[6] - l2s2 * p2);
        let (nx, ny, n3) = (-l1s1 - 0.5 * l2s2 * n2, l1c1 + 0.5 * l2c2 * n2, -l1s1 - l2s2 * n2);
        // the crank's middle moves on a circle: n1ᵀn1 = l1²/4
        let inertia =
            j1 + 0.25 * m1 * self.l1 * self.l1 + j2 * n2 * n2 + m2 * (nx * nx + ny * ny) + m3 * n3 * n3;
        let crank = 0.5 * m1 * (l1c1 * (g[1] + G) - l1s1 * g[0]);
        let force = self.torque - crank - j2 * n2 * p2 - m2 * (nx * px + ny * (py + G)) - m3 * n3 * p3;
        let a1 = force / inertia;
        trig.all_from_angles(&g, a1, p2 + n2 * a1)
    }

    /// λ with the driver from q̈: the equations of motion, one after the other.
    #[inline(always)]
    pub fn multipliers_driven(&self, q: &[f64; 7], a: &[f64; 7]) -> [f64; 7] {
        let ([m1, m2, m3], [j1, j2]) = (self.m, self.j);
        let Trigonometry { l1s1, l1c1, l2s2, l2c2 } = Trigonometry::new(self, q);
        let (λ1, λ2) = (-m1 * a[0], -m1 * (a[1] + G));
        let (λ4, λ5, λ7) = (-m2 * a[3], -m2 * (a[4] + G), -m3 * a[6]);
        let λ6 = -(j2 * a[5] + l2s2 * (0.5 * λ4 + λ7) - 0.5 * l2c2 * λ5) / l2c2;
        let λ3 = self.torque - j1 * a[2] - l1s1 * (0.5 * λ1 + λ4 + λ7) - l1c1 * (λ6 - 0.5 * λ2 - λ5);
        [λ1, λ2, λ3, λ4, λ5, λ6, λ7]
    }

    /// γ + feedback, the accelerations that angles at rest would leave.
    #[inline(always)]
    fn offsets(&self, trig: &Trigonometry, v: &[f64; 7], f: &[f64; 7]) -> [f64; 7] {
        let (w1, w2) = (v[2] * v[2], v[5] * v[5]);
        let (ac, as_) = (trig.l1c1 * w1, trig.l1s1 * w1);
        let (bc, bs) = (trig.l2c2 * w2, trig.l2s2 * w2);
        [
            f[0] - 0.5 * ac,
            f[1] - 0.5 * as_,
            f[2],
            f[3] - ac - 0.5 * bc,
            f[4] - as_ - 0.5 * bs,
            f[5] + as_ + bs,
            f[6] - ac - bc,
        ]
    }

    #[inline(always)]
    fn feedback_by_hand(
        &self,
        trig: &Trigonometry,
        q: &[f64; 7],
        v: &[f64; 7],
        t: f64,
        gains: &Gains,
    ) -> [f64; 7] {
        let Trigonometry { l1s1, l1c1, l2s2, l2c2 } = *trig;
        let phi = [
            q[0] - 0.5 * l1c1,
            q[1] - 0.5 * l1s1,
            q[2] - self.omega * t,
            q[3] - l1c1 - 0.5 * l2c2,
            q[4] - l1s1 - 0.5 * l2s2,
            l1s1 + l2s2,
            q[6] - l1c1 - l2c2,
        ];
        let (xs, xc, ys, yc) = (l1s1 * v[2], l1c1 * v[2], l2s2 * v[5], l2c2 * v[5]);
        let phi_dot = [
            v[0] + 0.5 * xs,
            v[1] - 0.5 * xc,
            v[2] - self.omega,
            v[3] + xs + 0.5 * ys,
            v[4] - xc - 0.5 * yc,
            xc + yc,
            v[6] + xs + ys,
        ];
        std::array::from_fn(|i| -gains.two_alpha * phi_dot[i] - gains.beta_squared * phi[i])
    }
}

/// l1 sin θ1, l1 cos θ1, l2 sin θ2, l2 cos θ2.
struct Trigonometry {
    l1s1: f64,
    l1c1: f64,
    l2s2: f64,
    l2c2: f64,
}

impl Trigonometry {
    #[inline(always)]
    fn new(of: &SliderCrank, q: &[f64; 7]) -> Self {
        // the library's are a call each, across which everything has to be saved
        let ((s1, c1), (s2, c2)) = (Real::sin_cos(q[2]), Real::sin_cos(q[5]));
        Self { l1s1: of.l1 * s1, l1c1: of.l1 * c1, l2s2: of.l2 * s2, l2c2: of.l2 * c2 }
    }

    #[inline(always)]
    fn all_from_angles(&self, g: &[f64; 7], a1: f64, a2: f64) -> [f64; 7] {
        let (xs, xc) = (self.l1s1 * a1, self.l1c1 * a1);
        let (ys, yc) = (self.l2s2 * a2, self.l2c2 * a2);
        [g[0] - 0.5 * xs, g[1] + 0.5 * xc, a1, g[3] - xs - 0.5 * ys, g[4] + xc + 0.5 * yc, a2, g[6] - xs - ys]
    }
}
