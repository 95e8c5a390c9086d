//! Starts that are given in place of the declared one.

use mbs_analysis::Signal;
use mbs_runtime::equations::{At, Room, assemble, check, project, project_velocities};
use mbs_runtime::{Dimension, Info, System};

use crate::{Error, Model, Start, StartKind, StartState, Unit, quantity};

/// A coordinate or its rate.
#[derive(Clone, Copy)]
struct Place {
    at: usize,
    is_rate: bool,
}

impl Place {
    /// The place of what is called `x` or `der(x)`, with its dimension and the unit of a bare number.
    fn find(info: &Info, name: &str) -> Result<(Self, Dimension, Unit), Error> {
        let signals = Signal::states(info);
        let wanted: String = name.chars().filter(|letter| !letter.is_whitespace()).collect();
        let Some((place, signal)) = signals.iter().enumerate().find(|(_, signal)| signal.name == wanted)
        else {
            let names = signals.iter().map(|signal| signal.name.as_str());
            return Err(Error::unknown("coordinate, rate or state", name, names));
        };
        let n = info.coordinates.len();
        let found = Self { at: place % n, is_rate: place >= n };
        Ok((found, signal.dimension, Unit::of_signal(info, signal)))
    }
}

/// The unit in which a coordinate `x` or a rate `der(x)` is shown.
#[cfg(feature = "desk")]
pub(crate) fn unit(info: &Info, name: &str) -> Option<Unit> {
    Place::find(info, name).ok().map(|(_, _, unit)| unit)
}

impl StartState {
    /// Values in SI units of coordinates `x` and rates `der(x)`, from texts.
    ///
    /// # Errors
    /// Names that the mechanism does not have or that come twice, values that cannot be read or have another
    /// dimension.
    pub fn values(info: &Info, texts: &[(String, String)]) -> Result<Vec<(String, f64)>, Error> {
        let mut found: Vec<(String, f64)> = Vec::new();
        for (name, text) in texts {
            let (_, dimension, unit) = Place::find(info, name)?;
            if found.iter().any(|(other, _)| other == name) {
                return Err(Error::Name { name: name.clone(), reason: "it is set twice".into() });
            }
            found.push((name.clone(), quantity::parse_in(name, text, dimension, &unit)?));
        }
        Ok(found)
    }
}

/// The declared start of a run with these values in it, made consistent.
///
/// It is what the declaration would give with these values in its `start`. If other values that are declared
/// contradict them, those move too: only what is given here stays.
///
/// # Errors
/// Names that the mechanism does not have, positions from which it cannot be assembled.
pub(crate) fn with_values(
    model: &dyn Model,
    start: &Start,
    values: &[(String, f64)],
) -> Result<StartState, Error> {
    let info = model.info();
    let places: Vec<(Place, f64)> = values
        .iter()
        .map(|(name, value)| Ok((Place::find(info, name)?.0, *value)))
        .collect::<Result<_, Error>>()?;
    let run =
        model.start(&Start { kind: StartKind::Declared, is_looked_at: true, ..start.without_modes(info) })?;
    let n = info.coordinates.len();
    let (mut q, mut v) = (vec![f64::NAN; n], vec![f64::NAN; n]);
    run.state(&mut q, &mut v);
    for (Place { at, is_rate }, value) in &places {
        *(if *is_rate { &mut v[*at] } else { &mut q[*at] }) = *value;
    }
    // all of them are a state, which is as consistent as it is
    if places.len() < 2 * n && start.kind == StartKind::Consistent {
        make_consistent(&*run, &places, &mut q, &mut v)?;
        // reduced states would be completed by other values than those that are given
        let mut numbers = vec![0.0; Room::<f64>::len(info, 0)];
        let at = At { t: run.time(), q: &q, v: &v };
        check(run.equations(), at, start.step, &mut Room::within(&mut numbers, info))?;
    }
    Ok(StartState { start_time: run.time(), steps_taken: 0, q, v })
}

/// Given positions that contradict each other may move by this share of the largest one.
const NEAR: f64 = 1e-3;

/// Moves positions, then velocities onto the constraints: as in a start that is declared, and where that would move
/// one of `places`, everything but those.
fn make_consistent(
    run: &dyn System,
    places: &[(Place, f64)],
    q: &mut [f64],
    v: &mut [f64],
) -> Result<(), mbs_runtime::Error> {
    let (t, equations) = (run.time(), run.equations());
    let info = equations.info();
    let mut numbers = vec![0.0; Room::<f64>::len(info, 0)];
    let mut room = Room::within(&mut numbers, info);
    let given = |is_rate: bool| places.iter().filter(move |(place, _)| place.is_rate == is_rate);
    let names = |is_rate: bool| -> Vec<&'static str> {
        given(is_rate).map(|(place, _)| info.coordinates[place.at].name).collect()
    };
    let size = q.iter().fold(0.0_f64, |size, q| size.max(q.abs()));
    let nearly =
        |now: &[f64]| given(false).all(|(place, value)| (now[place.at] - value).abs() <= NEAR * size);
    let stays = |now: &[f64], is_rate: bool| given(is_rate).all(|(place, value)| now[place.at] == *value);

    let mut moved = q.to_vec();
    let is_assembled = assemble(equations, t, &mut moved, &mut room).is_ok();
    if !(is_assembled && stays(&moved, false)) {
        let names = names(false);
        let mut keeping = |names: &[&'static str]| {
            let mut kept = q.to_vec();
            project(equations, t, &mut kept, &mut v.to_vec(), [names, &[]], &mut room).map(|()| kept)
        };
        moved = keeping(&names).or_else(|error| {
            // values that are rounded contradict each other by little, as those of a declaration may
            let fewer = (0..names.len()).rev().filter_map(|count| keeping(names.get(..count)?).ok());
            fewer.into_iter().find(|kept| nearly(kept)).ok_or(error)
        })?;
    }
    q.copy_from_slice(&moved);
    let mut moved = v.to_vec();
    if project_velocities(equations, t, q, &mut moved, &mut room).is_ok() && stays(&moved, true) {
        v.copy_from_slice(&moved);
        return Ok(());
    }
    let all: Vec<&'static str> = info.coordinates.iter().map(|coordinate| coordinate.name).collect();
    project(equations, t, q, v, [&all, &names(true)], &mut room)
}
