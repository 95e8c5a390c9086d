//! A guess made consistent by moving some of its coordinates.

use super::assembly::{Iterate, newton};
use super::consistency::check_projected;
use super::jacobian::Jacobian;
use crate::diagnosis::check_finite;
use crate::equations::{At, Equations};
use crate::room::Room;
use crate::{Error, Info, Real, vectors};

/// Makes (q, v) the nearest consistent state that keeps the coordinates called `positions`
/// and the velocities of those called `velocities`; see
/// [`start::project`](crate::start::project).
///
/// Derivatives of positions and velocities are made consistent as they are themselves: they
/// change least where they are not kept, so that the constraints keep their derivatives too.
///
/// # Errors
/// [`Error::NoCoordinate`], [`Error::NonFinite`], [`Error::NotAssembled`],
/// [`Error::Inconsistent`]; q and v are left where the iteration was.
pub fn project<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &mut [T],
    v: &mut [T],
    [positions, velocities]: [&[&'static str]; 2],
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    let [of_positions, of_velocities, delta, next, slope, direction, moved, unit] = &mut room.coordinates;
    let [phi, residual, rest, image, entries, phi_t] = &mut room.constraints;
    free(equations.info(), positions, of_positions)?;
    free(equations.info(), velocities, of_velocities)?;
    check_finite(equations.info(), At { t, q, v })?;
    let mobility = &mut *delta;
    find_mobility(equations, t, q, unit, mobility);
    vectors::zip_map(of_positions, mobility, |free, mobility| mobility * free);
    vectors::zip_map(of_velocities, mobility, |free, mobility| mobility * free);

    let mut search = Search { slope, direction, moved, rest, image, entries };
    newton(equations, t, q, Iterate { delta, next, phi, residual }, |q, residual, delta| {
        let mut jacobian = Jacobian::new(equations, t, q, unit, phi_t);
        search.least(&mut jacobian, of_positions, residual, delta);
        Ok(())
    })?;
    if T::PARTIALS > 0 {
        equations.phi(t, q, residual);
        let mut jacobian = Jacobian::new(equations, t, q, unit, phi_t);
        search.find_partials(&mut jacobian, of_positions, residual, phi, [delta, next]);
        vectors::add(q, next);
    }
    let mut jacobian = Jacobian::new(equations, t, q, unit, phi_t);
    // two refinements, because one solution is as good as its rounding
    for _ in 0..3 {
        equations.phi_dot(At { t, q, v }, residual);
        vectors::negate(residual);
        search.least(&mut jacobian, of_velocities, residual, delta);
        vectors::add(v, delta);
    }
    if T::PARTIALS > 0 {
        equations.phi_dot(At { t, q, v }, residual);
        search.find_partials(&mut jacobian, of_velocities, residual, phi, [delta, next]);
        vectors::add(v, next);
    }
    check_projected(equations, At { t, q, v }, room)
}

/// 0 for coordinates to keep, 1 for the others.
fn free<T: Real>(info: &Info, keep: &[&'static str], free: &mut [T]) -> Result<(), Error> {
    vectors::fill(free, T::from_f64(1.0));
    for &name in keep {
        let mut names = info.coordinates.iter().map(|coordinate| coordinate.name);
        let at = names.position(|other| other == name).ok_or(Error::NoCoordinate { name })?;
        vectors::set(free, at, T::default());
    }
    Ok(())
}

/// 1/√mⱼ, with mⱼ = 2T for q̇ⱼ = 1.
fn find_mobility<T: Real>(equations: &dyn Equations<T>, t: T, q: &[T], unit: &mut [T], mobility: &mut [T]) {
    let (zero, one) = (T::default(), T::from_f64(1.0));
    vectors::fill(unit, zero);
    for (j, mobility) in mobility.iter_mut().enumerate() {
        vectors::set(unit, j, one);
        let mass = T::from_f64(2.0) * equations.kinetic_energy(At { t, q, v: unit });
        vectors::set(unit, j, zero);
        *mobility = if mass > zero { one / mass.sqrt() } else { zero };
    }
    let lightest = vectors::largest(mobility).1;
    let of_massless = if lightest > zero { lightest } else { one };
    vectors::map(mobility, |mobility| if mobility > zero { mobility } else { of_massless });
}

/// The vectors of the search for a least correction: conjugate gradients of
/// ‖residual − Φ_q W y‖², Δ = W y, with the mobilities W.
struct Search<'a, T> {
    /// W Φ_qᵀ (residual − Φ_q W y)
    slope: &'a mut [T],
    /// The direction in which y is changed.
    direction: &'a mut [T],
    /// W times the direction.
    moved: &'a mut [T],
    /// residual − Φ_q W y
    rest: &'a mut [T],
    /// Φ_q W times the direction.
    image: &'a mut [T],
    /// A column of Φ_q.
    entries: &'a mut [T],
}

impl<T: Real> Search<'_, T> {
    /// The Δ of Φ_q Δ = `residual` for which Σ (Δⱼ/wⱼ)² is least, with the mobilities w; 0
    /// where they are 0. Without derivatives: those of an iteration are not those of what it
    /// converges to.
    fn least(&mut self, jacobian: &mut Jacobian<'_, T>, mobility: &[T], residual: &[T], delta: &mut [T]) {
        let y = delta;
        vectors::fill(y, T::default());
        vectors::copy(self.rest, residual);
        self.find_slope(jacobian, mobility);
        vectors::copy(self.direction, self.slope);
        let small = T::EPSILON * vectors::norm(residual);
        for _ in 0..2 * y.len() {
            let steepness = vectors::dot(self.slope, self.slope);
            vectors::copy(self.moved, self.direction);
            vectors::zip_map(self.moved, mobility, |d, w| d * w);
            jacobian.along(self.moved, self.image);
            let length = steepness / vectors::dot(self.image, self.image);
            if !length.is_finite() {
                break;
            }
            vectors::add_scaled(y, length, self.direction);
            vectors::zip_map(self.rest, self.image, |rest, d| rest - length * d);
            if vectors::norm(self.rest) <= small {
                break;
            }
            self.find_slope(jacobian, mobility);
            let turn = vectors::dot(self.slope, self.slope) / steepness;
            vectors::zip_map(self.direction, self.slope, |d, slope| slope + turn * d);
        }
        vectors::zip_map(y, mobility, |y, w| (y * w).without_partials());
    }

    /// The least change of the first derivatives, as the derivatives of `found`, that makes those
    /// of a `violation` vanish whose value is 0. `residual` and `delta` are room.
    fn find_partials(
        &mut self,
        jacobian: &mut Jacobian<'_, T>,
        mobility: &[T],
        violation: &[T],
        residual: &mut [T],
        [delta, found]: [&mut [T]; 2],
    ) {
        vectors::fill(found, T::default());
        for index in 0..T::PARTIALS {
            vectors::zip_map(residual, violation, |_, violation| T::from_f64(-violation.partial(index)));
            self.least(jacobian, mobility, residual, delta);
            vectors::zip_map(found, delta, |found, delta| found.plus_partial(index, delta.to_f64()));
        }
    }

    fn find_slope(&mut self, jacobian: &mut Jacobian<'_, T>, mobility: &[T]) {
        vectors::copy(self.slope, mobility);
        for (j, slope) in self.slope.iter_mut().enumerate() {
            if *slope != T::default() {
                jacobian.column(j, self.entries);
                *slope = *slope * vectors::dot(self.entries, self.rest);
            }
        }
    }
}
