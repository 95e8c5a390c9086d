//! `mbs travel`: the force along a slow motion, and mechanical advantage.

use std::path::PathBuf;

use clap::{Args, value_parser};
use mbs_analysis::{Along, Position, Travel, travel};
use mbs_runtime::Info;
use serde_json::{Value, json};

use super::extremes;
use super::inverse::{column, coordinate_range, panels};
use super::json::number;
use super::options::{self, Named, Values, pairs, signed};
use crate::figure::axis;
use crate::figure::{Figure, Save};
use crate::models::Models;
use crate::number::{counted, significant};
use crate::quantity::{self, TIME};
use crate::settings::Start;
use crate::{About, Column, Error, Unit, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs travel metronome --along phi=-180deg..180deg --plot effort.svg
  mbs travel slider-crank-free --along theta1=5deg..175deg --advantage x3 --plot advantage.svg
  mbs travel toggle-press --along actuator=0s..1s --input work=5kN --advantage y3 --out press.csv

Everything rests at every position: springs and gravity act, dampers and friction do not.";

/// Advantages are drawn up to so many times the least one, because they have no bound near a dead centre.
const DRAWN: f64 = 20.0;
/// A change of a force that is no larger than this share of the largest one is rounding.
const ROUNDING: f64 = 1e-12;

#[derive(Args)]
#[command(
    about = "Find the force or the torque along a slow motion over position, and mechanical advantage",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    #[command(flatten)]
    values: Values,
    /// Move this coordinate, or this drive between two times of its law
    #[arg(long, value_name = "NAME=FROM..TO")]
    along: String,
    /// At how many positions [default: 201]
    #[arg(long, value_name = "COUNT", value_parser = value_parser!(u32).range(2..=1_000_000))]
    samples: Option<u32>,
    /// The coordinates along which a load acts, for mechanical advantage
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    advantage: Vec<String>,
    /// Begin on the branch of this value of a coordinate; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    from: Vec<String>,
    /// Hold drives and forces where they are at this time [default: 0s]
    #[arg(long, value_name = "TIME")]
    at: Option<String>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Draw the force over the position
    #[arg(long, value_name = "FILE.svg|.png")]
    plot: Option<PathBuf>,
    /// Write forces, positions, reactions and outputs
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let [plot, out] = [&self.plot, &self.out].map(Option::as_deref);
        options::check_files(None, &[plot], &[out])?;
        let values = self.values.constants("inputs are constants of a slow motion")?;
        let info = model.info();
        let lead = Lead::of(info, &self.along, self.samples.unwrap_or(SAMPLES))?;
        let loads = lead.loads(info, &self.advantage)?;
        let start = Start::of(model, &values.settings(model)?)?;
        let about = About { from: pairs(&self.from)?, at: self.at.clone(), ..About::default() };
        let (run, search) = about.search(model, &start)?;
        let request = Travel {
            along: lead.along.clone(),
            samples: lead.samples.clone(),
            inputs: Some(start.inputs.clone()),
            from: search.from,
            t: search.t,
        };
        let found = travel(run.equations(), &request)?;
        let shown = Shown::of(info, &lead, &loads, &found);
        if let Some(path) = plot {
            shown.figure(&format!("{name}: effort over travel")).save(path)?;
        }
        if let Some(path) = out {
            write_csv(path, &shown.columns)?;
        }
        if self.json {
            return say(shown.json(name));
        }
        let table = extremes::table(name, shown.first());
        say(table.to_string().trim_end())?;
        shown.rests.iter().try_for_each(|rest| say(rest.words(&shown.unit, &lead.name)))?;
        options::say_written([plot, out])
    }
}

const SAMPLES: u32 = 201;

/// The coordinate or the drive that is moved, with its values or its times.
struct Lead {
    along: Along,
    name: String,
    samples: Vec<f64>,
}

impl Lead {
    /// Reads `NAME=FROM..TO`, of so many samples.
    fn of(info: &Info, text: &str, count: u32) -> Result<Self, Error> {
        let (name, range) = quantity::split_setting(text)?;
        let is_drive = info.constraints.iter().any(|row| row.name == name && row.is_drive);
        let [from, to] = if is_drive {
            let wrong = || Error::Value {
                what: name.into(),
                text: range.into(),
                reason: format!(
                    "a drive moves between two times; write {name}=FROM..TO, for instance 0s..1s"
                ),
            };
            let (from, to) = range.split_once("..").ok_or_else(wrong)?;
            [quantity::parse(name, from, TIME)?, quantity::parse(name, to, TIME)?]
        } else {
            coordinate_range(info, text)
                .map_err(|error| match error {
                    Error::Unknown { name, mut known, .. } => {
                        known.extend(
                            info.constraints.iter().filter(|row| row.is_drive).map(|row| row.name.to_owned()),
                        );
                        Error::Unknown { kind: "coordinate or drive", name, known }
                    }
                    other => other,
                })?
                .1
        };
        let at = |at: u32| from + (to - from) * f64::from(at) / f64::from(count - 1);
        let along = if is_drive { Along::Drive(name.to_owned()) } else { Along::Coordinate(name.to_owned()) };
        Ok(Self { along, name: name.to_owned(), samples: (0..count).map(at).collect() })
    }

    /// The coordinates along which loads act.
    fn loads(&self, info: &Info, names: &[String]) -> Result<Vec<usize>, Error> {
        let place = |name: &String| {
            let found = info.coordinates.iter().position(|q| q.name == name);
            found.ok_or_else(|| Error::unknown("coordinate", name, info.coordinates.iter().map(|q| q.name)))
        };
        let places = names.iter().map(place).collect::<Result<Vec<_>, _>>()?;
        // a drive takes the place of a degree of freedom
        let free = match self.along {
            Along::Coordinate(_) => info.dof - 1,
            Along::Drive(_) => info.dof,
        };
        if free > 0 && !places.is_empty() {
            let reason = format!(
                "the mechanism gives way in {} of freedom besides, so that geometry alone gives no mechanical advantage",
                counted(free, "degree")
            );
            return Err(Error::Name { name: "--advantage".into(), reason });
        }
        Ok(places)
    }

    /// The unit of the position and that of the force along it.
    fn units(&self, info: &Info) -> [Unit; 2] {
        let coordinates = info.coordinates.iter().map(|q| (q.name, q.dimension));
        let mut places = coordinates.chain(info.constraints.iter().map(|row| (row.name, row.dimension)));
        let found = places.find(|(name, _)| *name == self.name);
        let dimension = found.map_or(TIME, |(_, dimension)| dimension);
        [Unit::of_place(dimension), Unit::of_multiplier(dimension)]
    }
}

/// A position in which no force is needed.
struct Balance {
    travel: f64,
    is_stable: bool,
}

impl Balance {
    fn words(&self, unit: &str, name: &str) -> String {
        let stable = if self.is_stable { "it is driven back there" } else { "it falls away there" };
        format!("balanced at {name} = {} {unit}: {stable}", significant(self.travel, 6))
    }
}

/// Positions and forces as columns in their units.
struct Shown {
    columns: Vec<Column>,
    /// The first ones: the position, the force, the advantages.
    first: usize,
    unit: String,
    rests: Vec<Balance>,
}

impl Shown {
    fn of(info: &Info, lead: &Lead, loads: &[usize], found: &[Position]) -> Self {
        let [length, force] = lead.units(info);
        let all = |part: fn(&Position) -> &[f64], at: usize| {
            found.iter().map(move |position| part(position).get(at).copied().unwrap_or(f64::NAN))
        };
        let name = match lead.along {
            Along::Coordinate(_) => lead.name.clone(),
            Along::Drive(_) => format!("travel({})", lead.name),
        };
        let mut columns = vec![
            column(name.clone(), &length, found.iter().map(|position| position.travel)),
            column(format!("effort({})", lead.name), &force, found.iter().map(|position| position.effort)),
        ];
        for load in loads {
            let Some(q) = info.coordinates.get(*load) else { continue };
            let advantage = |position: &Position| position.advantage(*load).unwrap_or(f64::NAN);
            let unit = quotient(&Unit::of_multiplier(q.dimension), &force);
            let mut list = Column::new(format!("advantage({})", q.name), unit);
            list.values = found.iter().map(advantage).collect();
            columns.push(list);
        }
        let first = columns.len();
        if matches!(lead.along, Along::Drive(_)) {
            columns.push(column("t".into(), &Unit::si(TIME), found.iter().map(|position| position.t)));
        }
        for (at, q) in info.coordinates.iter().enumerate().filter(|(_, q)| q.name != name) {
            columns.push(column(q.name.into(), &Unit::of_coordinate(q), all(|x| &x.q, at)));
        }
        for (at, row) in info.constraints.iter().enumerate() {
            let unit = Unit::of_multiplier(row.dimension);
            columns.push(column(format!("lambda({})", row.name), &unit, all(|x| &x.multipliers, at)));
        }
        for (at, output) in info.outputs.iter().enumerate() {
            columns.push(column(output.name.into(), &Unit::of(output), all(|x| &x.outputs, at)));
        }
        let rests = match lead.along {
            Along::Coordinate(_) => rests(found),
            Along::Drive(_) => Vec::new(),
        };
        Self { columns, first, unit: length.name().to_owned(), rests }
    }

    fn first(&self) -> impl Iterator<Item = &Column> {
        self.columns.iter().take(self.first)
    }

    fn figure(&self, title: &str) -> Figure {
        let mut first = self.first();
        let Some(x) = first.next() else { return Figure::new(title) };
        let mut figure = Figure::new(title).panel_height(340);
        for column in first {
            let mut drawn = column.clone();
            if column.name.starts_with("advantage(") {
                let least = column.values.iter().fold(f64::INFINITY, |least, x| least.min(x.abs()));
                drawn.values.iter_mut().filter(|x| x.abs() > DRAWN * least).for_each(|x| *x = f64::NAN);
            }
            for panel in panels("", axis(&x.name, &x.unit), &x.values, &[&drawn]) {
                figure = figure.panel(panel);
            }
        }
        figure
    }

    fn json(&self, name: &str) -> Value {
        let values = |column: &Column| {
            let values: Vec<Value> = column.values.iter().map(|x| number(*x)).collect();
            (column.name.clone(), json!({ "unit": column.unit, "values": values }))
        };
        let balance = |rest: &Balance| json!({ "at": number(rest.travel), "is_stable": rest.is_stable });
        json!({
            "mechanism": name,
            "columns": self.columns.iter().map(values).collect::<serde_json::Map<_, _>>(),
            "balanced": self.rests.iter().map(balance).collect::<Vec<_>>(),
        })
    }
}

/// Where the force along a coordinate changes its sign, by straight lines between positions. Where it
/// rises, the mechanism is driven back if nothing holds it.
fn rests(found: &[Position]) -> Vec<Balance> {
    let largest = found.iter().fold(0.0_f64, |largest, position| largest.max(position.effort.abs()));
    let between = |pair: &[Position]| {
        let [a, b] = pair else { return None };
        let is_more_than_rounding = (b.effort - a.effort).abs() > ROUNDING * largest;
        let is_balanced = (a.effort < 0.0) != (b.effort < 0.0) && is_more_than_rounding;
        is_balanced.then(|| {
            let share = a.effort / (a.effort - b.effort);
            let is_stable = (b.effort > a.effort) == (b.travel > a.travel);
            Balance { travel: a.travel + (b.travel - a.travel) * share, is_stable }
        })
    };
    found.windows(2).filter_map(between).collect()
}

/// The unit of an advantage: none between two forces, or two torques.
fn quotient(load: &Unit, force: &Unit) -> String {
    if load.name() == force.name() {
        return String::new();
    }
    // N over N·m, or N·m over N
    if load.name() == "N" { "1/m".into() } else { "m".into() }
}
