//! Mechanisms whose parameters can be changed.

use mbs_runtime::equations::Described;
use mbs_runtime::{Components, Error, Mechanism};

/// A mechanism whose parameters can be changed: what sensitivities are taken of.
///
/// [`of_type`] makes one of a type. Every function from parameters to a mechanism is one, such as
/// `|p: &[f64]| live.with_parameters(|parameters| parameters.copy_from_slice(p))` of a text.
pub trait Family {
    /// Shows the mechanism that has these parameters, in SI units in the order of
    /// [`Info::parameters`](mbs_runtime::Info::parameters).
    ///
    /// # Errors
    /// Parameters that the mechanism refuses.
    fn with(&self, parameters: &[f64], look: &mut dyn FnMut(&dyn Described<f64>)) -> Result<(), Error>;
}

impl<D: Described<f64>, F: Fn(&[f64]) -> Result<D, Error>> Family for F {
    fn with(&self, parameters: &[f64], look: &mut dyn FnMut(&dyn Described<f64>)) -> Result<(), Error> {
        look(&self(parameters)?);
        Ok(())
    }
}

/// The mechanisms of a type.
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
        look: &mut dyn FnMut(&dyn Described<f64>),
    ) -> Result<(), Error> {
        let mut parameters = self.parameters.to_vec();
        parameters.iter_mut().skip(parameter).take(1).for_each(|value| *value += change);
        self.family.with(&parameters, look)
    }
}
