//! Output of a run: a table, curves, and a page with the mechanism in motion.

use mbs_runtime::Info;

use super::curves::{Choice, curves, hidden};
use super::options::Given;
use crate::number::significant;
use crate::report::{Animation, Block, Readout, Report, Section};
use crate::{Column, Error, Model, Picture, Recording, Settings, Table};

/// More events than this are not listed.
const MOST_EVENTS: usize = 12;
/// More values than this beside a moving picture nobody can follow.
const MOST_READOUTS: usize = 6;

/// The page of a run.
pub(super) fn page(
    name: &str,
    info: &Info,
    recording: &Recording,
    picture: &Picture,
    choice: &Choice,
) -> Result<Report, Error> {
    let title = format!("{name}: the motion");
    let animation =
        Animation { title, picture: picture.clone(), readouts: readouts(info, recording, picture) };
    let figure = curves(name, &thinned(recording), choice)?;
    let run = Section::new("The run").with(Block::Table(summary(name, &[], recording, Shown::Ends)));
    let run = recording.doubts.iter().fold(run, |run, doubt| run.text(format!("Warning: {doubt}.")));
    let run = recording.notes.iter().fold(run, |run, note| run.text(format!("Note: {note}.")));
    Ok(Report {
        title: name.to_owned(),
        lead: info.doc.to_owned(),
        sections: vec![
            Section::new("The mechanism").with(Block::Animation(animation)),
            run,
            Section::new("Curves").with(Block::Figure { figure, caption: String::new(), files: Vec::new() }),
        ],
    })
}

impl dyn Model + '_ {
    /// A page with the mechanism in motion during a run with these settings, and its curves.
    ///
    /// # Errors
    /// As [`motion`](Model#method.motion).
    pub fn page(&self, name: &str, settings: &Settings, recording: &Recording) -> Result<Report, Error> {
        let picture = Picture::of(&self.motion(settings, recording)?);
        page(name, self.info(), recording, &picture, &Choice::default())
    }
}

/// As many rows as curves on a screen need, fewer where there are many curves.
fn thinned(recording: &Recording) -> Recording {
    const MOST_VALUES: usize = 30_000;
    let rows = recording.columns.first().map_or(0, |column| column.values.len());
    let most = (MOST_VALUES / recording.columns.len().max(1)).clamp(100, 1500);
    let stride = rows.div_ceil(most).max(1);
    let mut thinned = recording.clone();
    for column in &mut thinned.columns {
        column.values = column.values.iter().copied().step_by(stride).collect();
    }
    thinned
}

/// The outputs at the instants of a picture; of a mechanism without any, its coordinates.
fn readouts(info: &Info, recording: &Recording, picture: &Picture) -> Vec<Readout> {
    let named = if info.outputs.is_empty() { info.coordinates } else { info.outputs };
    let times = recording.columns.first().map_or(&[][..], |column| &column.values);
    // A picture has some of the recorded instants, in order.
    let rows: Vec<usize> = picture.times.iter().map(|t| times.partition_point(|other| other < t)).collect();
    let columns = named.iter().take(MOST_READOUTS).filter_map(|q| recording.column(q.name));
    let values = |all: &[f64]| rows.iter().map(|&row| all.get(row).copied().unwrap_or(f64::NAN)).collect();
    let readout = |column: &Column| Readout {
        name: column.name.replace('_', " "),
        unit: column.unit.replace('*', "·"),
        values: values(&column.values),
    };
    columns.map(readout).collect()
}

/// Whose values at the end are shown.
pub(super) enum Shown<'a> {
    All,
    /// Of a long list of coordinates its ends.
    Ends,
    Chosen(Vec<&'a Column>),
}

/// A table of a run: the values that were set, the figures that one looks at first, and the values at its
/// end.
pub(super) fn summary(name: &str, given: &[Given], recording: &Recording, shown: Shown<'_>) -> Table {
    let summary = &recording.summary;
    let mut table = Table::new([name, "", ""]);
    let mut row = |what: &str, value: String, unit: &str| table.row([what, &value, unit]);
    for (name, value, unit) in given {
        row(&format!("{name}, as set"), significant(unit.shown(*value), 7), unit.name());
    }
    match summary.effort {
        None => row("steps", summary.steps.to_string(), ""),
        Some(effort) => {
            row("samples", summary.steps.to_string(), "");
            row("steps to the tolerance", effort.steps.to_string(), "");
            row("rejected steps", effort.rejected.to_string(), "");
            row("shortest step", significant(1e3 * effort.shortest, 3), "ms");
            row("longest step", significant(1e3 * effort.longest, 3), "ms");
        }
    }
    let (first, rest) = recording.occurrences.split_at(recording.occurrences.len().min(MOST_EVENTS));
    for event in first {
        row(&event.name, significant(event.t, 10), "s");
    }
    if !rest.is_empty() {
        row(&format!("… {} more events, with --json", rest.len()), String::new(), "");
    }
    if let Some(unmet) = &recording.unmet {
        let how = if unmet.holds_at_start { "holds from the start" } else { "not met" };
        row(&unmet.condition, how.into(), "");
    }
    row("constraint violation, max ‖Φ‖", significant(summary.max_phi, 4), "");
    row("its rate, max ‖dΦ/dt‖", significant(summary.max_phi_dot, 4), "1/s");
    row("energy change", significant(summary.energy_end - summary.energy_start, 6), "J");
    let at_end = |column: &Column| {
        let value = column.values.last().map_or_else(String::new, |last| significant(*last, 7));
        (format!("{} at the end", column.name), value)
    };
    let (all, hidden, integrals) = match shown {
        Shown::Chosen(columns) => {
            for column in columns {
                let (name, value) = at_end(column);
                row(&name, value, &column.unit);
            }
            return table;
        }
        Shown::All => (recording.columns.iter(), 0..0, 0..0),
        Shown::Ends => {
            let integrals = recording.lines..recording.coordinates;
            (recording.columns.iter(), hidden(recording.lines), integrals)
        }
    };
    for (at, column) in all.enumerate() {
        // behind the time, coordinates and then their rates
        let place = at.checked_sub(1).filter(|&at| at < 2 * recording.coordinates);
        if place.is_some_and(|place| integrals.contains(&place)) {
            continue;
        }
        let place = place.map(|at| at % recording.coordinates);
        if place.is_some_and(|place| hidden.contains(&place)) {
            if place == Some(hidden.start) {
                row(&format!("… {} more, with --all", hidden.len()), String::new(), "");
            }
            continue;
        }
        if column.name != "violation" && !column.name.starts_with("lambda(") {
            let (name, value) = at_end(column);
            row(&name, value, &column.unit);
        }
    }
    table
}
