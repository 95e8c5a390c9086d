//! The stops that a mechanism rests on, and positions behind stops.

use std::collections::BTreeSet;

use mbs_runtime::equations::{At, Described, are_independent};

use crate::resting::Resting;
use crate::{Error, OperatingPoint};

/// A gap is closed, and a position behind a stop, by more than this share of the largest coordinate, there or at the start.
const CLOSED: f64 = 1e-9;
/// A stop pulls by more than this share of the largest force at stops.
const PULLS: f64 = 1e-9;
/// So many sets of stops are tried.
const MOST_SETS: usize = 256;

/// The gaps of a position, and the size of what counts.
fn gaps(mechanism: &dyn Described<f64>, t: f64, q: &[f64]) -> (Vec<f64>, f64) {
    let still = vec![0.0; q.len()];
    let mut gaps = vec![0.0; 3 * mechanism.info().contacts()];
    mechanism.gaps(At { t, q, v: &still }, &still, &mut gaps);
    let declared = mechanism.info().coordinates.iter().map(|q| q.default);
    let size = q.iter().copied().chain(declared).fold(0.0_f64, |size, x| size.max(x.abs()));
    // each has its rate and its second derivative behind it
    let stops = mechanism.info().stops.len();
    (gaps.into_iter().step_by(3).take(stops).collect(), CLOSED * size)
}

/// A position that was found on a set of stops.
pub struct Found<R> {
    /// The result of the search.
    pub result: R,
    /// Positions.
    pub q: Vec<f64>,
    /// The multipliers of all rows, those of stops last.
    pub multipliers: Vec<f64>,
}

/// The stops that are rested on, and what is found there: none pulls, and no other gap is negative. `look` looks on a set.
///
/// Sets are tried one after the other. A position behind a stop leads to the set with this stop, a stop that pulls to the set
/// without it. Where that finds nothing, all sets are tried, from the smallest ones on.
///
/// # Errors
/// Those of `look` without stops; [`Behind`](mbs_runtime::Error::Behind).
pub fn complementary<R>(
    mechanism: &dyn Described<f64>,
    t: f64,
    mut look: impl FnMut(&dyn Described<f64>) -> Result<Found<R>, Error>,
) -> Result<(Vec<usize>, R), Error> {
    let count = mechanism.info().stops.len();
    let (mut tried, mut first) = (BTreeSet::new(), None);
    let mut next = Some(BTreeSet::new());
    let mut all = subsets(count, usize::try_from(mechanism.info().dof).unwrap_or(0));
    while tried.len() < MOST_SETS {
        let Some(set) = next.take().or_else(|| all.find(|set| !tried.contains(set))) else { break };
        tried.insert(set.clone());
        let stops: Vec<usize> = set.iter().copied().collect();
        match look(&Resting::new(mechanism, &stops)).and_then(|found| judged(mechanism, t, &stops, found)) {
            Ok(Verdict::Rests(result)) => return Ok((stops, result)),
            Ok(Verdict::Leads(changed, behind)) => {
                first.get_or_insert(behind);
                next = Some(changed).filter(|set| !tried.contains(set));
            }
            Err(error) => {
                first.get_or_insert(error);
            }
        }
    }
    Err(first.unwrap_or(Error::NoFreedom { mechanism: mechanism.info().name }))
}

/// The verdict on a position that was found on a set of stops.
enum Verdict<R> {
    /// It rests there.
    Rests(R),
    /// It leads to another set; the error is that of a search which ends here.
    Leads(BTreeSet<usize>, Error),
}

/// Looks for a stop of a set that pulls, and for another one that lies before the position.
fn judged<R>(
    mechanism: &dyn Described<f64>,
    t: f64,
    stops: &[usize],
    Found { result, q, multipliers }: Found<R>,
) -> Result<Verdict<R>, Error> {
    let (gaps, size) = gaps(mechanism, t, &q);
    let behind = |stop: usize| {
        let name = mechanism.info().stops[stop].name;
        Error::from(mbs_runtime::Error::Behind { t, stop: name, gap: gaps[stop] })
    };
    if !are_independent(mechanism, (t, &q), stops) {
        return Err(behind(stops.first().copied().unwrap_or(0)));
    }
    let mut set: BTreeSet<usize> = stops.iter().copied().collect();
    // a multiplier is minus what a stop pushes with
    let of_stops = &multipliers[multipliers.len() - stops.len()..];
    let largest = of_stops.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let pulled = (0..stops.len()).max_by(|a, b| of_stops[*a].total_cmp(&of_stops[*b]));
    if let Some(at) = pulled.filter(|at| of_stops[*at] > PULLS * largest) {
        set.remove(&stops[at]);
        return Ok(Verdict::Leads(set, behind(stops[at])));
    }
    let others = (0..gaps.len()).filter(|stop| !stops.contains(stop));
    let worst = others.min_by(|a, b| gaps[*a].total_cmp(&gaps[*b]));
    match worst.filter(|stop| gaps[*stop] < -size) {
        None => Ok(Verdict::Rests(result)),
        Some(stop) => {
            set.insert(stop);
            Ok(Verdict::Leads(set, behind(stop)))
        }
    }
}

/// All sets of up to so many stops, the smallest ones first.
fn subsets(count: usize, most: usize) -> impl Iterator<Item = BTreeSet<usize>> {
    (0..=most.min(count)).flat_map(move |size| {
        let sets = (0..1_u32 << count).filter(move |bits| bits.count_ones() as usize == size);
        sets.map(move |bits| (0..count).filter(|stop| bits & (1 << stop) != 0).collect())
    })
}

/// The stops on which a point rests: those that are closed there, if all of them push.
///
/// # Errors
/// A point behind a stop, or that touches one which does not push: what is beside it is not linear.
pub fn rested_on(mechanism: &dyn Described<f64>, point: &OperatingPoint) -> Result<Vec<usize>, Error> {
    let (t, q) = (point.t, &point.q[..]);
    let (gaps, size) = gaps(mechanism, t, q);
    let info = mechanism.info();
    if let Some(stop) = (0..gaps.len()).find(|stop| gaps[*stop] < -size) {
        return Err(mbs_runtime::Error::Behind { t, stop: info.stops[stop].name, gap: gaps[stop] }.into());
    }
    let closed: Vec<usize> = (0..gaps.len()).filter(|stop| gaps[*stop] <= size).collect();
    let Some(first) = closed.first() else { return Ok(closed) };
    let resting = Resting::new(mechanism, &closed);
    let (mut a, mut multipliers) = (vec![0.0; q.len()], vec![0.0; info.constraints.len() + closed.len()]);
    resting.reactions(At { t, q, v: &point.v }, &point.inputs, &mut a, &mut multipliers);
    let of_stops = &multipliers[info.constraints.len()..];
    let largest = of_stops.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let pushes = |at: &usize| of_stops[*at] < -PULLS * largest;
    let loose = (0..closed.len()).find(|at| !pushes(at));
    match loose
        .map(|at| closed[at])
        .or_else(|| (!are_independent(mechanism, (t, q), &closed)).then_some(*first))
    {
        None => Ok(closed),
        Some(stop) => {
            let what = "a linear system about a position that touches a stop without force";
            Err(mbs_runtime::Error::Stops { what, stop: info.stops[stop].name }.into())
        }
    }
}
