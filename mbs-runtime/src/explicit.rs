//! An explicit step on the first-order form (q, v)˙ = (v, q̈), for any tableau.

use core::marker::PhantomData;

use mbs_schemes::{Row, Stabilization, Tableau};

use crate::arrays::States;
use crate::{Components, Gains, Mechanism, Method, Real, Scheme, State};

/// What vectors of a step are made of: a scalar, or a column of them.
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

/// What computes the accelerations of stages.
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

/// What [`project`] wants to know of a state: the correction of its positions, or of the
/// velocities `v`.
#[derive(Debug)]
pub struct Beside<'a, V> {
    /// q
    pub q: &'a V,
    /// v, where it is their correction that is asked for.
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
            block::<8, E, V>(row, slopes, at, &mut put);
            at += 8;
        }
        if at + 4 <= count {
            block::<4, E, V>(row, slopes, at, &mut put);
            at += 4;
        }
        if at + 2 <= count {
            block::<2, E, V>(row, slopes, at, &mut put);
            at += 2;
        }
    }
    while at < count {
        block::<1, E, V>(row, slopes, at, &mut put);
        at += 1;
    }
}

/// The sums of `N` components from the one at `at` on.
#[inline(always)]
fn block<const N: usize, E: Element, V: AsRef<[E]>>(
    row: &Row,
    slopes: &[V],
    at: usize,
    put: &mut impl FnMut(usize, E),
) {
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
    for (offset, sum) in sums.into_iter().enumerate() {
        put(at + offset, sum);
    }
}

/// The correction of the states of a mechanism, for [`project`].
#[inline(always)]
pub(crate) fn correct<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    at: &Beside<'_, States<M>>,
    delta: &mut States<M>,
) -> M::Real {
    let v = at.v.unwrap_or(at.q);
    let at_states = State { t, q: Components::from_array(*at.q), v: Components::from_array(*v) };
    let all = mechanism.complete(&at_states);
    let violation = match at.v {
        None => mechanism.phi(t, &all.q),
        Some(_) => mechanism.phi_dot(&all),
    };
    let solved = mechanism.projection(t, &all.q, &violation);
    *delta = M::states(solved.acceleration).into_array();
    solved.growth
}

/// A step of a mechanism whose health has not been tested.
pub(crate) struct Trial<M: Mechanism> {
    /// q⁺, v⁺
    pub next: State<M::States>,
    /// The growths of all stages, added.
    pub growth: M::Real,
}

/// The stages of a step of a mechanism.
struct Stages<'a, M: Mechanism, X> {
    mechanism: &'a M,
    inputs: &'a M::Inputs,
    gains: &'a Gains<M::Real>,
    /// That of the first stage, where it is held.
    feedback: Option<M::Constraints>,
    method: PhantomData<X>,
}

impl<M: Mechanism, X: Method> Solve<M::Real, States<M>> for Stages<'_, M, X> {
    #[inline(always)]
    fn solve(&mut self, _: usize, t: M::Real, q: &States<M>, v: &States<M>, a: &mut States<M>) -> M::Real {
        let at = State { t, q: Components::from_array(*q), v: Components::from_array(*v) };
        let given = match X::EXPLICIT.stabilization {
            Stabilization::Held => self.feedback,
            Stabilization::PerStage => None,
            Stabilization::Projection => Some(Components::splat(M::Real::default())),
        };
        if let Some(given) = &given {
            let solved = self.mechanism.constrained(&at, self.inputs, given);
            *a = solved.acceleration.into_array();
            solved.growth
        } else {
            let solved = self.mechanism.stabilized(&at, self.inputs, self.gains);
            (*a, self.feedback) = (solved.acceleration.into_array(), Some(solved.feedback));
            solved.growth
        }
    }
}

/// The step of a mechanism stage by stage, without a branch.
#[inline(always)]
pub(crate) fn trial<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    span: &Span<M::Real>,
) -> Trial<M> {
    let mut stages = Stages::<M, X> { mechanism, inputs, gains, feedback: None, method: PhantomData };
    let solve = |stage: usize, t: M::Real, q: &States<M>, v: &States<M>, a: &mut States<M>| {
        stages.solve(stage, t, q, v, a)
    };
    tried::<M, X>(mechanism, at, span, solve)
}

/// The same with all stages in place, for lanes.
#[inline(always)]
pub(crate) fn trial_in_place<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    span: &Span<M::Real>,
) -> Trial<M> {
    let stages = Stages::<M, X> { mechanism, inputs, gains, feedback: None, method: PhantomData };
    tried::<M, X>(mechanism, at, span, stages)
}

#[inline(always)]
fn tried<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    span: &Span<M::Real>,
    solve: impl Solve<M::Real, States<M>>,
) -> Trial<M> {
    // Each vector becomes an array once: of long chains these are calls.
    let (mut q, v) = (at.q.into_array(), at.v.into_array());
    let (mut velocities, mut accelerations) = (X::Scheme::stages(v), X::Scheme::stages(v));
    let slopes = Slopes { velocities: velocities.as_mut(), accelerations: accelerations.as_mut() };
    let mut there = q;
    let mut growth = step_of(X::Scheme::TABLEAU, span, &mut q, slopes, &mut there, solve);
    let [v, ..] = velocities.as_mut() else { return Trial { next: *at, growth } };
    if X::EXPLICIT.is_projected() {
        growth =
            growth + project(&mut q, v, &mut there, |at, delta| correct(mechanism, span.t_next, &at, delta));
    }
    let (q, v) = (Components::from_array(q), Components::from_array(*v));
    Trial { next: State { t: span.t_next, q, v }, growth }
}
