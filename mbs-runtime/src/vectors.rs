//! Vectors as slices. Sums run in the same order wherever they are taken, for named
//! components as for slices of a length known at run time.

use crate::Real;

/// Euclidean norm, √(Σ xᵢ²).
#[inline(always)]
pub(crate) fn norm<T: Real>(x: &[T]) -> T {
    x.iter().fold(T::default(), |sum, &x| sum + x * x).sqrt()
}

/// Σ xᵢ yᵢ
pub(crate) fn dot<T: Real>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::default(), |sum, (&x, &y)| sum + x * y)
}

/// Σ xᵢ, not finite if a component is not, and shorter than a test of each. Four sums,
/// none of which waits for another.
#[inline(always)]
pub(crate) fn sum<T: Real>(x: &[T]) -> T {
    let mut sums = [T::default(); 4];
    for four in x.chunks(4) {
        for (sum, &x) in sums.iter_mut().zip(four) {
            *sum = *sum + x;
        }
    }
    let [a, b, c, d] = sums;
    (a + b) + (c + d)
}

/// Index and magnitude of the component that is largest in magnitude, a NaN counting as
/// larger than everything; (0, 0) of an empty vector.
pub(crate) fn largest<T: Real>(x: &[T]) -> (usize, T) {
    let mut largest = (0, T::default());
    for (at, &x) in x.iter().enumerate() {
        let magnitude = x.abs();
        let is_nan = magnitude.partial_cmp(&magnitude).is_none();
        if is_nan {
            return (at, magnitude);
        }
        if magnitude > largest.1 {
            largest = (at, magnitude);
        }
    }
    largest
}

/// True if every component is finite.
#[inline(always)]
pub(crate) fn is_finite<T: Real>(x: &[T]) -> bool {
    let mut finite = true;
    for x in x {
        finite &= x.is_finite();
    }
    finite
}

/// Index and value of the first component that is not finite.
pub(crate) fn first_non_finite<T: Real>(x: &[T]) -> Option<(usize, T)> {
    let mut components = x.iter().copied().enumerate();
    components.find(|(_, x)| !x.is_finite())
}

/// The magnitude of a component; 0 where there is none.
pub(crate) fn magnitude<T: Real>(x: &[T], at: usize) -> T {
    x.get(at).map_or(T::default(), |x| x.abs())
}

/// The array of the values that a function has for each index. It is compiled once for a length, and not for each function.
pub(crate) fn each<T: Copy + Default, const N: usize>(of: &mut dyn FnMut(usize) -> T) -> [T; N] {
    let mut each = [T::default(); N];
    for (at, to) in each.iter_mut().enumerate() {
        *to = of(at);
    }
    each
}

/// Components without derivatives.
pub(crate) fn numbers<T: Real, const N: usize>(x: &[T; N]) -> [f64; N] {
    let mut numbers = [0.0; N];
    for (to, x) in numbers.iter_mut().zip(x) {
        *to = x.to_f64();
    }
    numbers
}

/// Every component becomes `value`.
pub(crate) fn fill<T: Real>(x: &mut [T], value: T) {
    map(x, |_| value);
}

/// One component becomes `value`, if there is one at that index.
pub(crate) fn set<T: Real>(x: &mut [T], at: usize, value: T) {
    if let Some(x) = x.get_mut(at) {
        *x = value;
    }
}

/// xᵢ becomes yᵢ. No panic where lengths differ: the shorter one ends it.
#[inline(always)]
pub(crate) fn copy<T: Real>(x: &mut [T], y: &[T]) {
    zip_map(x, y, |_, y| y);
}

#[inline(always)]
pub(crate) fn assign<T: Real, V: AsRef<[T]> + AsMut<[T]>>(to: &mut V, from: &V) {
    copy(to.as_mut(), from.as_ref());
}

/// xᵢ becomes xᵢ + yᵢ.
pub(crate) fn add<T: Real>(x: &mut [T], y: &[T]) {
    zip_map(x, y, |x, y| x + y);
}

/// xᵢ becomes xᵢ + `factor` yᵢ.
pub(crate) fn add_scaled<T: Real>(x: &mut [T], factor: T, y: &[T]) {
    zip_map(x, y, |x, y| x + factor * y);
}

/// xᵢ becomes −xᵢ.
pub(crate) fn negate<T: Real>(x: &mut [T]) {
    map(x, |x| -x);
}

/// xᵢ becomes f(xᵢ).
#[inline(always)]
pub(crate) fn map<T: Real>(x: &mut [T], f: impl Fn(T) -> T) {
    for x in x {
        *x = f(*x);
    }
}

/// xᵢ becomes f(xᵢ, yᵢ).
#[inline(always)]
pub(crate) fn zip_map<T: Real>(x: &mut [T], y: &[T], f: impl Fn(T, T) -> T) {
    for (x, &y) in x.iter_mut().zip(y) {
        *x = f(*x, y);
    }
}

/// The components of `M` vectors become what f gives for those of `N` others, place by place. No panic
/// where lengths differ: the shortest vector ends it.
#[inline(always)]
pub(crate) fn zip_into<T: Real, const M: usize, const N: usize>(
    mut results: [&mut [T]; M],
    given: [&[T]; N],
    f: impl Fn([T; N]) -> [T; M],
) {
    let lengths = given.iter().map(|x| x.len()).chain(results.iter().map(|x| x.len()));
    for at in 0..lengths.min().unwrap_or(0) {
        let components = given.map(|x| x.get(at).copied().unwrap_or_default());
        for (x, value) in results.iter_mut().zip(f(components)) {
            set(x, at, value);
        }
    }
}
