//! The N-pendulum as a person writes it for any N: absolute coordinates, and
//! loops over the links.
//!
//! Link i has its centre (xᵢ, yᵢ) and angle θᵢ; pin i says that the tip of link
//! i − 1, or the origin, is the base of link i. With u the vector from a link's
//! centre to its tip turned by 90°, the rows of a pin are (1, u) of the link
//! before and (−1, u) of its own, and Φ_q M⁻¹ Φ_qᵀ is block tridiagonal, with
//! 1/m + 1/m + uuᵀ/J + uuᵀ/J of both links on the diagonal and −1/m + uuᵀ/J of a
//! link between its two pins.

/// Gravity in m/s², along −y.
const G: f64 = 9.81;

/// N uniform rods.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum {
    /// Half the length of a rod in m.
    r: f64,
    /// Reciprocals of mass and moment of inertia.
    inverse_mass: f64,
    inverse_inertia: f64,
    /// 2α in 1/s.
    two_alpha: f64,
    /// β² in 1/s².
    beta_squared: f64,
}

/// Positions, velocities or accelerations of N links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Links<const N: usize> {
    /// Centres in m.
    pub x: [f64; N],
    /// Centres in m.
    pub y: [f64; N],
    /// Angles in rad.
    pub theta: [f64; N],
}

/// A vector per pin.
type Pins<const N: usize> = [[f64; 2]; N];

/// A symmetric matrix ⎡xx xy; xy yy⎤.
#[derive(Clone, Copy, Debug, Default)]
struct Symmetric {
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Symmetric {
    /// a + b uuᵀ.
    #[inline(always)]
    fn new(a: f64, b: f64, [x, y]: [f64; 2]) -> Self {
        Self { xx: a + b * (x * x), xy: b * (x * y), yy: a + b * (y * y) }
    }

    #[inline(always)]
    fn determinant(&self) -> f64 {
        self.xx * self.yy - self.xy * self.xy
    }

    /// The determinant times the inverse.
    #[inline(always)]
    fn adjugate(&self) -> Self {
        Self { xx: self.yy, xy: -self.xy, yy: self.xx }
    }

    #[inline(always)]
    fn times(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.xx * x + self.xy * y, self.xy * x + self.yy * y]
    }
}

impl Pendulum {
    /// Rods of `length` and `mass`, with feedback gains α and β in 1/s.
    pub fn new(length: f64, mass: f64, alpha: f64, beta: f64) -> Self {
        Self {
            r: length / 2.0,
            inverse_mass: 1.0 / mass,
            inverse_inertia: 12.0 / (mass * length * length),
            two_alpha: 2.0 * alpha,
            beta_squared: beta * beta,
        }
    }

    /// One step of Heun's method, the feedback held over it.
    #[inline]
    pub fn step<const N: usize>(&self, q: &mut Links<N>, v: &mut Links<N>, h: f64) {
        let arms = self.arms(&q.theta);
        let feedback = self.feedback(&arms, q, v);
        let here = self.accelerations(&arms, &v.theta, &feedback);
        let (predicted_theta, predicted) = (advanced(&q.theta, &v.theta, h), v.advanced(&here, h));
        let there = self.accelerations(&self.arms(&predicted_theta), &predicted.theta, &feedback);
        let half_h = 0.5 * h;
        *q = q.advanced(&v.plus(&predicted), half_h);
        *v = v.advanced(&here.plus(&there), half_h);
    }

    /// From each centre to its tip.
    #[inline(always)]
    fn arms<const N: usize>(&self, theta: &[f64; N]) -> Pins<N> {
        theta.map(|theta| {
            let (sine, cosine) = theta.sin_cos();
            [self.r * cosine, self.r * sine]
        })
    }

    /// −2αΦ̇ − β²Φ.
    #[inline(always)]
    fn feedback<const N: usize>(&self, arms: &Pins<N>, q: &Links<N>, v: &Links<N>) -> Pins<N> {
        let mut feedback = [[0.0; 2]; N];
        // the tip of the link before, and its velocity
        let (mut tip, mut tip_rate) = ([0.0; 2], [0.0; 2]);
        for (i, (feedback, &[cosine, sine])) in feedback.iter_mut().zip(arms).enumerate() {
            let (x, y, xs, yc) = (q.x[i], q.y[i], sine * v.theta[i], cosine * v.theta[i]);
            let phi = [tip[0] - x + cosine, tip[1] - y + sine];
            let phi_dot = [tip_rate[0] - v.x[i] - xs, tip_rate[1] - v.y[i] + yc];
            *feedback = [
                -self.two_alpha * phi_dot[0] - self.beta_squared * phi[0],
                -self.two_alpha * phi_dot[1] - self.beta_squared * phi[1],
            ];
            tip = [x + cosine, y + sine];
            tip_rate = [v.x[i] - xs, v.y[i] + yc];
        }
        feedback
    }

    /// q̈ from (Φ_q M⁻¹ Φ_qᵀ) λ = Φ_q M⁻¹ Q − γ − feedback by block LDLᵀ.
    #[inline(always)]
    fn accelerations<const N: usize>(
        &self,
        arms: &Pins<N>,
        rates: &[f64; N],
        feedback: &Pins<N>,
    ) -> Links<N> {
        // λᵢ = eliminatedᵢ − factorᵢ λᵢ₊₁
        let mut eliminated = [[0.0; 2]; N];
        let mut factors = [[[0.0; 2]; 2]; N];
        // what the pin before leaves of this one's block and right-hand side
        let mut block = Symmetric::default();
        let mut rest = [0.0, G];
        for i in 0..N {
            let arm = arms[i];
            let rate = rates[i] * rates[i];
            let centripetal = [arm[0] * rate, arm[1] * rate];
            let turned = Symmetric::new(0.0, self.inverse_inertia, [-arm[1], arm[0]]);
            let own = Symmetric {
                xx: block.xx + (self.inverse_mass + turned.xx),
                xy: block.xy + turned.xy,
                yy: block.yy + (self.inverse_mass + turned.yy),
            };
            let below = Symmetric {
                xx: turned.xx - self.inverse_mass,
                xy: turned.xy,
                yy: turned.yy - self.inverse_mass,
            };
            let right =
                [rest[0] - (centripetal[0] + feedback[i][0]), rest[1] - (centripetal[1] + feedback[i][1])];
            let inverse = 1.0 / own.determinant();
            let adjugate = own.adjugate();
            let [a, b] = adjugate.times(right);
            let solved = [inverse * a, inverse * b];
            // below is symmetric: its columns are its rows
            let first = adjugate.times([below.xx, below.xy]);
            let second = adjugate.times([below.xy, below.yy]);
            eliminated[i] = solved;
            factors[i] =
                [[inverse * first[0], inverse * second[0]], [inverse * first[1], inverse * second[1]]];
            let lost = [
                below.xx * first[0] + below.xy * first[1],
                below.xx * second[0] + below.xy * second[1],
                below.xy * second[0] + below.yy * second[1],
            ];
            block = Symmetric {
                xx: (self.inverse_mass + turned.xx) - inverse * lost[0],
                xy: turned.xy - inverse * lost[1],
                yy: (self.inverse_mass + turned.yy) - inverse * lost[2],
            };
            let passed = below.times(solved);
            rest = [-centripetal[0] - passed[0], -centripetal[1] - passed[1]];
        }
        self.substituted(arms, &eliminated, &factors)
    }

    /// λ from the last pin to the first, and q̈ = M⁻¹(Q − Φ_qᵀλ) of the links.
    #[inline(always)]
    fn substituted<const N: usize>(
        &self,
        arms: &Pins<N>,
        eliminated: &Pins<N>,
        factors: &[[[f64; 2]; 2]; N],
    ) -> Links<N> {
        let mut links = Links { x: [0.0; N], y: [0.0; N], theta: [0.0; N] };
        let mut next = [0.0; 2];
        for i in (0..N).rev() {
            let ([a, b], [[xx, xy], [yx, yy]]) = (eliminated[i], factors[i]);
            let pull = [a - (xx * next[0] + xy * next[1]), b - (yx * next[0] + yy * next[1])];
            let [x, y] = arms[i];
            links.x[i] = self.inverse_mass * (pull[0] - next[0]);
            links.y[i] = self.inverse_mass * (pull[1] - next[1]) - G;
            links.theta[i] = self.inverse_inertia * (y * (pull[0] + next[0]) - x * (pull[1] + next[1]));
            next = pull;
        }
        links
    }
}

#[inline(always)]
fn advanced<const N: usize>(from: &[f64; N], rate: &[f64; N], h: f64) -> [f64; N] {
    std::array::from_fn(|i| from[i] + h * rate[i])
}

impl<const N: usize> Links<N> {
    /// Links from coordinates in the order x, y, θ of the first, of the second …
    pub fn from_coordinates(coordinates: &[f64]) -> Self {
        let of = |part: usize| std::array::from_fn(|i| coordinates[3 * i + part]);
        Self { x: of(0), y: of(1), theta: of(2) }
    }

    /// The largest difference of a component.
    pub fn distance(&self, other: &Self) -> f64 {
        let difference = |a: &[f64; N], b: &[f64; N]| {
            a.iter().zip(b).fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()))
        };
        let angles = difference(&self.theta, &other.theta);
        angles.max(difference(&self.x, &other.x)).max(difference(&self.y, &other.y))
    }

    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        self.advanced(other, 1.0)
    }

    #[inline(always)]
    fn advanced(&self, rate: &Self, h: f64) -> Self {
        Self {
            x: advanced(&self.x, &rate.x, h),
            y: advanced(&self.y, &rate.y, h),
            theta: advanced(&self.theta, &rate.theta, h),
        }
    }
}
