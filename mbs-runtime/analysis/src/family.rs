//! Mechanisms whose parameters can be changed.

use mbs_runtime::equations::Equations;
use mbs_runtime::{Components, Error, Mechanism};

/// A mechanism whose parameters can be changed: what sensitivities are taken of.
///
/// [`of_type`] makes one of a type. Every function from parameters to a mechanism is one.
///
/// # Example
/// ```
/// use mbs_analysis::Family;
/// use mbs_live::Text;
/// use mbs_runtime::equations::At;
///
/// let text = "Block { dof = 1; param m = 2 [kg]; body block (x) { mass = m; } }";
/// let live = Text::declaration("block.mbs", text).compile()?;
/// let family = |values: &[f64]| live.with_parameters(|own| own.copy_from_slice(values));
/// let mut energy = 0.0;
/// family.with(&[5.0], &mut |block| energy = block.kinetic_energy(At { t: 0.0, q: &[0.0], v: &[2.0] }))?;
/// assert_eq!(energy, 10.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Family {
    /// Shows the mechanism that has these parameters, in SI units in the order of
    /// [`Info::parameters`](mbs_runtime::Info::parameters).
    ///
    /// # Errors
    /// Parameters that the mechanism refuses.
    fn with(&self, parameters: &[f64], look: &mut dyn FnMut(&dyn Equations<f64>)) -> Result<(), Error>;
}

impl<D: Equations<f64>, F: Fn(&[f64]) -> Result<D, Error>> Family for F {
    fn with(&self, parameters: &[f64], look: &mut dyn FnMut(&dyn Equations<f64>)) -> Result<(), Error> {
        look(&self(parameters)?);
        Ok(())
    }
}

/// The mechanisms of a type, by their parameters in SI units.
///
/// # Example
/// ```
/// use mbs_analysis::{Family, of_type};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     pub Block {
///         dof = 1;
///         param m = 2 [kg] where m > 0;
///         body block (x) { mass = m; }
///     }
/// }
///
/// let family = of_type::<Block>();
/// let mut masses = [0.0];
/// family.with(&[5.0], &mut |block| block.parameters(&mut masses))?;
/// assert_eq!(masses, [5.0]);
/// assert!(family.with(&[-5.0], &mut |_| ()).is_err());
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
pub fn of_type<M: Mechanism<Real = f64>>() -> impl Fn(&[f64]) -> Result<M, Error> {
    |parameters: &[f64]| M::new(components(parameters))
}

/// Components from as many numbers.
pub fn components<C: Components>(values: &[C::Real]) -> C {
    let mut array = C::splat(C::Real::default()).into_array();
    array.as_mut().iter_mut().zip(values).for_each(|(component, value)| *component = *value);
    C::from_array(array)
}

/// A mechanism of a family.
#[derive(Clone, Copy)]
pub struct Varied<'a> {
    /// The family.
    pub family: &'a dyn Family,
    /// The parameters of this one.
    pub parameters: &'a [f64],
}

impl Varied<'_> {
    /// Shows the mechanism that has one parameter changed.
    pub fn moved(
        &self,
        parameter: usize,
        change: f64,
        look: &mut dyn FnMut(&dyn Equations<f64>),
    ) -> Result<(), Error> {
        let mut parameters = self.parameters.to_vec();
        parameters.iter_mut().skip(parameter).take(1).for_each(|value| *value += change);
        self.family.with(&parameters, look)
    }
}
