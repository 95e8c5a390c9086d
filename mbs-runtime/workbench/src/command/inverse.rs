//! `mbs inverse`: what a prescribed motion takes.

use std::path::{Path, PathBuf};

use clap::{Args, value_parser};
use mbs_analysis::{By, Curve, Instant, Prescription, inverse};
use mbs_runtime::{Info, Quantity};
use serde_json::json;

use super::extremes;
use super::options::{self, Named, Values, pairs, signed};
use crate::figure::axis;
use crate::figure::{Axis, Figure, Panel, Save, Series};
use crate::models::Models;
use crate::quantity::{self, TIME};
use crate::settings::Start;
use crate::sheet::Sheet;
use crate::{About, Column, Error, Unit, names, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs inverse metronome --move phi=0deg..90deg --over 1s --plot effort.svg
  mbs inverse four-bar-free --move theta2=0deg..270deg --over 0.5s --inputs crank_torque --out torque.csv
  mbs inverse my.mbs --motion measured.csv --inputs '*'
  mbs inverse toggle-press --over 2s --plot press.svg    # its drive prescribes the motion

Without --inputs it is the force or the torque along each prescribed coordinate that is found.";

#[derive(Args)]
#[command(
    about = "Find the inputs, or the forces along coordinates, that a prescribed motion takes",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    #[command(flatten)]
    values: Values,
    /// Begin on the branch of this value of a coordinate; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    from: Vec<String>,
    /// Move a coordinate from rest to rest by a 3-4-5 polynomial; repeatable
    #[arg(long = "move", value_name = "NAME=FROM..TO")]
    moves: Vec<String>,
    /// Move coordinates by splines through samples, with time and coordinates in columns
    #[arg(long, value_name = "FILE.csv")]
    motion: Option<PathBuf>,
    /// How long it lasts [default: 1s, or as long as the file]
    #[arg(long, value_name = "TIME")]
    over: Option<String>,
    /// At how many instants [default: 201]
    #[arg(long, value_name = "COUNT", value_parser = value_parser!(u32).range(2..=1_000_000))]
    samples: Option<u32>,
    /// The inputs that produce the motion, also patterns with *
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    inputs: Option<Vec<String>>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Draw the motion and what it takes
    #[arg(long, value_name = "FILE.svg|.png")]
    plot: Option<PathBuf>,
    /// Write positions, rates, accelerations, inputs, forces and outputs
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let [plot, out] = [&self.plot, &self.out].map(Option::as_deref);
        options::check_files(self.motion.as_deref(), &[plot], &[out])?;
        let values = self.values.constants("inputs are found here, or keep their values")?;
        let info = model.info();
        let start = Start::of(model, &values.settings(model)?)?;
        let t = model.start(&start)?.time();
        let over = self.over.as_ref().map(|text| duration(text)).transpose()?;
        let wanted = self.wanted(info, [t, over.unwrap_or(1.0)], over)?;
        let count = self.samples.unwrap_or(SAMPLES);
        let about = About { from: pairs(&self.from)?, ..About::default() };
        let (run, search) = about.search(model, &start)?;
        let prescription = Prescription {
            curves: wanted.curves,
            by: self.inputs.as_ref().map_or(Ok(By::Efforts), |patterns| by(info, patterns))?,
            inputs: Some(start.inputs.clone()),
            from: search.from,
            t,
        };
        let [from, to] = wanted.span;
        let times: Vec<f64> =
            (0..count).map(|at| from + (to - from) * f64::from(at) / f64::from(count - 1)).collect();
        let instants = inverse(run.equations(), &prescription, &times)?;
        let shown = Shown::of(info, &prescription, &instants);
        if let Some(path) = plot {
            shown.figure(&format!("{name}: what the motion takes")).save(path)?;
        }
        if let Some(path) = out {
            write_csv(path, &shown.columns)?;
        }
        if self.json {
            return say(json!({
                "mechanism": name, "from_s": from, "to_s": to, "samples": count,
                "prescribed": shown.prescribed, "takes": extremes::json(shown.takes()),
                "outputs": extremes::json(shown.outputs()),
            }));
        }
        say(extremes::table(name, shown.takes().chain(shown.outputs())).to_string().trim_end())?;
        options::say_written([plot, out])
    }

    /// The motion that is prescribed, of this usual span.
    fn wanted(&self, info: &Info, [t, usual]: [f64; 2], over: Option<f64>) -> Result<Wanted, Error> {
        let mut curves = Vec::new();
        let mut span = [t, t + usual];
        if let Some(path) = &self.motion {
            let (times, columns) = samples(path, info)?;
            if let [first, .., last] = times.as_slice() {
                span = [*first, over.map_or(*last, |over| first + over)];
            }
            for (name, values) in columns {
                let curve = Curve::spline(&times, &values).map_err(|error| Error::Name {
                    name: path.display().to_string(),
                    reason: error.to_string(),
                })?;
                curves.push((name, curve));
            }
        }
        for text in &self.moves {
            let (coordinate, [from, to]) = coordinate_range(info, text)?;
            let curve = Curve::rest_to_rest(from, to, span[0], span[1] - span[0])?;
            curves.push((coordinate.name.to_owned(), curve));
        }
        Ok(Wanted { curves, span })
    }
}

const SAMPLES: u32 = 201;

/// The motion that a command line prescribes.
struct Wanted {
    curves: Vec<(String, Curve)>,
    span: [f64; 2],
}

/// Times in s, and the coordinates over them by name.
type Samples = (Vec<f64>, Vec<(String, Vec<f64>)>);

/// Reads a table of coordinates over time.
fn samples(path: &Path, info: &Info) -> Result<Samples, Error> {
    let sheet = Sheet::read(path)?;
    sheet.are_known("coordinate", info.coordinates)?;
    let mut columns = Vec::new();
    for column in &sheet.columns {
        let Some(of) = info.coordinates.iter().find(|coordinate| coordinate.name == column.name) else {
            continue;
        };
        let usual = Unit::of_coordinate(of);
        let read = |text: &str| quantity::parse_in(of.name, text, of.dimension, &usual);
        columns.push((of.name.to_owned(), sheet.complete(column, read)?));
    }
    Ok((sheet.times, columns))
}

fn duration(text: &str) -> Result<f64, Error> {
    let over = quantity::parse("over", text, TIME)?;
    if over > 0.0 {
        return Ok(over);
    }
    Err(Error::Value { what: "over".into(), text: text.into(), reason: "it has to be above 0".into() })
}

/// `NAME=FROM..TO` of a coordinate.
pub(super) fn coordinate_range<'a>(info: &'a Info, text: &str) -> Result<(&'a Quantity, [f64; 2]), Error> {
    let (name, range) = quantity::split_setting(text)?;
    let coordinate = info
        .coordinates
        .iter()
        .find(|q| q.name == name)
        .ok_or_else(|| Error::unknown("coordinate", name, info.coordinates.iter().map(|q| q.name)))?;
    let (from, to) = range.split_once("..").ok_or_else(|| Error::Value {
        what: name.into(),
        text: range.into(),
        reason: format!("that is not a range; write {name}=FROM..TO, for instance 0deg..90deg"),
    })?;
    let unit = Unit::of_coordinate(coordinate);
    let value = |text: &str| quantity::parse_in(name, text, coordinate.dimension, &unit);
    Ok((coordinate, [value(from)?, value(to)?]))
}

/// The causes of the motion: the inputs that fit the patterns, or nothing but forces along coordinates.
fn by(info: &Info, patterns: &[String]) -> Result<By, Error> {
    let mut found: Vec<String> = Vec::new();
    for pattern in patterns {
        let mut fitting = info.inputs.iter().filter(|input| names::fits(pattern, input.name)).peekable();
        if fitting.peek().is_none() {
            return Err(Error::unknown("input", pattern, info.inputs.iter().map(|input| input.name)));
        }
        let new: Vec<String> =
            fitting.filter(|q| !found.iter().any(|name| name == q.name)).map(|q| q.name.to_owned()).collect();
        found.extend(new);
    }
    Ok(By::Inputs(found))
}

/// A motion and what it takes, as columns in their units.
struct Shown {
    columns: Vec<Column>,
    /// The names of the prescribed coordinates, or of the drives.
    prescribed: Vec<String>,
    takes: Vec<String>,
    outputs: Vec<String>,
}

impl Shown {
    fn of(info: &Info, prescription: &Prescription, instants: &[Instant]) -> Self {
        let mut columns = vec![column("t".into(), &Unit::si(TIME), instants.iter().map(|instant| instant.t))];
        let all = |part: fn(&Instant) -> &[f64], at: usize| {
            instants.iter().map(move |instant| part(instant).get(at).copied().unwrap_or(f64::NAN))
        };
        for (at, q) in info.coordinates.iter().enumerate() {
            columns.push(column(q.name.into(), &Unit::of_coordinate(q), all(|x| &x.q, at)));
        }
        for (at, q) in info.coordinates.iter().enumerate() {
            let unit = Unit::of_coordinate(q).per_second();
            columns.push(column(format!("der({})", q.name), &unit, all(|x| &x.v, at)));
        }
        for (at, q) in info.coordinates.iter().enumerate() {
            let unit = Unit::of_coordinate(q);
            let name = format!("{}/s^2", unit.name());
            let mut accelerations = Column::new(format!("der(der({}))", q.name), name);
            accelerations.values = all(|x| &x.acceleration, at).map(|x| unit.shown(x)).collect();
            columns.push(accelerations);
        }
        let mut takes = Vec::new();
        for (at, input) in info.inputs.iter().enumerate() {
            columns.push(column(input.name.into(), &Unit::of(input), all(|x| &x.inputs, at)));
            match &prescription.by {
                By::Inputs(names) if names.iter().any(|name| name == input.name) => {
                    takes.push(input.name.into())
                }
                By::AllInputs => takes.push(input.name.into()),
                By::Inputs(_) | By::Efforts => {}
            }
        }
        if prescription.by == By::Efforts {
            for (at, (name, _)) in prescription.curves.iter().enumerate() {
                let Some(q) = info.coordinates.iter().find(|q| q.name == name) else { continue };
                let effort = column(
                    format!("effort({name})"),
                    &Unit::of_multiplier(q.dimension),
                    all(|x| &x.efforts, at),
                );
                takes.push(effort.name.clone());
                columns.push(effort);
            }
        }
        for (at, row) in info.constraints.iter().enumerate() {
            let unit = Unit::of_multiplier(row.dimension);
            columns.push(column(format!("lambda({})", row.name), &unit, all(|x| &x.multipliers, at)));
            // what a drive exerts is what the motion takes
            if row.is_drive {
                let effort = all(|x| &x.multipliers, at).map(|multiplier| -multiplier);
                takes.push(format!("effort({})", row.name));
                columns.push(column(format!("effort({})", row.name), &unit, effort));
            }
        }
        let mut outputs = Vec::new();
        for (at, output) in info.outputs.iter().enumerate() {
            outputs.push(output.name.to_owned());
            columns.push(column(output.name.into(), &Unit::of(output), all(|x| &x.outputs, at)));
        }
        let prescribed = prescription.curves.iter().map(|(name, _)| name.clone()).collect();
        Self { columns, prescribed, takes, outputs }
    }

    fn named<'a>(&'a self, names: &'a [String]) -> impl Iterator<Item = &'a Column> {
        names.iter().filter_map(|name| self.columns.iter().find(|column| column.name == *name))
    }

    fn takes(&self) -> impl Iterator<Item = &Column> {
        self.named(&self.takes)
    }

    fn outputs(&self) -> impl Iterator<Item = &Column> {
        self.named(&self.outputs)
    }

    fn figure(&self, title: &str) -> Figure {
        let times = self.columns.first().map_or(&[][..], |time| &time.values);
        let parts = [
            ("prescribed", self.named(&self.prescribed).collect::<Vec<_>>()),
            ("takes", self.takes().collect()),
            ("outputs", self.outputs().collect()),
        ];
        let mut figure = Figure::new(title).panel_height(300);
        for (part, columns) in parts {
            for panel in panels(part, Axis::new("time", "s"), times, &columns) {
                figure = figure.panel(panel);
            }
        }
        figure
    }
}

/// A panel for each unit.
pub(super) fn panels(part: &str, x: Axis, places: &[f64], columns: &[&Column]) -> Vec<Panel> {
    let mut units: Vec<&str> = Vec::new();
    for column in columns {
        if !units.contains(&column.unit.as_str()) {
            units.push(&column.unit);
        }
    }
    let panel = |unit: &str| {
        let shared: Vec<&&Column> = columns.iter().filter(|column| column.unit == unit).collect();
        let label = match shared.as_slice() {
            [alone] => alone.name.as_str(),
            _ => part,
        };
        let name =
            |column: &Column| if shared.len() == 1 { String::new() } else { column.name.replace('_', " ") };
        let curves: Vec<Series> =
            shared.iter().map(|column| Series::xy(name(column), places, &column.values)).collect();
        Panel::lines(x.clone(), axis(label, unit), curves)
    };
    units.into_iter().map(panel).collect()
}

/// A column of values in SI units, in the unit in which they are shown.
pub(super) fn column(name: String, unit: &Unit, values: impl Iterator<Item = f64>) -> Column {
    let mut column = Column::new(name, unit.name());
    column.values = values.map(|x| unit.shown(x)).collect();
    column
}
