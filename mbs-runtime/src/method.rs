//! Methods of integration as types: a scheme, and what keeps the constraints with it.
//!
//! A method is a type, so that each becomes a straight line of its own. The types of schemes are those of the
//! tables of `mbs-interface`.

use core::fmt::Debug;
use core::marker::PhantomData;

use mbs_interface::{Explicit, Stabilization, Tableau};

mod sealed {
    pub trait Sealed {}
    impl<S> Sealed for super::Held<S> {}
    impl<S> Sealed for super::PerStage<S> {}
    impl<S> Sealed for super::Projected<S> {}
}

/// An explicit Runge–Kutta scheme, such as [`Heun`] or [`Dopri5`].
pub trait Scheme: sealed::Sealed + Copy + Debug + Send + Sync + 'static {
    /// Its coefficients.
    const TABLEAU: &'static Tableau;

    /// One of something for each stage.
    #[doc(hidden)]
    type Stages<X: Clone + Send>: Clone + Send + AsRef<[X]> + AsMut<[X]>;

    /// The same for all stages.
    #[doc(hidden)]
    fn stages<X: Clone + Send>(x: X) -> Self::Stages<X>;

    /// One of something for each slope and each term of an interpolant, none without one.
    #[doc(hidden)]
    type Between<X: Clone + Send>: Clone + Send + AsRef<[X]> + AsMut<[X]>;

    /// The same for all of them.
    #[doc(hidden)]
    fn between<X: Clone + Send>(x: X) -> Self::Between<X>;
}

/// The types of schemes.
macro_rules! schemes {
    ($($(#[$doc:meta])* $name:ident = $tableau:path;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $name {}

        impl sealed::Sealed for $name {}

        impl Scheme for $name {
            const TABLEAU: &'static Tableau = &$tableau;
            type Stages<X: Clone + Send> = [X; $tableau.stage_count()];

            #[inline(always)]
            fn stages<X: Clone + Send>(x: X) -> Self::Stages<X> {
                core::array::from_fn(|_| x.clone())
            }

            type Between<X: Clone + Send> = [X; $tableau.interpolated()];

            fn between<X: Clone + Send>(x: X) -> Self::Between<X> {
                core::array::from_fn(|_| x.clone())
            }
        })*

        /// Calls the visitor with the type of a method that was chosen at run time. `None` if
        /// no type has its scheme.
        ///
        /// # Example
        /// The energy that a run loses by a method chosen at run time:
        /// ```
        /// # use mbs_runtime::{Error, Explicit, Method, MethodVisitor, Simulation, mechanism};
        /// # mechanism! {
        /// #     pub Pendulum {
        /// #         dof = 1;
        /// #         param length = 1 [m];
        /// #         gravity = (0, -9.81) [m/s^2];
        /// #         body bob (x, y) { mass = 2 [kg]; }
        /// #         constraint rod: x^2 + y^2 = length^2;
        /// #         start { x = length; guess y = 0; }
        /// #     }
        /// # }
        /// struct Lost;
        /// impl MethodVisitor for Lost {
        ///     type Result = Result<f64, Error>;
        ///     fn visit<X: Method>(self) -> Self::Result {
        ///         let mut swing = Simulation::builder(Pendulum::declared(), 1e-3).method::<X>().build()?;
        ///         swing.advance_to(1.0)?;
        ///         Ok(swing.energy())
        ///     }
        /// }
        /// let method = Explicit::held(&mbs_runtime::RK4);
        /// let lost = mbs_runtime::with_type(method, Lost).expect("every scheme has a type")?;
        /// assert!(lost.abs() < 1e-9);
        /// # Ok::<(), Error>(())
        /// ```
        pub fn with_type<V: MethodVisitor>(method: Explicit, visitor: V) -> Option<V::Result> {
            let Explicit { tableau, stabilization } = method;
            $(if $tableau.is(tableau) {
                return Some(match stabilization {
                    Stabilization::Held => visitor.visit::<Held<$name>>(),
                    Stabilization::PerStage => visitor.visit::<PerStage<$name>>(),
                    Stabilization::Projection => visitor.visit::<Projected<$name>>(),
                });
            })*
            None
        }
    };
}

mbs_interface::explicit_schemes!(schemes);

/// A method of integration: a [`Scheme`] with what keeps the constraints. That is Baumgarte's
/// feedback of their violation, [`Held`] over a step or [`PerStage`], or a projection
/// ([`Projected`]).
pub trait Method: sealed::Sealed + Copy + Debug + Send + Sync + 'static {
    /// The scheme.
    type Scheme: Scheme;
    /// The method as a value.
    const EXPLICIT: Explicit;
}

/// A visitor of the type of a method, for [`with_type`].
pub trait MethodVisitor {
    /// The result of a visit.
    type Result;

    /// Visits the method `X`.
    fn visit<X: Method>(self) -> Self::Result;
}

/// Feedback evaluated once, at the start of the step, and held over it. The default: it
/// leaves the later stages free of the error of the position that they stand at, so that
/// accelerations and multipliers keep the order of the scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held<S = Heun>(PhantomData<S>);

/// Feedback evaluated in each stage, as Eq. (8) of the paper has it for Heun's method.
///
/// A stage stands O(h²) beside the constraints, which is fed back with β² ~ 1/h², so its
/// acceleration is off by O(1): positions are of second order, with [`Rk4`] too, velocities of first, and
/// multipliers taken with these terms are wrong however small ‖Φ‖ looks. With gains that do
/// not grow as the step becomes smaller, the scheme keeps its order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerStage<S = Heun>(PhantomData<S>);

/// No feedback: the state at the end of each step is projected onto the constraints, first its
/// positions and then its velocities,
///
/// ```text
/// ⎡ M   Φ_qᵀ ⎤ ⎡ Δ ⎤   ⎡ 0      ⎤              ⎡ M   Φ_qᵀ ⎤ ⎡ Δ ⎤   ⎡ 0      ⎤
/// ⎣ Φ_q  0   ⎦ ⎣ μ ⎦ = ⎣ Φ(q)   ⎦,  q ← q − Δ   ⎣ Φ_q  0   ⎦ ⎣ μ ⎦ = ⎣ Φ̇(q, v) ⎦,  v ← v − Δ
/// ```
///
/// each by one step of Newton's method, whose correction is the smallest in the norm of the mass
/// matrix. The scheme keeps its order, accelerations and multipliers are free of corrections, and
/// the step may change its length. It takes about one and a half evaluations more per step.
///
/// # Source
/// E. Eich, Convergence results for a coordinate projection method applied to mechanical systems
/// with algebraic constraints, SIAM J. Numer. Anal. 30 (1993) 1467-1482.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected<S = Heun>(PhantomData<S>);

impl<S: Scheme> Method for Held<S> {
    type Scheme = S;
    const EXPLICIT: Explicit = Explicit::held(S::TABLEAU);
}

impl<S: Scheme> Method for PerStage<S> {
    type Scheme = S;
    const EXPLICIT: Explicit = Explicit::per_stage(S::TABLEAU);
}

impl<S: Scheme> Method for Projected<S> {
    type Scheme = S;
    const EXPLICIT: Explicit = Explicit::projected(S::TABLEAU);
}
