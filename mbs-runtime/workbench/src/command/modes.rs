//! `mbs modes`: natural frequencies, damping and mode shapes.

use std::f64::consts::TAU;
use std::path::PathBuf;

use clap::Args;
use mbs_analysis::nalgebra::Complex;
use mbs_analysis::{Linearization, Mode, Ports, Sensitivities, Variable, sensitivities};
use mbs_runtime::Info;
use serde_json::{Map, Value, json};

use super::json::number;
use super::operating::{self, Point};
use super::options;
use super::responses::{Bode, Steps};
use super::shapes::{self, Shapes};
use crate::console::Warnings;
use crate::figure::{Figure, Save};
use crate::models::Models;
use crate::number::significant;
use crate::report::{Block, Report, Section};
use crate::{Error, Operating, PortNames, Table, Unit, names, say};

const EXAMPLES: &str = "\
Examples:
  mbs modes double-pendulum --report modes.html
  mbs modes spring-mass-damper --sensitivity 'stiffness,damping'
  mbs modes cart-pendulum --from theta=170deg --sketch modes.svg";

/// Shapes of more modes are not printed, and of more coordinates those of the states alone.
const MOST_SHAPES: usize = 6;
const MOST_COORDINATES: usize = 12;
/// More modes are neither drawn nor shown in motion.
const MOST_PICTURES: usize = 12;

#[derive(Args)]
#[command(
    about = "Find natural frequencies, damping ratios and mode shapes about an equilibrium or any state",
    after_help = EXAMPLES,
    mut_args(options::signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    point: Point,
    /// How frequencies and damping follow these parameters; '*' for all
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    sensitivity: Option<Vec<String>>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Draw the mode shapes
    #[arg(long, value_name = "FILE.svg|.png")]
    sketch: Option<PathBuf>,
    /// Write a page with the modes in motion and the responses
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<Warnings, Error> {
        let found = self.point.find(models)?;
        let [sketch, report] = [&self.sketch, &self.report].map(Option::as_deref);
        options::check_files(None, &[sketch], &[report])?;
        let operating = self.point.operating(&found)?;
        let linear = operating::linearized(&operating, &PortNames::default())?;
        let modes = linear.modes()?;
        let sensitivities = self.sensitivity.as_ref();
        let sensitivities = sensitivities.map(|patterns| asked(&operating, patterns)).transpose()?;
        let shown = Shown {
            operating: &operating,
            info: operating.info(),
            linear: &linear,
            modes: &modes,
            sensitivities,
        };
        if let Some(path) = sketch {
            shown.sketch()?.save(path)?;
        }
        if let Some(path) = report {
            shown.report()?.save(path)?;
        }
        if self.json {
            say(shown.json())?;
        } else {
            say(format_args!("{}, about {}\n", operating.name, operating::words(&operating)))?;
            let tables = [Some(shown.table()), shown.shapes(), shown.slopes()];
            let texts: Vec<String> = tables.into_iter().flatten().map(|table| table.to_string()).collect();
            say(texts.join("\n").trim_end())?;
            if modes.len() > MOST_SHAPES {
                say("\n--json, --sketch and --report show the shapes")?;
            }
            options::say_written([sketch, report])?;
        }
        Ok(operating::warnings(&linear))
    }
}

/// The sensitivities to parameters that fit the patterns of a command line.
fn asked(operating: &Operating<'_>, patterns: &[String]) -> Result<Sensitivities, Error> {
    if operating.rest.is_none() {
        let reason = "sensitivities are those about an equilibrium, which moves with the parameters; leave --here \
                      and --after out";
        return Err(Error::Name { name: "--sensitivity".into(), reason: reason.into() });
    }
    let known = operating.info().parameters;
    let mut chosen: Vec<String> = Vec::new();
    for pattern in patterns {
        let before = chosen.len();
        let fitting = known.iter().map(|p| p.name).filter(|name| names::fits(pattern, name));
        let fitting: Vec<&str> = fitting.collect();
        if fitting.is_empty() {
            return Err(Error::unknown("parameter", pattern, known.iter().map(|p| p.name)));
        }
        let is_new = |name: &&&str| !chosen[..before].iter().any(|other| other == **name);
        let new: Vec<String> = fitting.iter().filter(is_new).map(|name| (*name).to_owned()).collect();
        chosen.extend(new);
    }
    let mut values = vec![0.0; known.len()];
    operating.run.parameters(&mut values);
    let search = mbs_analysis::Search {
        from: operating.rest.as_ref().map(|rest| rest.q.clone()),
        strategy: mbs_analysis::Strategy::Newton,
        ..operating.search.clone()
    };
    Ok(sensitivities(operating, &values, &search, &Ports::default(), &chosen)?)
}

struct Shown<'a> {
    operating: &'a Operating<'a>,
    info: &'static Info,
    linear: &'a Linearization,
    modes: &'a [Mode],
    sensitivities: Option<Sensitivities>,
}

/// A ratio to six digits, or to as many behind the point.
fn ratio(value: f64) -> String {
    significant((value * 1e9).round() / 1e9, 6)
}

impl Shown<'_> {
    fn table(&self) -> Table {
        let mut table = Table::new([
            "mode",
            "frequency [Hz]",
            "natural frequency [rad/s]",
            "damping ratio",
            "time constant [s]",
            "",
        ]);
        for (at, mode) in self.modes.iter().enumerate() {
            let or_none = |value: f64, has: bool| if has { significant(value, 7) } else { "–".into() };
            table.row([
                (at + 1).to_string(),
                or_none(mode.damped_frequency() / TAU, mode.damped_frequency() > 0.0),
                or_none(mode.natural_frequency(), mode.natural_frequency() > 0.0),
                mode.damping_ratio().map_or_else(|| "–".into(), ratio),
                or_none(mode.time_constant(), mode.eigenvalue.re != 0.0),
                mode.behaviour.words().to_owned(),
            ]);
        }
        table
    }

    /// Positions of the coordinates whose components are printed.
    fn coordinates(&self) -> Vec<usize> {
        let all = self.info.coordinates.len();
        if all > MOST_COORDINATES {
            Shapes::new(self.operating, &self.linear.states).independent
        } else {
            (0..all).collect()
        }
    }

    fn shapes(&self) -> Option<Table> {
        if self.modes.len() > MOST_SHAPES {
            return None;
        }
        let numbers = (1..=self.modes.len()).map(|number| format!("mode {number}"));
        let mut table = Table::new(["shape".to_owned()].into_iter().chain(numbers).chain([String::new()]));
        for at in self.coordinates() {
            let coordinate = self.info.coordinates.get(at)?;
            let components = self.modes.iter().map(|mode| component(mode.shape[at]));
            // shapes are ratios of SI units
            let unit = match self.info.is_own(at) {
                true => Unit::si(coordinate.dimension),
                false => Unit::of_place(coordinate.dimension),
            };
            let unit = unit.name().to_owned();
            table.row([coordinate.name.to_owned()].into_iter().chain(components).chain([unit]));
        }
        Some(table)
    }

    /// How frequencies and damping follow parameters.
    fn slopes(&self) -> Option<Table> {
        let found = self.sensitivities.as_ref()?;
        let mut table = Table::new([
            "sensitivity",
            "mode",
            "natural frequency [rad/s]",
            "% per %",
            "damping ratio",
            "per",
        ]);
        for (column, parameter) in found.parameters.iter().enumerate() {
            let unit = Unit::of_signal(self.info, parameter);
            let value = self.value(parameter.variable);
            for (row, mode) in found.modes.iter().enumerate() {
                let (omega, zeta) = (found.natural_frequency(row, column), found.damping_ratio(row, column));
                if omega.is_nan() {
                    continue;
                }
                let small = |x: f64, of: f64| if x.abs() < 1e-8 * of { 0.0 } else { x };
                // what is less than rounding, of a change by the parameter itself
                let reach = if value == 0.0 { 1.0 } else { value.abs() };
                let omega = small(omega, mode.natural_frequency() / reach);
                let zeta = small(zeta, 1.0 / reach);
                table.row([
                    parameter.name.clone(),
                    (row + 1).to_string(),
                    significant(omega * unit.read(1.0), 6),
                    significant(omega * value / mode.natural_frequency(), 6),
                    significant(zeta * unit.read(1.0), 6),
                    if unit.name().is_empty() { "1".into() } else { unit.name().to_owned() },
                ]);
            }
        }
        Some(table)
    }

    fn value(&self, variable: Variable) -> f64 {
        let mut parameters = vec![0.0; self.info.parameters.len()];
        self.operating.run.parameters(&mut parameters);
        self.linear.point.value(variable, &parameters)
    }

    fn drawn(&self) -> Result<Shapes<'_>, Error> {
        let shapes = Shapes::new(self.operating, &self.linear.states);
        if shapes.can_draw() {
            return Ok(shapes);
        }
        let reason = "it has no points to draw: its bodies have no places in the plane";
        Err(Error::Name { name: self.operating.name.to_owned(), reason: reason.into() })
    }

    fn sketch(&self) -> Result<Figure, Error> {
        let modes = &self.modes[..self.modes.len().min(MOST_PICTURES)];
        let title = format!("{}: mode shapes", self.operating.name);
        Ok(self.drawn()?.figure(&title, modes, |at| shapes::title(at, &modes[at])))
    }

    /// The modes in motion, tables, and the responses of a mechanism with inputs.
    fn report(&self) -> Result<Report, Error> {
        let name = self.operating.name;
        let mut modes = Section::new("Modes").with(Block::Table(self.table()));
        if let Ok(shapes) = self.drawn() {
            for (at, mode) in self.modes.iter().enumerate().take(MOST_PICTURES) {
                modes = modes.with(Block::Animation(shapes.animation(mode, shapes::title(at, mode))));
            }
        }
        if self.modes.len() > MOST_PICTURES {
            modes = modes.text(format!("The first {MOST_PICTURES} modes are shown in motion."));
        }
        let mut tables = Section::new("Shapes");
        if let Some(table) = self.shapes() {
            let what = "Components of the coordinates, an amplitude and a phase where they are not in step; the state \
                        that moves most is 1. In motion the amplitude is one that can be seen.";
            tables = tables.text(what).with(Block::Table(table));
        }
        let mut sections = vec![modes];
        sections.extend((!tables.blocks.is_empty()).then_some(tables));
        if let Some(table) = self.slopes() {
            sections.push(Section::new("Sensitivities").with(Block::Table(table)));
        }
        if !self.linear.inputs.is_empty() {
            let figure = |figure: Figure, caption: &str| Block::Figure {
                figure,
                caption: caption.into(),
                files: Vec::new(),
            };
            let bode = Bode::of(self.info, self.linear, None)?;
            let steps = Steps::of(self.info, self.linear, None)?;
            let caption = bode.remark().unwrap_or("Magnitude and phase of outputs, per unit of an input.");
            sections.push(
                Section::new("Frequency response")
                    .with(Block::Table(bode.table(name)))
                    .with(figure(bode.figure(name), caption)),
            );
            let caption =
                "Deviations from the operating point after an input has grown by one unit at t = 0.";
            sections.push(Section::new("Step response").with(figure(steps.figure(name), caption)));
        }
        let lead =
            format!("{} Small motions about {}.", self.info.doc.trim(), operating::words(self.operating));
        Ok(Report { title: format!("{name}: modes"), lead, sections })
    }

    fn json(&self) -> Value {
        let complex = |x: Complex<f64>| json!([number(x.re), number(x.im)]);
        let shape = |mode: &Mode| -> Map<String, Value> {
            let named = self.info.coordinates.iter().zip(mode.shape.iter());
            named.map(|(coordinate, x)| (coordinate.name.to_owned(), complex(*x))).collect()
        };
        let slopes = |row: usize| -> Map<String, Value> {
            let Some(found) = &self.sensitivities else { return Map::new() };
            let slope = |(column, parameter): (usize, &mbs_analysis::Signal)| {
                let slopes = json!({
                    "natural_frequency_rad_s": number(found.natural_frequency(row, column)),
                    "damping_ratio": number(found.damping_ratio(row, column)),
                    "per": Unit::si(parameter.dimension).name(),
                });
                (parameter.name.clone(), slopes)
            };
            found.parameters.iter().enumerate().map(slope).collect()
        };
        let mode = |(row, mode): (usize, &Mode)| {
            let mut value = json!({
                "frequency_Hz": number(mode.damped_frequency() / TAU),
                "natural_frequency_rad_s": number(mode.natural_frequency()),
                "damping_ratio": mode.damping_ratio().map(number),
                "eigenvalue_1_s": complex(mode.eigenvalue),
                "behaviour": mode.behaviour.words(),
                "is_unstable": mode.behaviour.is_unstable(),
                "shape": shape(mode),
            });
            if self.sensitivities.is_some() {
                value["sensitivities"] = Value::Object(slopes(row));
            }
            value
        };
        json!({
            "mechanism": self.operating.name,
            "about": operating::words(self.operating),
            "t_s": number(self.linear.point.t),
            "modes": self.modes.iter().enumerate().map(mode).collect::<Vec<_>>(),
            "uncertainty": number(self.linear.uncertainty),
        })
    }
}

/// A number, or an amplitude and a phase where it is not real.
fn component(x: Complex<f64>) -> String {
    if x.im == 0.0 {
        return significant(x.re, 5);
    }
    format!("{} at {}°", significant(x.norm(), 5), significant(x.arg().to_degrees(), 4))
}
