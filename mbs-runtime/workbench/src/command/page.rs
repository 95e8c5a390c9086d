//! What a run shows: a table, curves, and a page with the mechanism in motion.

use std::ops::Range;

use mbs_runtime::Info;

use crate::figure::{Axis, Figure, Panel, Series};
use crate::model::coordinate_unit;
use crate::number::significant;
use crate::report::{Animation, Block, Readout, Report, Section};
use crate::{Picture, Recording, Table, quantity};

/// More values than this beside a moving picture nobody can follow.
const MOST_READOUTS: usize = 6;

/// The page of a run.
pub(super) fn page(name: &str, info: &Info, recording: &Recording, picture: &Picture) -> Report {
    let title = format!("{name}: the motion");
    let animation =
        Animation { title, picture: picture.clone(), readouts: readouts(info, recording, picture) };
    let figure = curves(name, info, &thinned(recording));
    Report {
        title: name.to_owned(),
        lead: info.doc.to_owned(),
        sections: vec![
            Section::new("The mechanism").with(Block::Animation(animation)),
            Section::new("The run").with(Block::Table(summary(name, recording, Shown::Some))),
            Section::new("Curves").with(Block::Figure { figure, caption: String::new(), files: Vec::new() }),
        ],
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
    let readout = |column: &crate::Column| Readout {
        name: column.name.replace('_', " "),
        unit: column.unit.replace('*', "·"),
        values: values(&column.values),
    };
    columns.map(readout).collect()
}

/// How many coordinates are shown.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    All,
    /// The first and the last of a long list, which in a chain are its ends.
    Some,
}

impl Shown {
    /// A list that is longer is long.
    const MANY: usize = 12;
    const ENDS: usize = 3;

    /// Those of `count` that are not shown.
    fn hidden(self, count: usize) -> Range<usize> {
        if self == Self::All || count <= Self::MANY { 0..0 } else { Self::ENDS..count - Self::ENDS }
    }
}

/// The figures of a run that one looks at first, and the values at its end.
pub(super) fn summary(name: &str, recording: &Recording, shown: Shown) -> Table {
    let summary = &recording.summary;
    let mut table = Table::new([name, "", ""]);
    let mut row = |what: &str, value: String, unit: &str| table.row([what, &value, unit]);
    row("steps", summary.steps.to_string(), "");
    row("max ‖Φ‖", significant(summary.max_phi, 4), "");
    row("max ‖Φ̇‖", significant(summary.max_phi_dot, 4), "1/s");
    row("energy change", significant(summary.energy_end - summary.energy_start, 6), "J");
    let hidden = shown.hidden(recording.coordinates);
    for (at, column) in recording.columns.iter().enumerate() {
        // behind the time, coordinates and then their rates
        let place = at.checked_sub(1).filter(|&at| at < 2 * recording.coordinates);
        let place = place.map(|at| at % recording.coordinates);
        if place.is_some_and(|place| hidden.contains(&place)) {
            if place == Some(hidden.start) {
                row(&format!("… {} more, with --all", hidden.len()), String::new(), "");
            }
            continue;
        }
        let is_shown = column.name != "violation" && !column.name.starts_with("lambda(");
        if let Some(last) = column.values.last().filter(|_| is_shown) {
            row(&format!("{} at the end", column.name), significant(*last, 7), &column.unit);
        }
    }
    table
}

/// Coordinates by kind, each output, and the violation.
pub(super) fn curves(name: &str, info: &Info, recording: &Recording) -> Figure {
    let time = recording.columns.first().map_or(&[][..], |c| &c.values);
    let axis = || Axis::new("time", "s");
    let series = |name: &str| {
        let values = recording.column(name).map_or(&[][..], |c| &c.values);
        Series::xy(name, time, values)
    };
    let mut figure = Figure::new(name).panel_height(300);
    for (label, unit) in [("position", "m"), ("angle", "rad")] {
        let of_kind: Vec<_> =
            info.coordinates.iter().filter(|q| coordinate_unit(q) == unit).map(|q| series(q.name)).collect();
        if !of_kind.is_empty() {
            figure = figure.panel(Panel::lines(axis(), Axis::new(label, unit), of_kind));
        }
    }
    for output in info.outputs {
        let unit = quantity::si_unit(output.dimension).replace('*', "·");
        let unit = if unit == "1" { String::new() } else { unit };
        let shown = Series { name: String::new(), ..series(output.name) };
        figure = figure.panel(Panel::lines(axis(), Axis::new(output.name.replace('_', " "), unit), [shown]));
    }
    let violation = Series { name: String::new(), ..series("violation") };
    figure.panel(Panel::lines(axis(), Axis::new("violation ‖Φ‖", ""), [violation]))
}
