//! Equations over duals, of a mechanism of which only an object is known.
//!
//! Compiling the equations over duals takes 0.9 s for a type like the slider-crank. So only `Differentiated`
//! does it for a type.

use super::{At, Equations, read};
use crate::{Dual, Error, Gains, Info, Mechanism, Switch};

/// The number of partial derivatives that equations over duals carry at once.
pub const PARTIALS: usize = 4;

/// A number with [`PARTIALS`] partial derivatives.
pub type Partials = Dual<f64, PARTIALS>;

/// A mechanism of `mechanism!` whose equations tools can have over duals, although they know only an object: the
/// derivatives of accelerations, reactions and outputs by positions, velocities, inputs, time and
/// parameters. Its equations are compiled for duals too, which takes about as long as the rest of it. Texts need no such type.
///
/// # Example
/// How the acceleration of a swing from the side changes with its length, and along its path:
/// ```
/// use mbs_runtime::equations::{At, Differentiated, Equations, Partials};
/// use mbs_runtime::mechanism;
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
/// let swing = Differentiated(Pendulum::declared());
/// let object: &dyn Equations<f64> = &swing;
/// assert!(object.is_differentiable());
///
/// let length = Partials::constant(1.0);
/// let still = [Partials::constant(0.0); 2];
/// // along the path x = cos s, y = sin s the acceleration is −g sin s in the one direction and
/// // −g cos s in the other
/// let q = [Partials::constant(1.0), Partials::variable(0.0, 0)];
/// let (mut a, mut multipliers) = ([Partials::default(); 2], [Partials::default()]);
/// object.with_partials(&[length], &mut |equations| {
///     let at = At { t: Partials::default(), q: &q, v: &still };
///     equations.reactions(at, &[], &mut a, &mut multipliers);
/// })?;
/// assert_eq!((a[0].value, a[1].value), (0.0, -9.81));
/// assert!((a[0].partials[0] - 9.81).abs() < 1e-14);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differentiated<M>(pub M);

/// Methods that are those of the mechanism inside.
macro_rules! of_the_mechanism {
    ($($Trait:ident::$name:ident($($argument:ident: $Type:ty),*) $(-> $Result:ty)?;)*) => {$(
        fn $name(&self, $($argument: $Type),*) $(-> $Result)? {
            $Trait::$name(&self.0, $($argument),*)
        }
    )*};
}

impl<M: Mechanism<Real = f64>> Equations<f64> for Differentiated<M> {
    of_the_mechanism! {
        Equations::info() -> &Info;
        Equations::phi(t: f64, q: &[f64], phi: &mut [f64]);
        Equations::phi_dot(at: At<'_, f64>, phi_dot: &mut [f64]);
        Equations::complete(states: At<'_, f64>, q: &mut [f64], v: &mut [f64]);
        Equations::stabilized(states: At<'_, f64>, inputs: &[f64], gains: &Gains<f64>, a: &mut [f64], feedback: &mut [f64]) -> f64;
        Equations::constrained(states: At<'_, f64>, inputs: &[f64], feedback: &[f64], a: &mut [f64]) -> f64;
        Equations::implicit(states: At<'_, f64>, inputs: &[f64], shift: f64, predicted: &[f64], a: &mut [f64]) -> f64;
        Equations::accelerations(at: At<'_, f64>, inputs: &[f64], feedback: &[f64], a: &mut [f64]) -> f64;
        Equations::position_correction(t: f64, q: &[f64], residual: &[f64], correction: &mut [f64]) -> f64;
        Equations::velocity_correction(t: f64, q: &[f64], residual: &[f64], correction: &mut [f64]) -> f64;
        Equations::projection(t: f64, q: &[f64], violation: &[f64], correction: &mut [f64]) -> f64;
        Equations::worst_pivot(t: f64, q: &[f64]) -> Option<(usize, f64)>;
        Equations::worst_start_pivot(t: f64, q: &[f64]) -> Option<(usize, f64)>;
        Equations::next_corner(t: f64, inputs: &[f64]) -> f64;
        Equations::switching() -> &'static [Switch];
        Equations::switches(at: At<'_, f64>, inputs: &[f64], values: &mut [f64]);
        Equations::stop_laws(laws: &mut [f64]);
        Equations::gaps(at: At<'_, f64>, acceleration: &[f64], gaps: &mut [f64]);
        Equations::limits(at: At<'_, f64>, inputs: &[f64], reactions: [&[f64]; 2], limits: &mut [f64]);
        Equations::free_reactions(at: At<'_, f64>, inputs: &[f64], a: &mut [f64], multipliers: &mut [f64]) -> f64;
        Equations::contacts(t: f64, q: &[f64], what: &mut dyn FnMut(&[f64]));
        Equations::clock(clock: usize) -> [f64; 2];
        Equations::transitions(at: At<'_, f64>, inputs: &[f64], reactions: [&[f64]; 2], values: &mut [f64]);
        Equations::sample(at: At<'_, f64>, inputs: &mut [f64], clock: usize);
        Equations::kinetic_energy(at: At<'_, f64>) -> f64;
        Equations::reactions(at: At<'_, f64>, inputs: &[f64], a: &mut [f64], multipliers: &mut [f64]) -> f64;
        Equations::outputs(at: At<'_, f64>, inputs: &[f64], reactions: [&[f64]; 2], outputs: &mut [f64]);
        Equations::events(at: At<'_, f64>, inputs: &[f64], values: &mut [f64]);
        Equations::potential_energy(at: At<'_, f64>) -> f64;
        Equations::points(t: f64, q: &[f64], points: &mut [f64]);
        Equations::parameters(parameters: &mut [f64]);
    }

    fn is_differentiable(&self) -> bool {
        true
    }

    fn with_partials(
        &self,
        parameters: &[Partials],
        what: &mut dyn FnMut(&dyn Equations<Partials>),
    ) -> Result<(), Error> {
        what(&M::Over::<Partials>::new(read(parameters))?);
        Ok(())
    }
}
