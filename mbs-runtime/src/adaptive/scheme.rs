//! The schemes that runs to a tolerance take.

use core::fmt::Debug;

use mbs_interface::{Estimate, Interpolant};

use super::{Dynamics, Moment};
use crate::Scheme;
use crate::explicit::{self, Slopes, Span};
use crate::vectors::assign;

mod sealed {
    pub trait Sealed {}
    impl<S: crate::Scheme> Sealed for S {}
}
pub(crate) use sealed::Sealed;

/// A scheme that takes the steps of a run to a tolerance: an explicit [`Scheme`], or one of
/// [`implicit`](crate::implicit) for stiff forces.
pub trait AdaptiveScheme: Sealed + Copy + Debug + Send + Sync + 'static {
    /// The word that asks for it.
    const WORD: &'static str;
    /// The estimate of the error of a step; `None` if the scheme has none.
    const ESTIMATE: Option<Estimate>;
    /// The interpolant of a step; `None` for the polynomial through both ends.
    const INTERPOLANT: Option<&'static Interpolant>;

    /// The explicit scheme that looks for the error which ends a run.
    #[doc(hidden)]
    type Explicit: Scheme;

    /// One of something for each slope that the estimate of the error knows, but that of the end.
    #[doc(hidden)]
    type Slopes<X: Clone + Send>: Clone + Send + AsRef<[X]> + AsMut<[X]>;

    /// The same for all slopes.
    #[doc(hidden)]
    fn slopes<X: Clone + Send>(x: X) -> Self::Slopes<X>;

    /// One of something for each slope and each term of the interpolant, none without one.
    #[doc(hidden)]
    type Between<X: Clone + Send>: Clone + Send + AsRef<[X]> + AsMut<[X]>;

    /// The same for all of them.
    #[doc(hidden)]
    fn between<X: Clone + Send>(x: X) -> Self::Between<X>;

    /// The stages of a step: writes their slopes, and positions and velocities of the end, not projected
    /// yet. The growths of what was solved, added; nothing with fewer vectors than stages.
    #[doc(hidden)]
    fn advance<D: Dynamics>(
        of: (&D, &D::Inputs),
        from: &Moment<D::Real, D::States>,
        slopes: Slopes<'_, D::States>,
        there: &mut D::States,
        to: &mut Moment<D::Real, D::States>,
    ) -> Option<D::Real>;

    /// Writes the acceleration of the end of a step of `h` seconds, after its projection; its growth.
    #[doc(hidden)]
    fn finish<D: Dynamics>(
        of: (&D, &D::Inputs),
        h: D::Real,
        accelerations: &[D::States],
        there: &mut D::States,
        to: &mut Moment<D::Real, D::States>,
    ) -> Option<D::Real>;

    /// `true` if states between the ends of a step are [relaxed](Self::relax).
    #[doc(hidden)]
    const RELAXES: bool = false;

    /// Leads a state within a step of `h` seconds, and its acceleration, to where stiff forces are those that the
    /// acceleration asks for; the growth of what was solved.
    #[doc(hidden)]
    fn relax<D: Dynamics>(
        _: (&D, &D::Inputs),
        _h: D::Real,
        _there: &mut D::States,
        _state: &mut Moment<D::Real, D::States>,
    ) -> D::Real {
        D::Real::default()
    }

    /// Writes the acceleration of a state that no step led to, or whose inputs have changed; its growth.
    /// A scheme may start from that of the moment before, if there is one. The next step is tried with
    /// `h` seconds.
    #[doc(hidden)]
    fn begin<D: Dynamics>(
        of: (&D, &D::Inputs),
        h: Option<D::Real>,
        there: &mut D::States,
        now: &mut Moment<D::Real, D::States>,
    ) -> D::Real;
}

impl<S: Scheme> AdaptiveScheme for S {
    const WORD: &'static str = S::TABLEAU.word;
    const ESTIMATE: Option<Estimate> = S::TABLEAU.estimate;
    const INTERPOLANT: Option<&'static Interpolant> = S::TABLEAU.interpolant.as_ref();

    type Explicit = S;
    type Slopes<X: Clone + Send> = S::Stages<X>;

    fn slopes<X: Clone + Send>(x: X) -> Self::Slopes<X> {
        S::stages(x)
    }

    type Between<X: Clone + Send> = <S as Scheme>::Between<X>;

    fn between<X: Clone + Send>(x: X) -> Self::Between<X> {
        <S as Scheme>::between(x)
    }

    #[inline(always)]
    fn advance<D: Dynamics>(
        (dynamics, inputs): (&D, &D::Inputs),
        from: &Moment<D::Real, D::States>,
        Slopes { velocities, accelerations }: Slopes<'_, D::States>,
        there: &mut D::States,
        to: &mut Moment<D::Real, D::States>,
    ) -> Option<D::Real> {
        assign(velocities.first_mut()?, &from.v);
        assign(&mut to.q, &from.q);
        let span = Span { t: from.t, h: to.t - from.t, t_next: to.t };
        let slopes = Slopes { velocities: &mut *velocities, accelerations };
        let growth = explicit::step(S::TABLEAU, &span, &mut to.q, slopes, there, |stage, t, q, v, a| {
            if stage > 0 {
                return dynamics.acceleration(t, q, v, inputs, a);
            }
            // known from the end of the step before
            assign(a, &from.a);
            D::Real::default()
        });
        assign(&mut to.v, velocities.first()?);
        assign(velocities.first_mut()?, &from.v);
        Some(growth)
    }

    #[inline(always)]
    fn finish<D: Dynamics>(
        (dynamics, inputs): (&D, &D::Inputs),
        _: D::Real,
        _: &[D::States],
        _: &mut D::States,
        Moment { t, q, v, a }: &mut Moment<D::Real, D::States>,
    ) -> Option<D::Real> {
        Some(dynamics.acceleration(*t, q, v, inputs, a))
    }

    #[inline(always)]
    fn begin<D: Dynamics>(
        (dynamics, inputs): (&D, &D::Inputs),
        _: Option<D::Real>,
        _: &mut D::States,
        Moment { t, q, v, a }: &mut Moment<D::Real, D::States>,
    ) -> D::Real {
        dynamics.acceleration(*t, q, v, inputs, a)
    }
}
