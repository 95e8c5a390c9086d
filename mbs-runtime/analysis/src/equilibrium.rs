//! Positions at which nothing moves.

use mbs_runtime::equations::Described;
use nalgebra::{DMatrix, DVector};

use crate::Error;
use crate::tangent::{Rest, Tangent};

/// How an equilibrium is looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// By Newton's method, and by relaxation from the same position if that leads nowhere.
    #[default]
    Automatic,
    /// By Newton's method alone: the nearest equilibrium, stable or not.
    Newton,
    /// By relaxation: where the mechanism would come to rest from here if it moved slowly through a
    /// viscous fluid, which is a stable equilibrium.
    Relaxation,
}

/// Where an equilibrium is looked for, and how.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Search {
    /// The positions to begin from, which decide on the branch; `None` for the declared start.
    pub from: Option<Vec<f64>>,
    /// The inputs; `None` for their defaults.
    pub inputs: Option<Vec<f64>>,
    /// The time in s at which drives and forces are held.
    pub t: f64,
    /// How it is looked for.
    pub strategy: Strategy,
}

/// A position at which nothing moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// The time in s at which drives and forces are held.
    pub t: f64,
    /// Positions.
    pub q: Vec<f64>,
    /// Multipliers: the reactions that hold it.
    pub multipliers: Vec<f64>,
    /// The inputs it was found with.
    pub inputs: Vec<f64>,
    /// κ of K_r x = κ M_r x, ascending, in 1/s²: the squares of the natural frequencies of an
    /// undamped mechanism, negative for directions in which it falls away.
    pub stiffness: Vec<f64>,
    /// The iterations that it took.
    pub iterations: u32,
}

/// Whether small disturbances grow, as far as the stiffness tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// Every small displacement is driven back.
    Stable,
    /// Some displacements are neither driven back nor driven on.
    Indifferent,
    /// The mechanism falls away in so many directions.
    Unstable {
        /// How many negative stiffnesses there are.
        directions: usize,
    },
}

/// A stiffness is zero that is this small a share of the largest one: a hundred times the error of
/// its difference.
const ZERO: f64 = 1e-9;
const ITERATIONS: u32 = 200;
/// A correction moves no coordinate by more than this share of its scale.
const LONGEST: f64 = 0.25;
/// The search has ended when a correction is below this share.
const SMALL: f64 = 1e-11;
/// At rest accelerates what accelerates with less than this share of the acceleration at the start,
/// or of that which its stiffness gives it for a displacement by its scale,
const REST: f64 = 1e-9;
/// or with less than this many scales per s².
const STILL: f64 = 1e-11;
/// Relaxation leaves an unstable equilibrium by this many scales.
const PUSH: f64 = 1e-2;
/// A step of Newton's method is halved at most so often.
const HALVINGS: u32 = 6;
/// The search ends where a coordinate is this many scales away.
const FAR: f64 = 1e4;

impl Equilibrium {
    /// What the stiffness says of small disturbances. Friction, dampers and gyroscopic terms are
    /// not asked; forces that follow the motion may make a position unstable by flutter although
    /// its stiffness is positive.
    pub fn stability(&self) -> Stability {
        let largest = self.stiffness.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let directions = self.stiffness.iter().filter(|x| **x < -ZERO * largest).count();
        match directions {
            0 if self.stiffness.iter().all(|x| *x > ZERO * largest) => Stability::Stable,
            0 => Stability::Indifferent,
            directions => Stability::Unstable { directions },
        }
    }

    /// Whether every small displacement is driven back.
    pub fn is_stable(&self) -> bool {
        self.stability() == Stability::Stable
    }
}

/// A position near the given one at which nothing moves: with v = 0,
///
/// ```text
/// ⎡ Q − Φ_qᵀ λ ⎤
/// ⎣ Φ          ⎦ = 0
/// ```
///
/// The unknowns are minimal coordinates z along the constraints, Φ_q N = 0, and what vanishes is
/// the acceleration from rest, z̈ = N⁺q̈: zero where the forces along the constraints are. Newton's
/// method takes steps of a bounded length, so that the branch of the start is kept, and a pseudo
/// inverse, so that a direction without forces does not matter. Relaxation follows ż = z̈ in
/// implicit steps that grow as the acceleration falls (pseudo-transient continuation): towards a
/// stable equilibrium, past unstable ones, from which it is pushed if it begins there.
///
/// Drives are held where they are at `t`. Derivatives are exact for a mechanism that is
/// [`differentiable`](Described::differentiable): a text, or a type in
/// [`Differentiated`](mbs_runtime::equations::Differentiated). For other types they are five-point
/// differences, about 10⁻¹¹ of their size, which bounds the rate of convergence and not the result;
/// stiffnesses are good to ten digits then.
///
/// # Errors
/// [`Error::NoFreedom`], [`Error::NoEquilibrium`], [`Error::Length`]; of the mechanism
/// [`NotAssembled`](mbs_runtime::Error::NotAssembled).
///
/// # Source
/// C. T. Kelley, D. E. Keyes, Convergence analysis of pseudo-transient continuation, SIAM J.
/// Numer. Anal. 35 (1998) 508-523.
pub fn equilibrium(mechanism: &dyn Described<f64>, search: &Search) -> Result<Equilibrium, Error> {
    let info = mechanism.info();
    if info.dof <= 0 {
        return Err(Error::NoFreedom { mechanism: info.name });
    }
    let declared: Vec<f64> = info.coordinates.iter().map(|q| q.default).collect();
    let defaults: Vec<f64> = info.inputs.iter().map(|input| input.default).collect();
    let from = search.from.clone().unwrap_or(declared);
    let inputs = search.inputs.clone().unwrap_or(defaults);
    check("positions", &from, info.coordinates.len())?;
    check("inputs", &inputs, info.inputs.len())?;
    let mut start = DVector::from_vec(from);
    let rest = Rest::new(mechanism, search.t, &inputs, start.as_slice());
    rest.assemble(&mut start)?;
    let (q, iterations) = match search.strategy {
        Strategy::Newton => find(&rest, start, false)?,
        Strategy::Relaxation => find(&rest, start, true)?,
        Strategy::Automatic => find(&rest, start.clone(), false).or_else(|_| find(&rest, start, true))?,
    };
    let tangent = rest.tangent(&q);
    let (_, multipliers) = rest.acceleration(&q);
    let stiffness = stiffness(&rest, &q, &tangent);
    let (q, multipliers) = (q.as_slice().to_vec(), multipliers.as_slice().to_vec());
    Ok(Equilibrium { t: search.t, q, multipliers, inputs, stiffness, iterations })
}

fn check(what: &'static str, values: &[f64], expected: usize) -> Result<(), Error> {
    if values.len() == expected { Ok(()) } else { Err(Error::Length { what, found: values.len(), expected }) }
}

/// The eigenvalues of the symmetric part of K_r = −M_r A_r with respect to M_r, ascending.
fn stiffness(rest: &Rest<'_>, q: &DVector<f64>, tangent: &Tangent) -> Vec<f64> {
    let mass = rest.reduced_mass(q, tangent);
    let stiffness = -(&mass * rest.stiffness_rate(q, tangent));
    let symmetric = (&stiffness + stiffness.transpose()) * 0.5;
    // L⁻¹ K L⁻ᵀ with M = L Lᵀ; without a mass the stiffness alone has the signs
    let reduced = match mass.cholesky().map(|factors| factors.l()) {
        Some(lower) => {
            let half = lower.solve_lower_triangular(&symmetric).unwrap_or_else(|| symmetric.clone());
            lower.solve_lower_triangular(&half.transpose()).unwrap_or(half)
        }
        None => symmetric,
    };
    let mut values: Vec<f64> = reduced.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The acceleration that is left at a position.
struct Residual {
    /// z̈
    minimal: DVector<f64>,
    /// Its norm, measured by the scales of the coordinates, in 1/s².
    size: f64,
}

fn residual(rest: &Rest<'_>, q: &DVector<f64>, tangent: &Tangent) -> Residual {
    let (a, _) = rest.acceleration(q);
    Residual { size: a.component_div(&rest.scales()).amax(), minimal: tangent.minimal(&a) }
}

/// Newton's method, or relaxation in implicit steps.
fn find(rest: &Rest<'_>, start: DVector<f64>, is_relaxed: bool) -> Result<(DVector<f64>, u32), Error> {
    let mut q = start;
    let mut tangent = rest.tangent(&q);
    let mut now = residual(rest, &q, &tangent);
    // steps of the relaxation, in times that are characteristic of where it is
    let mut pace = 1.0;
    let (mut best, strongest) = ((now.size, q.clone()), now.size);
    for iteration in 1..=ITERATIONS {
        let rate = rest.stiffness_rate(&q, &tangent);
        if is_relaxed
            && now.size <= STILL
            && let Some(falling) = falling(&rate)
        {
            // nothing moves it from where it balances, so that it is pushed
            let step = &tangent.directions * falling;
            let length = step.component_div(&rest.scales()).amax();
            (q, _) = moved(rest, &q, &step, PUSH / length)?;
            tangent = rest.tangent(&q);
            now = residual(rest, &q, &tangent);
            continue;
        }
        let shift = if is_relaxed { shift(&rate, now.size, pace) } else { 0.0 };
        let system = DMatrix::identity(rate.nrows(), rate.nrows()) * shift - &rate;
        let Some(z) = solved(&system, &now.minimal) else { break };
        let step = &tangent.directions * z;
        let length = step.component_div(&rest.scales()).amax();
        if !length.is_finite() {
            break;
        }
        let mut share = (LONGEST / length).min(1.0);
        let (mut next, mut then) = moved(rest, &q, &step, share)?;
        // A step of Newton's method that enlarges the acceleration is halved, unless the increase is
        // rounding. Relaxation takes its steps whole, because the acceleration grows on its way.
        for _ in 0..if is_relaxed || length < SMALL { 0 } else { HALVINGS } {
            if then.size <= now.size {
                break;
            }
            share *= 0.5;
            (next, then) = moved(rest, &q, &step, share)?;
        }
        pace = if then.size < now.size { 4.0 * pace } else { 1.0 };
        let size = share * length;
        tangent = rest.tangent(&next);
        (q, now) = (next, then);
        // the directions have changed
        now = Residual { size: now.size, ..residual(rest, &q, &tangent) };
        if now.size < best.0 {
            best = (now.size, q.clone());
        }
        if q.component_div(&rest.scales()).amax() > FAR || !now.size.is_finite() {
            break;
        }
        // in a direction without stiffness nothing may act either
        let is_at_rest = now.size <= REST * strongest.max(rate.amax()) + STILL;
        if size < SMALL && share >= 1.0 && shift <= rate.amax() && is_at_rest {
            return Ok((q, iteration));
        }
    }
    Err(lost(rest, &best.1))
}

/// 1/τ of an implicit step of relaxation, from the stiffness, or from the acceleration where there is hardly
/// any, such as at a pendulum that begins level. Where the mechanism falls away, it is twice the fastest
/// rate at which it does: a longer step would lead back to where it falls from.
fn shift(rate: &DMatrix<f64>, acceleration: f64, pace: f64) -> f64 {
    let symmetric = (rate + rate.transpose()) * 0.5;
    let fastest = symmetric.symmetric_eigenvalues().iter().copied().fold(0.0, f64::max);
    let size = rate.amax();
    if fastest > ZERO * size { 2.0 * fastest } else { size.max(acceleration) / pace }
}

/// The direction in which a mechanism falls away fastest, if it does, by the power method.
fn falling(rate: &DMatrix<f64>) -> Option<DVector<f64>> {
    const STEPS: usize = 30;
    let (size, f) = (rate.amax(), rate.nrows());
    let symmetric = (rate + rate.transpose()) * 0.5;
    let shifted = &symmetric + DMatrix::from_diagonal_element(f, f, size * f as f64);
    // not across any direction, as a vector of ones may be
    let mut direction = DVector::from_fn(f, |at, _| 1.0 + 0.1 * at as f64);
    for _ in 0..STEPS {
        direction = &shifted * direction;
        direction /= direction.norm();
    }
    let grows = direction.dot(&(&symmetric * &direction));
    (grows > ZERO * size && grows.is_finite()).then_some(direction)
}

/// Where a share of a step along the tangent leads on the constraints, and what accelerates there.
fn moved(
    rest: &Rest<'_>,
    q: &DVector<f64>,
    step: &DVector<f64>,
    share: f64,
) -> Result<(DVector<f64>, Residual), Error> {
    let mut next = q + step * share;
    rest.assemble(&mut next)?;
    let tangent = rest.tangent(&next);
    let found = residual(rest, &next, &tangent);
    Ok((next, found))
}

/// The least z of system · z = right, without directions in which nothing acts.
fn solved(system: &DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    let decomposition = system.clone().svd(true, true);
    let largest = decomposition.singular_values.amax();
    decomposition.solve(right, ZERO * largest).ok().filter(|z| z.iter().all(|z| z.is_finite()))
}

fn lost(rest: &Rest<'_>, q: &DVector<f64>) -> Error {
    let (a, _) = rest.acceleration(q);
    let measured = a.component_div(&rest.scales());
    let at = measured.iamax();
    let coordinate = rest.mechanism.info().coordinates.get(at).map_or("", |q| q.name);
    Error::NoEquilibrium { coordinate, acceleration: a[at], iterations: ITERATIONS }
}
