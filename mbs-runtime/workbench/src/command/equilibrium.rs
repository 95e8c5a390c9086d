//! `mbs equilibrium`: where a mechanism rests, and whether it stays there.

use std::path::PathBuf;

use clap::Args;
use mbs_analysis::{Equilibrium, OperatingPoint, Stability, equilibrium};
use mbs_runtime::equations::At;
use mbs_runtime::{Info, System};
use serde_json::{Map, Value, json};

use super::json::number;
use super::options::{self, Named, Values, pairs, signed};
use crate::console::complain;
use crate::figure::{Figure, Save};
use crate::models::Models;
use crate::notes::held;
use crate::number::significant;
use crate::settings::Start;
use crate::{About, Error, Motion, Picture, Table, Unit, say};

const EXAMPLES: &str = "\
Examples:
  mbs equilibrium double-pendulum
  mbs equilibrium double-pendulum --from angle1=170deg --sketch rest.svg
  mbs equilibrium my.mbs --set k=2N/mm --relax";

#[derive(Args)]
#[command(
    about = "Find where a mechanism rests, its reactions there, and whether that is stable",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    #[command(flatten)]
    values: Values,
    /// Begin with this value of a coordinate; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    from: Vec<String>,
    /// Hold drives and forces where they are at this time [default: 0s]
    #[arg(long, value_name = "TIME")]
    at: Option<String>,
    /// Go where the mechanism would come to rest, past unstable equilibria
    #[arg(long)]
    relax: bool,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Draw the mechanism where it rests
    #[arg(long, value_name = "FILE.svg|.png")]
    sketch: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let sketch = self.sketch.as_deref();
        options::check_files(None, &[sketch], &[])?;
        let values = self.values.constants("inputs that change with time have no equilibrium")?;
        let start = Start::of(model, &values.settings(model)?)?;
        held(model.info()).into_iter().for_each(|note| complain(format_args!("note: {note}")));
        let from = pairs(&self.from)?;
        let about = About { from, at: self.at.clone(), is_relaxed: self.relax, ..About::default() };
        let (run, search) = about.search(model, &start)?;
        let rest = equilibrium(run.equations(), &search)?;
        let shown = Found::of(name, model.info(), &*run, &rest);
        if let Some(path) = sketch {
            Figure::mechanism(name, Picture::of(&still(&*run, model.sketch(), &rest))).save(path)?;
        }
        if self.json {
            return say(shown.json());
        }
        say(shown.table().to_string().trim_end())?;
        options::say_written([sketch])
    }
}

/// A motion of one instant.
fn still(run: &dyn System, sketch: &'static mbs_runtime::Sketch, rest: &Equilibrium) -> Motion {
    let mut points = vec![0.0; 2 * sketch.points.len()];
    run.points(rest.t, &rest.q, &mut points);
    let places = points.chunks_exact(2).map(|point| [point[0], point[1]]).collect();
    Motion { sketch, times: vec![rest.t], places: vec![places] }
}

/// An equilibrium as it is shown: names, values in SI units, and the units that they are shown in.
struct Found<'a> {
    name: &'a str,
    rest: &'a Equilibrium,
    coordinates: Vec<(&'static str, f64, Unit)>,
    states: Vec<(&'static str, f64, Unit)>,
    outputs: Vec<(&'static str, f64, Unit)>,
    reactions: Vec<(&'static str, f64, Unit)>,
    /// The forces of stops.
    rests: Vec<(&'static str, f64, Unit)>,
    potential_energy: f64,
}

impl<'a> Found<'a> {
    fn of(name: &'a str, info: &'static Info, run: &dyn System, rest: &'a Equilibrium) -> Self {
        let (still, point) = (vec![0.0; rest.q.len()], OperatingPoint::from(rest));
        let at = At { t: rest.t, q: &point.q, v: &point.v };
        let mut outputs = vec![f64::NAN; info.outputs.len()];
        run.equations().outputs(at, &rest.inputs, [&still, &rest.multipliers], &mut outputs);
        let coordinates = info.coordinates.iter().zip(&rest.q);
        let reactions = info.constraints.iter().zip(&rest.multipliers);
        let reactions = reactions.map(|(row, x)| (row.name, *x, Unit::of_multiplier(row.dimension)));
        let of_modes = rest.held.iter().map(|(at, multiplier)| {
            let lock = &info.modes.locks[*at];
            (lock.name, *multiplier, Unit::of(&info.inputs[lock.held]))
        });
        Self {
            name,
            rest,
            coordinates: coordinates
                .clone()
                .take(info.lines)
                .map(|(q, x)| (q.name, *x, Unit::of_coordinate(q)))
                .collect(),
            states: coordinates.skip(info.lines).map(|(z, x)| (z.name, *x, Unit::of(z))).collect(),
            outputs: info.outputs.iter().zip(&outputs).map(|(o, x)| (o.name, *x, Unit::of(o))).collect(),
            reactions: reactions.chain(of_modes).collect(),
            rests: rest
                .rests
                .iter()
                .map(|(at, force)| (&info.stops[*at], *force))
                .map(|(stop, force)| (stop.name, force, Unit::of_multiplier(stop.dimension)))
                .collect(),
            potential_energy: run.energies(at)[1],
        }
    }

    /// The stability of the equilibrium, in words.
    fn stability(&self) -> String {
        match self.rest.stability() {
            Stability::Stable if self.rest.stiffness.is_empty() && self.states.is_empty() => {
                "held: nothing is free to move".into()
            }
            Stability::Stable => "stable".into(),
            Stability::Indifferent => "indifferent: some displacements are not driven back".into(),
            Stability::Unstable { directions: 1 } if !self.states.is_empty() => {
                "unstable: a deviation grows".into()
            }
            Stability::Unstable { directions } if !self.states.is_empty() => {
                format!("unstable: {directions} deviations grow")
            }
            Stability::Unstable { directions: 1 } => "unstable: it falls away in one direction".into(),
            Stability::Unstable { directions } => {
                format!("unstable: it falls away in {directions} directions")
            }
        }
    }

    fn table(&self) -> Table {
        let mut table = Table::new([self.name, "at rest", ""]);
        table.row(["stability", self.stability().as_str()]);
        if let Stability::Unstable { .. } = self.rest.stability() {
            table.row(["", "--relax finds where it falls to"]);
        }
        for list in [&self.coordinates, &self.states, &self.outputs] {
            for (name, value, unit) in list {
                table.row([*name, &significant(unit.shown(chopped(*value, list)), 8), unit.name()]);
            }
        }
        for (name, value, unit) in &self.reactions {
            let value = significant(unit.shown(chopped(*value, &self.reactions)), 6);
            table.row([&format!("lambda({name})"), &value, unit.name()]);
        }
        for (name, force, unit) in &self.rests {
            table.row([&format!("rests on {name}"), &significant(unit.shown(*force), 6), unit.name()]);
        }
        table.row(["potential energy", &significant(self.potential_energy, 6), "J"]);
        for (at, stiffness) in self.rest.stiffness.iter().enumerate() {
            table.row([&format!("stiffness {} over mass", at + 1), &significant(*stiffness, 6), "1/s^2"]);
        }
        table
    }

    fn json(&self) -> Value {
        let of = |list: &[(&'static str, f64, Unit)]| -> Map<String, Value> {
            let value = |x: f64, unit: &Unit| json!({ "value": number(unit.shown(x)), "unit": unit.name() });
            list.iter().map(|(name, x, unit)| ((*name).to_owned(), value(*x, unit))).collect()
        };
        json!({
            "mechanism": self.name,
            "t_s": number(self.rest.t),
            "stability": self.stability(),
            "is_stable": self.rest.is_stable(),
            "coordinates": of(&self.coordinates),
            "states": of(&self.states),
            "outputs": of(&self.outputs),
            "multipliers": of(&self.reactions),
            "rests": of(&self.rests),
            "potential_energy_J": number(self.potential_energy),
            "stiffness_1_s2": self.rest.stiffness.iter().map(|x| number(*x)).collect::<Vec<_>>(),
            "iterations": self.rest.iterations,
        })
    }
}

/// 0 for what is a rounding of the others.
fn chopped(value: f64, others: &[(&'static str, f64, Unit)]) -> f64 {
    let largest = others.iter().fold(0.0_f64, |largest, (_, x, _)| largest.max(x.abs()));
    if value.abs() < 1e-13 * largest { 0.0 } else { value }
}
