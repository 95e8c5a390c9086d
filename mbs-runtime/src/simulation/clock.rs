//! Time as a number of steps.

use crate::{Error, Real};

/// How many steps of `step` seconds, after those that are taken, lead to less than half a
/// step before or behind `end` seconds.
///
/// # Errors
/// [`Error::EndTime`] if that is past, [`Error::Time`] if it is so far away that time would
/// stand still before.
pub fn steps_to<T: Real>(start: f64, step: f64, taken: u64, end: f64) -> Result<u64, Error> {
    let span = (end - start) / step;
    // Half a step back is still "now".
    if !span.is_finite() || span + 0.5 < taken as f64 {
        return Err(Error::EndTime { end, now: start + taken as f64 * step });
    }
    check_time::<T>(end, step)?;
    Ok(((span + 0.5) as u64).saturating_sub(taken))
}

/// At the size of a time in the scalar a step has to be four roundings at least.
pub fn check_time<T: Real>(t: f64, step: f64) -> Result<(), Error> {
    let is_counted = 4.0 * T::EPSILON.to_f64() * t.abs() <= step;
    if is_counted { Ok(()) } else { Err(Error::Time { t, step }) }
}
