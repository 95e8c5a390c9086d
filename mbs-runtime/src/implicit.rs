//! Diagonally implicit schemes, for forces that are too stiff for explicit steps.
//!
//! [`Adaptive`](crate::Adaptive) runs take them as they take explicit ones, to a tolerance and with events.
//! [`TrBdf2`](crate::TrBdf2) is the first of them with a constant step.
//!
//! # One step
//! With γ and the weights of a scheme (`mbs-interface`), a stage is found from the slopes before it by
//!
//! ```text
//! vᵢ = v + h Σ aᵢⱼ aⱼ + γh aᵢ,  qᵢ = q + h Σ aᵢⱼ vⱼ + γh vᵢ,  aᵢ = a(qᵢ, vᵢ)
//! ```
//!
//! Newton's method takes a fixed number of steps from the acceleration of the stage before, each by one
//! elimination of M − γh ∂Q/∂v − γ²h² ∂Q/∂q in place of M, with the exact derivatives of the forces
//! ([`Mechanism::implicit`](crate::Mechanism::implicit)). What its last step still changed is part of the
//! estimate of the error. So a stage that is not solved for makes the next steps shorter, as a stage that is
//! too coarse does. The last stage is the end of the step. It is projected onto the constraints, and a last step of
//! Newton's method leads it, and every state between the ends of a step, to where stiff forces are those that its
//! acceleration asks for: an error of 10⁻⁹ m is a force of 1 N in a spring of 10⁹ N/m.
//!
//! # Which one to take
//! A step of [`Esdirk4`] takes seventeen eliminations and a projection, one of [`TrBdf2`] six. For errors below 10⁻⁴ of the motion
//! [`Esdirk4`] is the faster one all the same. The errors of the steps add up, and a scheme of second order
//! takes many: that of a run falls with the power 2/3 of the tolerance. The picture has a crank whose pin is a
//! bushing of 10⁹ N/m, undamped above and with 10⁵ N·s/m below, and `tests/benches/README.md` the numbers. Where a
//! vibration is not damped and the tolerance sees it, explicit schemes are faster.
//!
//! # Where they fail
//! The matrix is made symmetric. A stiff force whose derivative is not symmetric (a follower, a controller
//! that measures one body and pushes another) makes Newton's method slow, and steps short.
//! Vibrations that the tolerance sees are followed with short steps, as explicit schemes do, until they have
//! died away.
//!
//! # Example
//! ```
//! use mbs_runtime::{Adaptive, implicit, mechanism};
//!
//! mechanism! {
//!     /// A weight that sinks in grease.
//!     pub Sinking {
//!         dof = 1;
//!         gravity = (0, -9.81) [m/s^2];
//!         body weight (y) { mass = 1 [kg]; }
//!         force grease on y = -1e6 [N*s/m]*der(y);
//!         start { y = 0; }
//!     }
//! }
//!
//! let mut run = Adaptive::builder(Sinking::declared()).scheme::<implicit::Esdirk4>().build()?;
//! run.advance_to(1.0)?;
//! assert!((run.state().v.y + 9.81e-6).abs() < 1e-9);
//! // an explicit method would need 300 000 steps
//! assert!(run.effort().steps < 100);
//! # Ok::<(), mbs_runtime::Error>(())
//! ```
#![doc = include_str!("implicit.svg")]

use mbs_interface::{Estimate, Implicit, Interpolant, Row};

use crate::adaptive::{AdaptiveScheme, Moment, Sealed};
use crate::explicit::Slopes;
use crate::vectors::assign;
use crate::{Dynamics, Heun, Real, vectors};

/// A visitor of the type of an implicit scheme, for [`with_type`].
pub trait Visitor {
    /// The result of a visit.
    type Result;

    /// Visits the scheme `S`.
    fn visit<S: AdaptiveScheme>(self) -> Self::Result;
}

/// The types of schemes.
macro_rules! schemes {
    ($($(#[$doc:meta])* $name:ident = $scheme:path;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $name {}

        impl Sealed for $name {}

        impl AdaptiveScheme for $name {
            const WORD: &'static str = $scheme.word;
            const ESTIMATE: Option<Estimate> = Some($scheme.estimate);
            const INTERPOLANT: Option<&'static Interpolant> = None;

            type Explicit = Heun;
            type Slopes<X: Clone + Send> = [X; $scheme.stage_count() + 1];

            fn slopes<X: Clone + Send>(x: X) -> Self::Slopes<X> {
                core::array::from_fn(|_| x.clone())
            }

            type Between<X: Clone + Send> = [X; 0];

            fn between<X: Clone + Send>(_: X) -> Self::Between<X> {
                []
            }

            fn advance<D: Dynamics>(
                of: (&D, &D::Inputs),
                from: &Moment<D::Real, D::States>,
                slopes: Slopes<'_, D::States>,
                there: &mut D::States,
                to: &mut Moment<D::Real, D::States>,
            ) -> Option<D::Real> {
                stages(&$scheme, of, from, slopes, there, to)
            }

            fn finish<D: Dynamics>(
                of: (&D, &D::Inputs),
                h: D::Real,
                accelerations: &[D::States],
                there: &mut D::States,
                to: &mut Moment<D::Real, D::States>,
            ) -> Option<D::Real> {
                assign(&mut to.a, accelerations.get($scheme.stages.len())?);
                Some(relax(&$scheme, of, h, there, to))
            }

            const RELAXES: bool = true;

            fn relax<D: Dynamics>(
                of: (&D, &D::Inputs),
                h: D::Real,
                there: &mut D::States,
                state: &mut Moment<D::Real, D::States>,
            ) -> D::Real {
                relax(&$scheme, of, h, there, state)
            }

            fn begin<D: Dynamics>(
                of: (&D, &D::Inputs),
                h: Option<D::Real>,
                there: &mut D::States,
                now: &mut Moment<D::Real, D::States>,
            ) -> D::Real {
                begin(&$scheme, of, h, there, now)
            }
        })*

        /// Calls the visitor with the type of a scheme that was chosen at run time. `None` if no type is it.
        ///
        /// # Example
        /// The steps of a scheme that is known as a value only:
        /// ```
        /// # use mbs_runtime::{Adaptive, AdaptiveScheme, Error, implicit, mechanism};
        /// # mechanism! {
        /// #     pub Sinking {
        /// #         dof = 1;
        /// #         gravity = (0, -9.81) [m/s^2];
        /// #         body weight (y) { mass = 1 [kg]; }
        /// #         force grease on y = -1e6 [N*s/m]*der(y);
        /// #     }
        /// # }
        /// struct Steps;
        /// impl implicit::Visitor for Steps {
        ///     type Result = Result<u64, Error>;
        ///     fn visit<S: AdaptiveScheme>(self) -> Self::Result {
        ///         let mut run = Adaptive::builder(Sinking::declared()).scheme::<S>().build()?;
        ///         run.advance_to(1.0)?;
        ///         Ok(run.effort().steps)
        ///     }
        /// }
        /// let steps = implicit::with_type(&mbs_runtime::ESDIRK4, Steps).expect("it has a type")?;
        /// assert!(steps < 100);
        /// # Ok::<(), Error>(())
        /// ```
        pub fn with_type<V: Visitor>(scheme: &Implicit, visitor: V) -> Option<V::Result> {
            match scheme.word {
                $(word if word == $scheme.word => Some(visitor.visit::<$name>()),)*
                _ => None,
            }
        }
    };
}

mbs_interface::implicit_schemes!(schemes);

/// The stages of a step, the last of which is its end. Behind the slopes of the stages, the last corrections of
/// Newton's method are added up.
fn stages<D: Dynamics>(
    scheme: &Implicit,
    (dynamics, inputs): (&D, &D::Inputs),
    from: &Moment<D::Real, D::States>,
    Slopes { velocities, accelerations }: Slopes<'_, D::States>,
    there: &mut D::States,
    to: &mut Moment<D::Real, D::States>,
) -> Option<D::Real> {
    let h = to.t - from.t;
    let own = D::Real::from_f64(scheme.own) * h;
    let (velocities, [of_v]) = velocities.split_at_mut_checked(scheme.stage_count())? else { return None };
    let (accelerations, [of_a]) = accelerations.split_at_mut_checked(scheme.stage_count())? else {
        return None;
    };
    assign(velocities.first_mut()?, &from.v);
    assign(accelerations.first_mut()?, &from.a);
    for rest in [&mut *of_v, of_a] {
        vectors::fill(rest.as_mut(), D::Real::default());
    }
    let mut growth = D::Real::default();
    for (before, row) in scheme.stages.iter().enumerate() {
        let (slopes, [v, ..]) = velocities.split_at_mut_checked(before + 1)? else { return None };
        let (rates, [a, ..]) = accelerations.split_at_mut_checked(before + 1)? else { return None };
        let t = stage_time(scheme, row, [from.t, h, to.t]);
        // the correction of the acceleration, and the acceleration that is corrected
        let correction = &mut to.a;
        assign(a, rates.last()?);
        lead(row, h, &from.v, rates, v);
        vectors::add_scaled(v.as_mut(), own, a.as_ref());
        lead(row, h, &from.q, slopes, there);
        vectors::add_scaled(there.as_mut(), own, v.as_ref());
        for _ in 0..scheme.iterations {
            assign(correction, a);
            growth = growth + dynamics.implicit(t, [&*there, &*v], inputs, (own, &*correction), a);
            vectors::zip_map(correction.as_mut(), a.as_ref(), |before, after| after - before);
            vectors::add_scaled(v.as_mut(), own, correction.as_ref());
            vectors::add_scaled(there.as_mut(), own * own, correction.as_ref());
        }
        let one = D::Real::from_f64(1.0);
        vectors::add_scaled(of_a.as_mut(), one, correction.as_ref());
        vectors::add_scaled(of_v.as_mut(), own, correction.as_ref());
    }
    assign(&mut to.q, there);
    assign(&mut to.v, velocities.last()?);
    Some(growth)
}

/// A step of Newton's method for a state that was projected or interpolated. Its error, which the tolerance allows, is a
/// stiff force times as large as the stiffness. The state moves by less than that error to where the force is the one
/// that the acceleration asks for. An acceleration that obeys the constraints in this state takes the place of the
/// given one first, so that the state moves along them.
fn relax<D: Dynamics>(
    scheme: &Implicit,
    (dynamics, inputs): (&D, &D::Inputs),
    h: D::Real,
    there: &mut D::States,
    Moment { t, q, v, a }: &mut Moment<D::Real, D::States>,
) -> D::Real {
    let own = D::Real::from_f64(scheme.own) * h;
    let mut growth = D::Real::default();
    for _ in 0..2 {
        assign(there, a);
        growth = growth + dynamics.implicit(*t, [&*q, &*v], inputs, (own, &*there), a);
    }
    vectors::zip_map(there.as_mut(), a.as_ref(), |before, after| after - before);
    vectors::add_scaled(v.as_mut(), own, there.as_ref());
    vectors::add_scaled(q.as_mut(), own * own, there.as_ref());
    growth
}

/// x = x₀ + (share · h) Σ w k
fn lead<T: Real, V: AsRef<[T]> + AsMut<[T]>>(row: &Row, h: T, from: &V, slopes: &[V], to: &mut V) {
    assign(to, from);
    let step = T::from_f64(row.share) * h;
    for (of, weight) in row.terms() {
        if let Some(slope) = slopes.get(of) {
            vectors::add_scaled(to.as_mut(), T::from_f64(weight) * step, slope.as_ref());
        }
    }
}

fn stage_time<T: Real>(scheme: &Implicit, row: &Row, [t, h, t_next]: [T; 3]) -> T {
    let node = scheme.node(row);
    if node == 1.0 { t_next } else { t + T::from_f64(node) * h }
}

/// The acceleration of an explicit method where there is none from before. Else a stage at the moment itself,
/// twice: what changed acts on what is slow, and what is too fast for the step keeps the acceleration that it had,
/// in which an explicit one would magnify the error of a position by the stiffness.
fn begin<D: Dynamics>(
    scheme: &Implicit,
    (dynamics, inputs): (&D, &D::Inputs),
    h: Option<D::Real>,
    there: &mut D::States,
    Moment { t, q, v, a }: &mut Moment<D::Real, D::States>,
) -> D::Real {
    let Some(h) = h else { return dynamics.free_acceleration(*t, q, v, inputs, a) };
    let own = D::Real::from_f64(scheme.own) * h;
    let mut growth = D::Real::default();
    for _ in 0..2 {
        assign(there, a);
        growth = growth + dynamics.implicit(*t, [q, v], inputs, (own, there), a);
    }
    growth
}
