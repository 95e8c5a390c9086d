//! The stops that a mechanism rests on, the constraints of modes that hold, and positions off them.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use mbs_runtime::equations::{At, Equations, are_independent};
use mbs_runtime::{DeclaredLock, Info};

use crate::resting::Resting;
use crate::{Error, OperatingPoint};

/// A gap is closed, and a position behind a stop, by more than this share of the largest coordinate, there or at the start.
const CLOSED: f64 = 1e-9;
/// A stop pulls by more than this share of the largest force at stops.
const PULLS: f64 = 1e-9;
/// So many sets of stops are tried.
const MOST_SETS: usize = 256;

/// The values of all contacts at a position, and the size of what counts.
fn contacts(mechanism: &dyn Equations<f64>, t: f64, q: &[f64]) -> (Vec<f64>, f64) {
    let still = vec![0.0; q.len()];
    let mut gaps = vec![0.0; 3 * mechanism.info().contacts()];
    mechanism.gaps(At { t, q, v: &still }, &still, &mut gaps);
    let declared = mechanism.info().coordinates.iter().map(|q| q.default);
    let size = q.iter().copied().chain(declared).fold(0.0_f64, |size, x| size.max(x.abs()));
    // each has its rate and its second derivative behind it
    (gaps.into_iter().step_by(3).collect(), CLOSED * size)
}

/// The gaps of a position, and the size of what counts.
fn gaps(mechanism: &dyn Equations<f64>, t: f64, q: &[f64]) -> (Vec<f64>, f64) {
    let (mut gaps, size) = contacts(mechanism, t, q);
    gaps.truncate(mechanism.info().stops.len());
    (gaps, size)
}

/// The rows of the modes that hold, with their names.
fn locked(info: &Info, inputs: &[f64]) -> impl Iterator<Item = (usize, &'static DeclaredLock)> {
    info.locks().filter(|(_, lock)| inputs.get(lock.mode).is_some_and(|mode| *mode > 0.5))
}

/// The rows of the modes that hold, as far as they are independent of each other and of the constraints at a position.
pub fn held_rows(mechanism: &dyn Equations<f64>, (t, q): (f64, &[f64]), inputs: &[f64]) -> Vec<usize> {
    let mut rows = Vec::new();
    for (row, _) in locked(mechanism.info(), inputs) {
        rows.push(row);
        if !are_independent(mechanism, (t, q), &rows) {
            rows.pop();
        }
    }
    rows
}

/// Refuses a position that is off a constraint of a mode that holds.
///
/// # Errors
/// [`Apart`](mbs_runtime::Error::Apart).
pub fn meets_modes(
    mechanism: &dyn Equations<f64>,
    (t, q): (f64, &[f64]),
    inputs: &[f64],
) -> Result<(), Error> {
    let (values, size) = contacts(mechanism, t, q);
    let off = |row: usize| values.get(row).copied().unwrap_or(0.0);
    // written so that a NaN is off
    let is_met = |row: usize| off(row).abs() <= size;
    match locked(mechanism.info(), inputs).find(|(row, _)| !is_met(*row)) {
        Some((row, lock)) => Err(mbs_runtime::Error::Apart { t, constraint: lock.name, by: off(row) }.into()),
        None => Ok(()),
    }
}

/// A position that was found on a set of stops.
pub struct Found<R> {
    /// The result of the search.
    pub result: R,
    /// Positions.
    pub q: Vec<f64>,
    /// The multipliers of all rows, those of stops last.
    pub multipliers: Vec<f64>,
    /// True if the mechanism falls away from there, so that another set may have a better one.
    pub falls: bool,
}

/// The stops that are rested on, and what is found there: none pulls, and no other gap is negative. `look` looks on a set.
///
/// Sets are tried one after the other, that of the stops which the start touches first. A position behind a stop leads to the
/// set with this stop, a stop that pulls to the set without it. Where that finds nothing, all sets are tried, from the
/// smallest ones on. What falls away is the result if no other set has one that does not. The rows of modes that hold, `held`,
/// are in every set.
///
/// # Errors
/// Those of `look` without stops; [`Behind`](mbs_runtime::Error::Behind), [`Error::Pulls`].
pub fn complementary<R>(
    mechanism: &dyn Equations<f64>,
    (t, from, held): (f64, &[f64], &[usize]),
    mut look: impl FnMut(&dyn Equations<f64>) -> Result<Found<R>, Error>,
) -> Result<(Vec<usize>, R), Error> {
    let count = mechanism.info().stops.len();
    let (mut tried, mut first, mut falling) = (BTreeSet::new(), None, None);
    let (at_start, size) = gaps(mechanism, t, from);
    let mut next = Some((0..count).filter(|stop| at_start[*stop].abs() <= size).collect::<BTreeSet<_>>());
    let mut all = subsets(count, 0..=usize::try_from(mechanism.info().dof).unwrap_or(0));
    while tried.len() < MOST_SETS {
        let Some(set) = next.take().or_else(|| all.find(|set| !tried.contains(set))) else { break };
        tried.insert(set.clone());
        let stops: Vec<usize> = set.iter().copied().collect();
        let rows = [held, &stops].concat();
        let judged = |found| judged(mechanism, t, (&rows, &stops), found);
        match look(&Resting::new(mechanism, &rows)).and_then(judged) {
            Ok(Verdict::Rests(result, false)) => return Ok((stops, result)),
            Ok(Verdict::Rests(result, true)) => {
                falling.get_or_insert((stops, result));
            }
            Ok(Verdict::Leads(changed, behind)) => {
                first.get_or_insert(behind);
                next = Some(changed).filter(|set| !tried.contains(set));
            }
            Err(error) => {
                first.get_or_insert(error);
            }
        }
    }
    if let Some(found) = falling {
        return Ok(found);
    }
    Err(first.unwrap_or(Error::NoFreedom { mechanism: mechanism.info().name }))
}

/// The verdict on a position that was found on a set of stops.
enum Verdict<R> {
    /// It rests there; true if it falls away.
    Rests(R, bool),
    /// It leads to another set; the error is that of a search which ends here.
    Leads(BTreeSet<usize>, Error),
}

/// Looks for a stop of a set that pulls, and for another one that lies before the position.
fn judged<R>(
    mechanism: &dyn Equations<f64>,
    t: f64,
    (rows, stops): (&[usize], &[usize]),
    Found { result, q, multipliers, falls }: Found<R>,
) -> Result<Verdict<R>, Error> {
    let (gaps, size) = gaps(mechanism, t, &q);
    let behind = |stop: usize| Error::from(mechanism.info().behind(t, stop, gaps[stop]));
    if let Some(stop) = stops.first().filter(|_| !are_independent(mechanism, (t, &q), rows)) {
        return Err(behind(*stop));
    }
    let mut set: BTreeSet<usize> = stops.iter().copied().collect();
    // a multiplier is minus what a stop pushes with
    let of_stops = &multipliers[multipliers.len() - stops.len()..];
    let largest = of_stops.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let pulled = (0..stops.len()).max_by(|a, b| of_stops[*a].total_cmp(&of_stops[*b]));
    if let Some(at) = pulled.filter(|at| of_stops[*at] > PULLS * largest) {
        set.remove(&stops[at]);
        let stop = mechanism.info().stops[stops[at]].name;
        return Ok(Verdict::Leads(set, Error::Pulls { stop }));
    }
    let others = (0..gaps.len()).filter(|stop| !stops.contains(stop));
    let worst = others.min_by(|a, b| gaps[*a].total_cmp(&gaps[*b]));
    match worst.filter(|stop| gaps[*stop] < -size) {
        None => Ok(Verdict::Rests(result, falls)),
        Some(stop) => {
            set.insert(stop);
            Ok(Verdict::Leads(set, behind(stop)))
        }
    }
}

/// All sets of so many stops, the smallest ones first.
fn subsets(count: usize, sizes: RangeInclusive<usize>) -> impl Iterator<Item = BTreeSet<usize>> {
    sizes.take_while(move |size| *size <= count).flat_map(move |size| {
        let sets = (0..1_u32 << count).filter(move |bits| bits.count_ones() as usize == size);
        sets.map(move |bits| (0..count).filter(|stop| bits & (1 << stop) != 0).collect())
    })
}

/// The rows beside the constraints at a point: of the modes that hold, and of the stops that are closed there, if all of them
/// push. Of stops that depend on each other, such as three feet on a floor, it gives as many as are independent.
///
/// # Errors
/// A point behind a stop, or that touches one which does not push: what is beside it is not linear; one that is off a
/// constraint of a mode that holds.
pub fn rows_at(mechanism: &dyn Equations<f64>, point: &OperatingPoint) -> Result<Vec<usize>, Error> {
    let (t, q) = (point.t, &point.q[..]);
    let (gaps, size) = gaps(mechanism, t, q);
    let info = mechanism.info();
    if let Some(stop) = (0..gaps.len()).find(|stop| gaps[*stop] < -size) {
        return Err(info.behind(t, stop, gaps[stop]).into());
    }
    meets_modes(mechanism, (t, q), &point.inputs)?;
    let held = held_rows(mechanism, (t, q), &point.inputs);
    let are_free = |rows: &[usize]| are_independent(mechanism, (t, q), rows);
    // a gap that joints and modes keep sees no small motion
    let moves = |stop: usize| are_free(&[&held[..], &[stop]].concat());
    let closed: Vec<usize> = (0..gaps.len()).filter(|stop| gaps[*stop] <= size && moves(*stop)).collect();
    let mut rows = held.clone();
    for stop in &closed {
        rows.push(*stop);
        if !are_free(&rows) {
            rows.pop();
        }
    }
    let pushing = pushing(mechanism, point, &held, (&closed, rows.len() - held.len()));
    match closed.iter().find(|stop| !pushing.contains(stop)) {
        None => Ok(rows),
        Some(stop) => {
            let what = "a linear system about a position that touches a stop without force";
            Err(mbs_runtime::Error::Stops { what, stop: info.stops[*stop].name }.into())
        }
    }
}

/// The closed stops that can push while none of them pulls; so many of them are independent of each other. The forces on dependent
/// stops are not unique: each independent set that balances the loads is one answer, and a mean of answers is another.
fn pushing(
    mechanism: &dyn Equations<f64>,
    point: &OperatingPoint,
    held: &[usize],
    (closed, independent): (&[usize], usize),
) -> BTreeSet<usize> {
    let (t, q) = (point.t, &point.q[..]);
    let mut pushing = BTreeSet::new();
    for set in subsets(closed.len(), independent..=independent).take(MOST_SETS) {
        let stops: Vec<usize> = set.iter().map(|at| closed[*at]).collect();
        let rows = [held, &stops].concat();
        if !are_independent(mechanism, (t, q), &rows) {
            continue;
        }
        let resting = Resting::new(mechanism, &rows);
        let declared = mechanism.info().constraints.len();
        let (mut a, mut multipliers) = (vec![0.0; q.len()], vec![0.0; declared + rows.len()]);
        resting.reactions(At { t, q, v: &point.v }, &point.inputs, &mut a, &mut multipliers);
        // a multiplier is minus what a stop pushes with
        let of_stops = &multipliers[declared + held.len()..];
        let largest = of_stops.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if of_stops.iter().all(|multiplier| *multiplier <= PULLS * largest) {
            let pushes = stops.iter().zip(of_stops).filter(|(_, multiplier)| **multiplier < -PULLS * largest);
            pushing.extend(pushes.map(|(stop, _)| *stop));
        }
    }
    pushing
}

/// Why there is no linear system by parameters about a row of a stop or of a mode.
pub fn not_by_parameters(info: &Info, row: usize) -> Error {
    let lock = info.locks().find(|(of, _)| *of == row);
    let mode = lock.and_then(|(_, lock)| info.modes.modes.iter().find(|mode| mode.memory == lock.mode));
    let stop = info.stops.get(row).map_or("", |stop| stop.name);
    Error::ByParameters { holds: mode.map_or(stop, |mode| mode.name) }
}
