//! Methods of integration as types: a scheme, and what keeps the constraints with it.

use core::fmt::Debug;
use core::marker::PhantomData;

use mbs_schemes::{Explicit, HEUN, RK4, Tableau};

mod sealed {
    pub trait Sealed {}
    impl<S> Sealed for super::Held<S> {}
    impl<S> Sealed for super::PerStage<S> {}
}

/// An explicit Runge–Kutta scheme: [`Heun`] or [`Rk4`].
pub trait Scheme: sealed::Sealed + Copy + Debug + Send + Sync + 'static {
    /// Its coefficients.
    const TABLEAU: &'static Tableau;

    /// One of something for each stage.
    #[doc(hidden)]
    type Stages<X: Copy>: Copy + AsRef<[X]> + AsMut<[X]>;

    /// The same for all stages.
    #[doc(hidden)]
    fn stages<X: Copy>(x: X) -> Self::Stages<X>;
}

/// The types of schemes.
macro_rules! schemes {
    ($($(#[$doc:meta])* $name:ident = $tableau:ident;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $name {}

        impl sealed::Sealed for $name {}

        impl Scheme for $name {
            const TABLEAU: &'static Tableau = &$tableau;
            type Stages<X: Copy> = [X; $tableau.stage_count()];

            #[inline(always)]
            fn stages<X: Copy>(x: X) -> Self::Stages<X> {
                [x; $tableau.stage_count()]
            }
        })*

        /// What is to be done with the type of a method that was chosen at run time; nothing
        /// where no type has its scheme.
        pub fn with_type<V: MethodVisitor>(method: Explicit, visitor: V) -> Option<V::Result> {
            let Explicit { tableau, is_held } = method;
            $(if $tableau.is(tableau) {
                return Some(if is_held {
                    visitor.visit::<Held<$name>>()
                } else {
                    visitor.visit::<PerStage<$name>>()
                });
            })*
            None
        }
    };
}

schemes! {
    /// Heun's method: second order, two evaluations of the right-hand side per step. The
    /// scheme of a mechanism that declares none.
    Heun = HEUN;
    /// The classical Runge–Kutta method: fourth order, four evaluations per step.
    Rk4 = RK4;
}

/// A method of integration: a [`Scheme`] with Baumgarte's feedback of the constraint
/// violation, [`Held`] over a step or [`PerStage`].
pub trait Method: sealed::Sealed + Copy + Debug + Send + Sync + 'static {
    /// The scheme.
    type Scheme: Scheme;
    /// The method as a value.
    const EXPLICIT: Explicit;
}

/// What [`with_type`] does with the type of a method.
pub trait MethodVisitor {
    /// What comes of it.
    type Result;

    /// Does it with the method `X`.
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
/// acceleration is off by O(1): positions stay second order, with [`Rk4`] too, and
/// multipliers taken with these terms are wrong however small ‖Φ‖ looks. With gains that do
/// not grow as the step becomes smaller, the scheme keeps its order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerStage<S = Heun>(PhantomData<S>);

impl<S: Scheme> Method for Held<S> {
    type Scheme = S;
    const EXPLICIT: Explicit = Explicit { tableau: S::TABLEAU, is_held: true };
}

impl<S: Scheme> Method for PerStage<S> {
    type Scheme = S;
    const EXPLICIT: Explicit = Explicit { tableau: S::TABLEAU, is_held: false };
}
