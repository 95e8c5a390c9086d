//! The interface that generated code calls. Not part of the public interface.

#[cfg(feature = "macro")]
pub use nalgebra;

pub use crate::corners::next_corner;
pub use crate::spline::{Segment, Spline};
use crate::{Components, Error, Pair, Real, Single};

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

/// The values at these places of an array; see [`read`].
#[inline]
pub fn gather<T: Real, const N: usize>(values: &[T], places: &[u32; N]) -> [T; N] {
    places.map(|place| read(values, place as usize))
}

/// Copies values from places of an array to places of another; see [`read`].
#[inline]
pub fn copy<T: Real>(from: &[T], to: &mut [T], places: &[[u32; 2]]) {
    for &[here, there] in places {
        write(to, there as usize, read(from, here as usize));
    }
}

/// Adds values from places of an array to places of another; see [`read`].
#[inline]
pub fn add<T: Real>(from: &[T], to: &mut [T], places: &[[u32; 2]]) {
    for &[here, there] in places {
        let there = there as usize;
        write(to, there, read(to, there) + read(from, here as usize));
    }
}

/// Returns the values of a function at all places of an array.
///
/// `core::array::from_fn` is a function that is called if the array is long. In a loop over lanes
/// no function may be called, or there are no vectors.
#[inline(always)]
pub fn each<T: Real, const N: usize>(mut value: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [T::ZERO; N];
    for (at, one) in all.iter_mut().enumerate() {
        *one = value(at);
    }
    all
}

/// x and y in turn as points.
pub fn pairs<T: Real, const N: usize>(values: &[T]) -> [[T; 2]; N] {
    core::array::from_fn(|at| [read(values, 2 * at), read(values, 2 * at + 1)])
}

/// Sines and cosines of `count` angles, two at once.
#[inline(always)]
pub fn sin_cos_each<T: Real>(count: usize, angle: impl Fn(usize) -> T, mut keep: impl FnMut(usize, T, T)) {
    let single = |at| <T::Pair as Pair<T>>::Single::new(angle(at));
    for first in (1..count).step_by(2).map(|second| second - 1) {
        let (sines, cosines) = T::Pair::join(single(first), single(first + 1)).sin_cos();
        keep(first, sines.first().get(), cosines.first().get());
        keep(first + 1, sines.second().get(), cosines.second().get());
    }
    if count % 2 == 1 {
        let (sine, cosine) = angle(count - 1).sin_cos();
        keep(count - 1, sine, cosine);
    }
}
