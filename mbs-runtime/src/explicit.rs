//! An explicit step on the first-order form (q, v)˙ = (v, q̈), for any tableau.

use mbs_schemes::{Row, Tableau};

use crate::{Components, Gains, Mechanism, Method, Real, Scheme, State};

/// What vectors of a step are made of: a scalar, or a column of them.
pub trait Element: Copy {
    /// The same in every lane.
    fn constant(value: f64) -> Self;
    /// The sum.
    #[must_use]
    fn plus(self, other: Self) -> Self;
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

/// A step, and the pivot growths of its stages, added: q becomes that of its end, and so does
/// the first of the velocities.
///
/// `solve` is given the number of a stage, its time and state, writes its q̈ and returns its
/// growth. `there` is room for the position of a stage. With fewer vectors than stages there
/// is no step, and the growth is no number.
#[inline(always)]
pub fn step<E: Element, V: AsRef<[E]> + AsMut<[E]>>(
    tableau: &Tableau,
    span: &Span<E>,
    q: &mut V,
    slopes: Slopes<'_, V>,
    there: &mut V,
    solve: impl FnMut(usize, E, &V, &V, &mut V) -> E,
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
    mut solve: impl FnMut(usize, E, &V, &V, &mut V) -> E,
) -> Option<E> {
    let Slopes { velocities, accelerations } = slopes;
    let mut growth = solve(0, span.t, q, velocities.first()?, accelerations.first_mut()?);
    for (before, row) in tableau.stages.iter().enumerate() {
        let stage = before + 1;
        let (v, later) = velocities.split_at_mut_checked(stage)?;
        let (a, unknown) = accelerations.split_at_mut_checked(stage)?;
        let (v_there, a_there) = (later.first_mut()?, unknown.first_mut()?);
        lead(row, span.h, v, q, there);
        lead(row, span.h, a, v.first()?, v_there);
        growth = growth.plus(solve(stage, span.time(row.node()), there, v_there, a_there));
    }
    advance(&tableau.update, span.h, velocities, q);
    advance(&tableau.update, span.h, accelerations, velocities.first_mut()?);
    Some(growth)
}

/// x = x₀ + (share · h) Σ w k
#[inline(always)]
fn lead<E: Element, V: AsRef<[E]> + AsMut<[E]>>(row: &Row, h: E, slopes: &[V], from: &V, to: &mut V) {
    let factor = factor(row, h);
    for (at, (to, from)) in to.as_mut().iter_mut().zip(from.as_ref()).enumerate() {
        *to = from.plus(factor.times(sum(row, slopes, at)));
    }
}

/// The same where x₀ stands.
#[inline(always)]
fn advance<E: Element, V: AsRef<[E]> + AsMut<[E]>>(row: &Row, h: E, slopes: &[V], x: &mut V) {
    let factor = factor(row, h);
    for (at, x) in x.as_mut().iter_mut().enumerate() {
        *x = x.plus(factor.times(sum(row, slopes, at)));
    }
}

/// share · h
#[inline(always)]
fn factor<E: Element>(row: &Row, h: E) -> E {
    if row.share == 1.0 { h } else { E::constant(row.share).times(h) }
}

/// Σ w k of one component, from the first slope to the last; no number without slopes.
#[inline(always)]
fn sum<E: Element, V: AsRef<[E]>>(row: &Row, slopes: &[V], at: usize) -> E {
    let mut sum = None;
    for (&weight, slope) in row.weights.iter().zip(slopes) {
        let Some(&slope) = slope.as_ref().get(at) else { continue };
        if weight == 0.0 {
            continue;
        }
        let term = if weight == 1.0 { slope } else { E::constant(weight).times(slope) };
        sum = Some(match sum {
            None => term,
            Some(sum) => E::plus(sum, term),
        });
    }
    sum.unwrap_or(E::constant(f64::NAN))
}

/// A step of a mechanism whose health has not been tested.
pub(crate) struct Trial<M: Mechanism> {
    /// q⁺, v⁺
    pub next: State<M::Coordinates>,
    /// The growths of all stages, added.
    pub growth: M::Real,
}

/// The step of a mechanism stage by stage, without a branch.
#[inline(always)]
pub(crate) fn trial<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    span: &Span<M::Real>,
) -> Trial<M> {
    // Each vector becomes an array once: of long chains these are calls.
    let (mut q, v) = (at.q.into_array(), at.v.into_array());
    let (mut velocities, mut accelerations) = (X::Scheme::stages(v), X::Scheme::stages(v));
    let slopes = Slopes { velocities: velocities.as_mut(), accelerations: accelerations.as_mut() };
    let (mut there, mut feedback) = (q, None);
    let growth = step(X::Scheme::TABLEAU, span, &mut q, slopes, &mut there, |_, t, q, v, a| {
        let at = State { t, q: Components::from_array(*q), v: Components::from_array(*v) };
        if let Some(held) = &feedback
            && X::EXPLICIT.is_held
        {
            let solved = mechanism.constrained(&at, inputs, held);
            *a = solved.acceleration.into_array();
            solved.growth
        } else {
            let solved = mechanism.stabilized(&at, inputs, gains);
            (*a, feedback) = (solved.acceleration.into_array(), Some(solved.feedback));
            solved.growth
        }
    });
    let [v, ..] = velocities.as_ref() else { return Trial { next: *at, growth } };
    let (q, v) = (Components::from_array(q), Components::from_array(*v));
    Trial { next: State { t: span.t_next, q, v }, growth }
}
