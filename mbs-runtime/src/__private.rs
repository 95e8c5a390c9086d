//! What generated code calls. Not part of the public interface.

pub use nalgebra;

pub use crate::spline::{Segment, Spline};
use crate::{Components, Error, Real};

/// Refuses parameters that are not finite.
pub fn check_finite<P: Components>(parameters: &P) -> Result<(), Error> {
    let array = parameters.into_array();
    for (&value, &name) in array.as_ref().iter().zip(P::NAMES) {
        if !value.is_finite() {
            return Err(Error::Parameter { name, value: value.to_f64(), requirement: "it has to be finite" });
        }
    }
    Ok(())
}

/// Position and size of the largest value; one that is not finite is largest.
pub fn worst<T: Real>(values: &[T]) -> Option<(usize, T)> {
    let mut worst: Option<(usize, T)> = None;
    for (at, &value) in values.iter().enumerate() {
        if !value.is_finite() {
            return Some((at, value));
        }
        if worst.is_none_or(|(_, largest)| value > largest) {
            worst = Some((at, value));
        }
    }
    worst
}

/// A value of an array. Generated code reads at places that exist only; should
/// one not, the result is no number, and no panic.
#[inline(always)]
pub fn read<T: Real>(values: &[T], at: usize) -> T {
    values.get(at).copied().unwrap_or_else(|| T::from_f64(f64::NAN))
}

/// Keeps a value in an array, at a place that exists.
#[inline(always)]
pub fn write<T: Real>(values: &mut [T], at: usize, value: T) {
    if let Some(place) = values.get_mut(at) {
        *place = value;
    }
}
