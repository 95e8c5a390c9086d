//! Positions at and behind stops, which analyses of free motions do not know.

use mbs_runtime::equations::{At, Described};

use crate::Error;

/// A gap is closed, and a position behind a stop, by more than this share of the largest coordinate.
const CLOSED: f64 = 1e-9;

/// The gaps of a position, and the size of what counts.
fn gaps(mechanism: &dyn Described<f64>, t: f64, q: &[f64]) -> (Vec<f64>, f64) {
    let still = vec![0.0; q.len()];
    let mut gaps = vec![0.0; 3 * mechanism.info().stops.len()];
    mechanism.gaps(At { t, q, v: &still }, &still, &mut gaps);
    let size = q.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    // each has its rate and its second derivative behind it
    (gaps.into_iter().step_by(3).collect(), CLOSED * size)
}

/// Refuses a position behind a stop.
pub fn refuse_behind(mechanism: &dyn Described<f64>, t: f64, q: &[f64]) -> Result<(), Error> {
    let (gaps, size) = gaps(mechanism, t, q);
    let stops = mechanism.info().stops;
    match stops.iter().zip(gaps).find(|(_, gap)| *gap < -size) {
        Some((stop, gap)) => Err(mbs_runtime::Error::Behind { t, stop: stop.name, gap }.into()),
        None => Ok(()),
    }
}

/// Refuses a position at a stop, or behind it, for what is about free motions.
pub fn refuse_contact(
    mechanism: &dyn Described<f64>,
    (t, q): (f64, &[f64]),
    what: &'static str,
) -> Result<(), Error> {
    let (gaps, size) = gaps(mechanism, t, q);
    let stops = mechanism.info().stops;
    match stops.iter().zip(gaps).find(|(_, gap)| *gap <= size) {
        Some((stop, _)) => Err(mbs_runtime::Error::Stops { what, stop: stop.name }.into()),
        None => Ok(()),
    }
}
