//! The fastest rates at which forces act, of a mechanism in motion.

use mbs_runtime::equations::{At, Equations};
use nalgebra::{Complex, DMatrix, DVector, Schur};

use crate::derivative::size_of_state;
use crate::tangent::Rest;

/// Directions of Arnoldi's iteration at most.
const MOST: usize = 48;
/// A value counts that so many of the directions give too, to this share of it.
const FEWER: f64 = 0.75;
const CONVERGED: f64 = 0.05;
/// Positions are moved by this share of their scales, and velocities by this share of the fastest.
const SHARE: f64 = 1e-7;
/// Least speed in scales per second. A slower motion counts as this fast where velocities are moved.
const SLOW: f64 = 1e-2;
/// Multiplications of a vector that the fastest motion is left of.
const POWERS: usize = 6;
/// Iterations of the QR algorithm at most.
const ITERATIONS: usize = 10_000;

/// The fastest rates of small deviations from a motion; see [`rates`].
#[derive(Clone, Debug, PartialEq)]
pub struct Rates {
    /// Rates λ in 1/s: deviations go with e^(λt). Those that count for the stability of a step are the
    /// largest.
    pub values: Vec<Complex<f64>>,
    /// The coordinate that moves most with the fastest.
    pub coordinate: usize,
}

/// The rates of small deviations from a state of a mechanism, the fastest ones of a large mechanism: the
/// eigenvalues of
///
/// ```text
/// δq̇ = δv,  δv̇ = (∂q̈/∂q) δq + (∂q̈/∂v) δv
/// ```
///
/// with q̈(q, v, t) of all coordinates, at a moment, by Arnoldi's iteration on differences of accelerations.
/// Deviations that the constraints forbid have the rates of the motion itself. It is `None` if an
/// acceleration is not finite.
///
/// An explicit scheme with the stability function R is stable where |R(hλ)| ≤ 1 for all of them.
///
/// # Example
/// ```
/// use mbs_analysis::rates;
/// use mbs_runtime::equations::At;
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     /// A block on a spring and a stiff damper: λ² + 1000 λ + 100 = 0.
///     pub Damped {
///         dof = 1;
///         body block (x) { mass = 1 [kg]; }
///         force all on x = -100 [N/m]*x - 1e3 [N*s/m]*der(x);
///     }
/// }
///
/// let found = rates(&Damped::declared(), At { t: 0.0, q: &[0.1], v: &[0.0] }, &[]);
/// let fastest = found.map_or(0.0, |found| found.values.iter().map(|rate| rate.norm()).fold(0.0, f64::max));
/// assert!((fastest / 999.9 - 1.0).abs() < 1e-6);
/// ```
///
/// # Source
/// W. E. Arnoldi, The principle of minimized iterations in the solution of the matrix eigenvalue problem,
/// Quart. Appl. Math. 9 (1951) 17-29.
pub fn rates(mechanism: &dyn Equations<f64>, at: At<'_, f64>, inputs: &[f64]) -> Option<Rates> {
    let n = at.q.len();
    let tangent = Tangents::new(mechanism, at, inputs)?;
    if n == 0 {
        return Some(Rates { values: Vec::new(), coordinate: 0 });
    }
    let count = MOST.min(2 * n);
    let (hessenberg, steps) = arnoldi(&tangent, count)?;
    let of = |size: usize| eigenvalues(hessenberg.view((0, 0), (size, size)).clone_owned());
    let mut values = of(steps)?;
    if steps < 2 * n && steps == count {
        let fewer = of(((FEWER * steps as f64) as usize).max(1))?;
        let is_near =
            |value: &Complex<f64>, other: &Complex<f64>| (value - other).norm() <= CONVERGED * value.norm();
        values.retain(|value| fewer.iter().any(|other| is_near(value, other)));
    }
    let mut fastest = start(2 * n);
    for _ in 0..POWERS {
        let next = tangent.times(&fastest)?;
        let size = next.norm();
        if size == 0.0 {
            break;
        }
        fastest = next / size;
    }
    let coordinate = fastest.rows(n, n).icamax();
    values
        .iter()
        .all(|rate| rate.re.is_finite() && rate.im.is_finite())
        .then_some(Rates { values, coordinate })
}

/// q̈ about a state, measured by the scales of the coordinates; of vectors (s δq, δv), so that both are as
/// large in a vibration of the rate s.
struct Tangents<'a> {
    mechanism: &'a dyn Equations<f64>,
    at: At<'a, f64>,
    inputs: &'a [f64],
    scales: DVector<f64>,
    here: DVector<f64>,
    /// Scales per second.
    speed: f64,
    rate: f64,
}

impl<'a> Tangents<'a> {
    fn new(mechanism: &'a dyn Equations<f64>, at: At<'a, f64>, inputs: &'a [f64]) -> Option<Self> {
        let (info, mut scales) = (mechanism.info(), Rest::new(mechanism, at.t, inputs, at.q).scales());
        for (place, state) in info.coordinates.iter().enumerate().skip(info.lines) {
            scales[place] = size_of_state(state, at.v.get(place).copied().unwrap_or_default());
        }
        let speeds = DVector::from_column_slice(at.v).component_div(&scales);
        let speed = speeds.iter().take(info.lines).fold(0.0_f64, |speed, v| speed.max(v.abs()));
        let here = DVector::zeros(at.q.len());
        let mut tangents = Self { mechanism, at, inputs, scales, here, speed: speed.max(SLOW), rate: 1.0 };
        tangents.here = tangents.acceleration(at.q, at.v)?;
        tangents.rate = tangents.stiffest()?;
        Some(tangents)
    }

    /// q̈, in scales.
    fn acceleration(&self, q: &[f64], v: &[f64]) -> Option<DVector<f64>> {
        let mut acceleration = vec![0.0; q.len()];
        let mut multipliers = vec![0.0; self.mechanism.info().constraints.len()];
        let at = At { t: self.at.t, q, v };
        self.mechanism.reactions(at, self.inputs, &mut acceleration, &mut multipliers);
        let found = DVector::from_vec(acceleration).component_div(&self.scales);
        found.iter().all(|a| a.is_finite()).then_some(found)
    }

    /// (∂q̈/∂q) x
    fn by_positions(&self, x: &DVector<f64>) -> Option<DVector<f64>> {
        let moved = DVector::from_column_slice(self.at.q) + SHARE * x.component_mul(&self.scales);
        Some((self.acceleration(moved.as_slice(), self.at.v)? - &self.here) / SHARE)
    }

    /// (∂q̈/∂v) x
    fn by_velocities(&self, x: &DVector<f64>) -> Option<DVector<f64>> {
        let share = SHARE * self.speed;
        let faster = DVector::from_column_slice(self.at.v) + share * x.component_mul(&self.scales);
        Some((self.acceleration(self.at.q, faster.as_slice())? - &self.here) / share)
    }

    /// The root of the largest stiffness over its mass, about.
    fn stiffest(&self) -> Option<f64> {
        let (mut x, mut stiffness) = (start(self.at.q.len()), 0.0);
        for _ in 0..POWERS {
            let next = self.by_positions(&x)?;
            stiffness = next.norm();
            if stiffness == 0.0 {
                break;
            }
            x = next / stiffness;
        }
        Some(stiffness.sqrt().max(1.0))
    }

    /// (s δv, (∂q̈/∂q) δq + (∂q̈/∂v) δv) of (s δq, δv).
    fn times(&self, x: &DVector<f64>) -> Option<DVector<f64>> {
        let n = self.at.q.len();
        let (position, velocity) = (x.rows(0, n).clone_owned() / self.rate, x.rows(n, n).clone_owned());
        let acceleration = self.by_positions(&position)? + self.by_velocities(&velocity)?;
        let mut found = DVector::zeros(2 * n);
        found.rows_mut(0, n).copy_from(&(self.rate * velocity));
        found.rows_mut(n, n).copy_from(&acceleration);
        Some(found)
    }
}

/// A vector that no mechanism has as one of its own: of length 1.
fn start(count: usize) -> DVector<f64> {
    DVector::from_fn(count, |at, _| (1.0 + 2.3 * at as f64).sin() + 0.1).normalize()
}

/// The upper Hessenberg matrix of some steps, and how many there were.
fn arnoldi(tangents: &Tangents<'_>, count: usize) -> Option<(DMatrix<f64>, usize)> {
    let mut hessenberg = DMatrix::zeros(count, count);
    let mut basis = vec![start(2 * tangents.at.q.len())];
    for step in 0..count {
        let mut next = tangents.times(&basis[step])?;
        let size = next.norm();
        // twice, so that what is left is orthogonal to rounding
        for _ in 0..2 {
            for (row, direction) in basis.iter().enumerate() {
                let share = direction.dot(&next);
                hessenberg[(row, step)] += share;
                next.axpy(-share, direction, 1.0);
            }
        }
        let left = next.norm();
        if step + 1 == count || left <= 1e-12 * size {
            return Some((hessenberg, step + 1));
        }
        hessenberg[(step + 1, step)] = left;
        basis.push(next / left);
    }
    Some((hessenberg, count))
}

fn eigenvalues(matrix: DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let schur = Schur::try_new(matrix, f64::EPSILON, ITERATIONS)?;
    Some(schur.complex_eigenvalues().iter().copied().collect())
}
