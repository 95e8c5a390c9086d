//! An explicit step on the first-order form (q, v)˙ = (v, q̈), for any tableau.
//!
//! # One step for every scheme
//!
//! A scheme is a table of numbers in `mbs-interface`. A step is written here once for any table: for scalars,
//! lanes and columns, on the stack, on slices and on the arrays of long chains. The order of operations
//! stands here. Fused programs and C code keep it, so that all paths agree to the bit.

mod trial;

use mbs_interface::{Row, Tableau};

use crate::Real;
pub(crate) use trial::{Trial, correct, trial, trial_in_place};

/// A component of the vectors of a step: a scalar, or a column of them.
pub trait Element: Copy {
    /// The same in every lane.
    fn constant(value: f64) -> Self;
    /// The sum.
    #[must_use]
    fn plus(self, other: Self) -> Self;
    /// The difference.
    #[must_use]
    fn minus(self, other: Self) -> Self;
    /// The product, lane by lane.
    #[must_use]
    fn times(self, other: Self) -> Self;
}

impl<T: Real> Element for T {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        T::from_f64(value)
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }
}

impl<T: Real, const C: usize> Element for [T; C] {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        [T::from_f64(value); C]
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        core::array::from_fn(|lane| self[lane] + other[lane])
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        core::array::from_fn(|lane| self[lane] - other[lane])
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        core::array::from_fn(|lane| self[lane] * other[lane])
    }
}

/// When a step takes place.
#[derive(Clone, Copy, Debug)]
pub struct Span<E> {
    /// t of the start in s.
    pub t: E,
    /// h in s.
    pub h: E,
    /// t of the end, given apart: k·h and not a sum of k roundings.
    pub t_next: E,
}

impl<E: Element> Span<E> {
    /// The time of a stage, a share `node` of the step behind the start.
    #[inline(always)]
    pub fn time(&self, node: f64) -> E {
        if node == 1.0 { self.t_next } else { self.t.plus(E::constant(node).times(self.h)) }
    }
}

/// The vectors of a step, one of each kind for every stage.
#[derive(Debug)]
pub struct Slopes<'a, V> {
    /// The slopes of q. The first one is v: at the start of the step before, at its end
    /// afterwards.
    pub velocities: &'a mut [V],
    /// The slopes of v, which are computed.
    pub accelerations: &'a mut [V],
}

/// A solver for the accelerations of stages.
///
/// A closure is one. It is a function of its own where the compiler finds it long, which costs
/// nothing but in lanes: a function that is called there has no vectors.
pub trait Solve<E, V> {
    /// Given the number of a stage, its time and state, writes its q̈ and returns its growth.
    fn solve(&mut self, stage: usize, t: E, q: &V, v: &V, acceleration: &mut V) -> E;
}

impl<E, V, F: FnMut(usize, E, &V, &V, &mut V) -> E> Solve<E, V> for F {
    #[inline(always)]
    fn solve(&mut self, stage: usize, t: E, q: &V, v: &V, acceleration: &mut V) -> E {
        self(stage, t, q, v, acceleration)
    }
}

/// A step, and the pivot growths of its stages, added: q becomes that of its end, and so does
/// the first of the velocities.
///
/// `solve` is asked for the accelerations of the stages. `there` is room for the position of a
/// stage. With fewer vectors than stages there is no step, and the growth is no number.
#[inline(always)]
pub fn step<E: Element, V: AsRef<[E]> + AsMut<[E]>>(
    tableau: &Tableau,
    span: &Span<E>,
    q: &mut V,
    slopes: Slopes<'_, V>,
    there: &mut V,
    solve: impl FnMut(usize, E, &V, &V, &mut V) -> E,
) -> E {
    step_of(tableau, span, q, slopes, there, solve)
}

/// The same with whatever solves.
#[inline(always)]
fn step_of<E: Element, V: AsRef<[E]> + AsMut<[E]>>(
    tableau: &Tableau,
    span: &Span<E>,
    q: &mut V,
    slopes: Slopes<'_, V>,
    there: &mut V,
    solve: impl Solve<E, V>,
) -> E {
    checked(tableau, span, q, slopes, there, solve).unwrap_or(E::constant(f64::NAN))
}

#[inline(always)]
fn checked<E: Element, V: AsRef<[E]> + AsMut<[E]>>(
    tableau: &Tableau,
    span: &Span<E>,
    q: &mut V,
    slopes: Slopes<'_, V>,
    there: &mut V,
    mut solve: impl Solve<E, V>,
) -> Option<E> {
    let Slopes { velocities, accelerations } = slopes;
    let mut growth = solve.solve(0, span.t, q, velocities.first()?, accelerations.first_mut()?);
    for (before, row) in tableau.stages.iter().enumerate() {
        let stage = before + 1;
        let (v, later) = velocities.split_at_mut_checked(stage)?;
        let (a, unknown) = accelerations.split_at_mut_checked(stage)?;
        let (v_there, a_there) = (later.first_mut()?, unknown.first_mut()?);
        lead(row, span.h, v, q, there);
        lead(row, span.h, a, v.first()?, v_there);
        growth = growth.plus(solve.solve(stage, span.time(row.node()), there, v_there, a_there));
    }
    advance(&tableau.update, span.h, velocities, q);
    advance(&tableau.update, span.h, accelerations, velocities.first_mut()?);
    Some(growth)
}

/// A state at which [`project`] asks for a correction: of its positions, or of the velocities `v`.
#[derive(Debug)]
pub struct Beside<'a, V> {
    /// q
    pub q: &'a V,
    /// v, if the correction is that of the velocities.
    pub v: Option<&'a V>,
}

/// Moves positions and then velocities onto the constraints, each by one correction: x ← x − Δ.
/// The growths of both, added.
///
/// `correct` writes the Δ of [`projection`](crate::Mechanism::projection) for the violation of
/// the positions, or of the velocities there, and returns its growth; `delta` is room for it.
#[inline(always)]
pub fn project<E: Element, V: AsRef<[E]> + AsMut<[E]>>(
    q: &mut V,
    v: &mut V,
    delta: &mut V,
    mut correct: impl FnMut(Beside<'_, V>, &mut V) -> E,
) -> E {
    let of_positions = correct(Beside { q, v: None }, delta);
    subtract(q, delta);
    let of_velocities = correct(Beside { q, v: Some(v) }, delta);
    subtract(v, delta);
    of_positions.plus(of_velocities)
}

#[inline(always)]
pub(crate) fn subtract<E: Element, V: AsRef<[E]> + AsMut<[E]>>(x: &mut V, delta: &V) {
    for (x, delta) in x.as_mut().iter_mut().zip(delta.as_ref()) {
        *x = x.minus(*delta);
    }
}

/// x = x₀ + (share · h) Σ w k
#[inline(always)]
fn lead<E: Element, V: AsRef<[E]> + AsMut<[E]>>(row: &Row, h: E, slopes: &[V], from: &V, to: &mut V) {
    let (factor, from, to) = (factor(row, h), from.as_ref(), to.as_mut());
    sums(row, slopes, to.len().min(from.len()), |at, sum| {
        if let (Some(to), Some(from)) = (to.get_mut(at), from.get(at)) {
            *to = from.plus(factor.times(sum));
        }
    });
}

/// The same where x₀ stands.
#[inline(always)]
fn advance<E: Element, V: AsRef<[E]> + AsMut<[E]>>(row: &Row, h: E, slopes: &[V], x: &mut V) {
    let (factor, x) = (factor(row, h), x.as_mut());
    sums(row, slopes, x.len(), |at, sum| {
        if let Some(x) = x.get_mut(at) {
            *x = x.plus(factor.times(sum));
        }
    });
}

/// share · h
#[inline(always)]
pub(crate) fn factor<E: Element>(row: &Row, h: E) -> E {
    if row.share == 1.0 { h } else { E::constant(row.share).times(h) }
}

/// Σ w k of the first `count` components, each from the first slope to the last; no number
/// without slopes. Several components are summed side by side, so that their sums stay in
/// registers.
#[inline(always)]
pub(crate) fn sums<E: Element, V: AsRef<[E]>>(
    row: &Row,
    slopes: &[V],
    count: usize,
    mut put: impl FnMut(usize, E),
) {
    let mut at = 0;
    // columns of numbers are wide enough by themselves
    if size_of::<E>() <= size_of::<f64>() {
        while at + 8 <= count {
            hand_over(block::<8, E, V>(row, slopes, at), at, &mut put);
            at += 8;
        }
        if at + 4 <= count {
            hand_over(block::<4, E, V>(row, slopes, at), at, &mut put);
            at += 4;
        }
        if at + 2 <= count {
            hand_over(block::<2, E, V>(row, slopes, at), at, &mut put);
            at += 2;
        }
    }
    while at < count {
        hand_over(block::<1, E, V>(row, slopes, at), at, &mut put);
        at += 1;
    }
}

/// Hands components over, from the one at `at` on.
#[inline(always)]
fn hand_over<const N: usize, E>(sums: [E; N], at: usize, put: &mut impl FnMut(usize, E)) {
    for (offset, sum) in sums.into_iter().enumerate() {
        put(at + offset, sum);
    }
}

/// The sums of `N` components from the one at `at` on.
#[inline(always)]
fn block<const N: usize, E: Element, V: AsRef<[E]>>(row: &Row, slopes: &[V], at: usize) -> [E; N] {
    let mut terms = row.weights.iter().zip(slopes).filter_map(|(&weight, slope)| {
        let slope = slope.as_ref().get(at..)?.first_chunk::<N>()?;
        (weight != 0.0).then_some((E::constant(weight), slope))
    });
    let mut sums = [E::constant(f64::NAN); N];
    if let Some((weight, slope)) = terms.next() {
        for (sum, slope) in sums.iter_mut().zip(slope) {
            *sum = weight.times(*slope);
        }
    }
    for (weight, slope) in terms {
        for (sum, slope) in sums.iter_mut().zip(slope) {
            *sum = sum.plus(weight.times(*slope));
        }
    }
    sums
}
