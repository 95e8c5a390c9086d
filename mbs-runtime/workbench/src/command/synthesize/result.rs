//! Results of a synthesis: as a table, for scripts, as columns and as pictures.

use mbs_analysis::{Defect, Linkage, Synthesis, Task};
use mbs_runtime::System;
use mbs_runtime::equations::At;
use serde_json::{Value, json};

use crate::command::json::number;
use crate::figure::axis;
use crate::figure::{Figure, Panel, Series, Stroke};
use crate::number::significant;
use crate::settings::Start;
use crate::{Column, Error, Model, Motion, Picture, StartKind, Table, Unit};

/// Mechanisms that stand beside each other in a table.
const BESIDE: usize = 4;
/// Poses and points of a path that are drawn.
const DRAWN: usize = 400;

/// A synthesis and what was asked.
pub(super) struct Shown<'a> {
    pub name: &'a str,
    pub model: &'a dyn Model,
    pub task: &'a Task,
    /// The units of the columns.
    pub units: &'a [Unit],
    pub synthesis: &'a Synthesis,
}

impl Shown<'_> {
    /// The best mechanism.
    ///
    /// # Errors
    /// Why there is none.
    pub fn best(&self) -> Result<&Linkage, Error> {
        self.synthesis.linkages.first().ok_or_else(|| {
            let Synthesis { starts, nearest, .. } = self.synthesis;
            let refused: usize = self.synthesis.refused.iter().map(|(_, count)| count).sum();
            let reason = if refused > 0 {
                format!("{}; other --seed, more --starts or wider --param may lead to one without", self.refused())
            } else if nearest.is_finite() {
                format!(
                    "the nearest misses a value by {} (SI, m or rad); widen --param, make more --starts, or allow a \
                     --tolerance",
                    significant(*nearest, 3)
                )
            } else {
                "none comes near all positions; widen --param, make more --starts, or ask for fewer positions".into()
            };
            Error::NoLinkage { reason: format!("of {starts} starts, {reason}") }
        })
    }

    fn parameters(&self) -> impl Iterator<Item = (&str, Unit)> {
        let parameters = self.model.info().parameters;
        self.task.unknown.iter().filter_map(move |unknown| {
            let found = parameters.iter().find(|parameter| parameter.name == unknown.name)?;
            Some((unknown.name.as_str(), Unit::of(found)))
        })
    }

    fn refused(&self) -> String {
        let words = self.synthesis.refused.iter().filter(|(_, count)| *count > 0).map(|(defect, count)| {
            let what = match defect {
                Defect::Circuit => "with positions on another circuit",
                Defect::Order => "that pass them in another order",
                Defect::Branch => "with a dead centre of the drive on the way",
            };
            format!("{count} {what}")
        });
        let words: Vec<String> = words.collect();
        if words.is_empty() { "none was refused".into() } else { format!("refused: {}", words.join(", ")) }
    }

    /// The best mechanisms beside each other.
    pub fn table(&self) -> String {
        let linkages = &self.synthesis.linkages;
        let shown = linkages.get(..BESIDE.min(linkages.len())).unwrap_or_default();
        let numbers =
            (1..=shown.len()).map(|number| if number == 1 { "best".into() } else { number.to_string() });
        let mut table = Table::new(std::iter::once(self.name.to_owned()).chain(numbers));
        for (at, (name, unit)) in self.parameters().enumerate() {
            let values = shown.iter().map(|linkage| unit.text(linkage.values[at], 8));
            table.row(std::iter::once(name.to_owned()).chain(values));
        }
        let missed = shown.iter().map(|linkage| significant(linkage.missed, 2));
        table.row(std::iter::once("misses a value by (SI)".to_owned()).chain(missed));
        let Synthesis { starts, linkages, .. } = self.synthesis;
        let others = if linkages.len() == 1 { "mechanism" } else { "mechanisms" };
        format!("{table}\n{} {others} of {starts} starts; {}\n", linkages.len(), self.refused())
    }

    /// For scripts.
    pub fn json(&self) -> Value {
        let linkage = |linkage: &Linkage| {
            let values = self.parameters().zip(&linkage.values).map(|((name, unit), value)| {
                (name.to_owned(), json!({ "value": number(unit.shown(*value)), "unit": unit.name() }))
            });
            json!({
                "parameters": values.collect::<serde_json::Map<_, _>>(),
                "missed": number(linkage.missed),
                "count": linkage.count,
                "positions": linkage.coordinates,
            })
        };
        let refused = self.synthesis.refused.iter().map(|(defect, count)| {
            let word = match defect {
                Defect::Circuit => "circuit",
                Defect::Order => "order",
                Defect::Branch => "branch",
            };
            (word.to_owned(), json!(count))
        });
        json!({
            "mechanism": self.name,
            "linkages": self.synthesis.linkages.iter().map(linkage).collect::<Vec<_>>(),
            "refused": refused.collect::<serde_json::Map<_, _>>(),
            "starts": self.synthesis.starts,
            "nearest": number(self.synthesis.nearest),
        })
    }

    /// The coordinates on the way.
    pub fn columns(&self, best: &Linkage) -> Vec<Column> {
        let coordinates = self.model.info().coordinates.iter().enumerate();
        let column = |(at, q): (usize, &mbs_runtime::Quantity)| {
            let unit = Unit::of_coordinate(q);
            let places = best.path.iter().filter_map(|place| place.get(at));
            Column { values: places.map(|x| unit.shown(*x)).collect(), ..Column::new(q.name, unit.name()) }
        };
        coordinates.map(column).collect()
    }

    /// A run of the mechanism that was found, of which places are asked.
    fn found(&self, best: &Linkage) -> Result<Box<dyn System>, Error> {
        let info = self.model.info();
        let mut parameters = self.task.parameters.clone();
        for (unknown, value) in self.task.unknown.iter().zip(&best.values) {
            let place = info.parameters.iter().position(|parameter| parameter.name == unknown.name);
            if let Some(place) = place.and_then(|place| parameters.get_mut(place)) {
                *place = *value;
            }
        }
        let start = Start::of(self.model, &self.model.defaults())?;
        Ok(self.model.start(&Start { parameters, kind: StartKind::Declared, ..start })?)
    }

    /// The values of the columns on the way, in their units.
    fn values(&self, best: &Linkage) -> Result<Vec<Vec<f64>>, Error> {
        let run = self.found(best)?;
        let info = self.model.info();
        let still = vec![0.0; info.coordinates.len()];
        let multipliers = vec![0.0; info.constraints.len()];
        let inputs: Vec<f64> = info.inputs.iter().map(|input| input.default).collect();
        let mut outputs = vec![0.0; info.outputs.len()];
        let mut columns = vec![Vec::new(); self.task.columns.len()];
        for q in &best.path {
            let at = At { t: 0.0, q: q.as_slice(), v: &still };
            run.equations().outputs(at, &inputs, [&still, &multipliers], &mut outputs);
            for ((column, name), unit) in columns.iter_mut().zip(&self.task.columns).zip(self.units) {
                let coordinate = info.coordinates.iter().position(|q| q.name == name);
                let output = info.outputs.iter().position(|output| output.name == name);
                let value = coordinate.and_then(|at| q.get(at)).or(output.and_then(|at| outputs.get(at)));
                column.push(value.map_or(f64::NAN, |value| unit.shown(*value)));
            }
        }
        Ok(columns)
    }

    /// A figure of the task and of the mechanism: one quantity over the other where there are two.
    pub fn figure(&self, best: &Linkage) -> Result<Figure, Error> {
        let values = self.values(best)?;
        let asked = |column: usize| -> Vec<f64> {
            let value = |row: &Vec<Option<f64>>| row.get(column).copied().flatten();
            let unit = self.units.get(column);
            let shown = |value: f64| unit.map_or(value, |unit| unit.shown(value));
            self.task.positions.iter().map(|row| value(row).map_or(f64::NAN, shown)).collect()
        };
        let label = |column: usize| {
            let unit = self.units.get(column).map_or("", Unit::name);
            axis(self.task.columns.get(column).map_or("", String::as_str), unit)
        };
        let mut figure = Figure::new(format!("{}: synthesized", self.name));
        // the first column is what the others are drawn over
        for column in 1..self.task.columns.len() {
            let path = Series::xy("mechanism", &values[0], &values[column]);
            let asked = Series::xy("asked for", &asked(0), &asked(column)).stroke(Stroke::Points);
            figure = figure.panel(Panel::lines(label(0), label(column), [path, asked]));
        }
        Ok(figure)
    }

    /// The mechanism in poses on its way.
    pub fn sketch(&self, best: &Linkage) -> Result<Figure, Error> {
        let run = self.found(best)?;
        let sketch = self.model.sketch();
        let every = best.path.len().div_ceil(DRAWN).max(1);
        let mut motion = Motion { sketch, times: Vec::new(), places: Vec::new() };
        for (number, q) in best.path.iter().step_by(every).enumerate() {
            let mut points = vec![0.0; 2 * sketch.points.len()];
            run.points(0.0, q, &mut points);
            motion.times.push(number as f64);
            motion.places.push(points.chunks_exact(2).map(|point| [point[0], point[1]]).collect());
        }
        Ok(Figure::mechanism(format!("{}: synthesized", self.name), Picture::of(&motion)))
    }
}
