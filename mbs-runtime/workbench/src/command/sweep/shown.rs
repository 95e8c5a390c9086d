//! Output of a sweep: a table, a picture, a summary for scripts.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::json;

use super::Sweep;
use super::axis::GridAxis;
use super::watched::Watched;
use crate::command::options::say_written;
use crate::figure::{Figure, HeatMap, Panel, Series, Stroke};
use crate::number::significant;
use crate::{Error, Table, figure, say};

impl Sweep<'_> {
    /// Prints where what is shown is smallest and largest, and which files were written.
    pub(super) fn say_summary(&self, files: &[PathBuf]) -> Result<(), Error> {
        if self.json {
            return say(self.json(files));
        }
        say(self.summary().to_string().trim_end())?;
        say_written(files.iter().map(|path| Some(path.as_path())))
    }

    /// The quantity at the run where it is smallest, and where it is largest.
    fn extremes<'v>(&self, values: &'v [f64]) -> [Option<(usize, &'v f64)>; 2] {
        let seen = || values.iter().enumerate().filter(|(_, value)| value.is_finite());
        [seen().min_by(|a, b| a.1.total_cmp(b.1)), seen().max_by(|a, b| a.1.total_cmp(b.1))]
    }

    fn json(&self, files: &[PathBuf]) -> serde_json::Value {
        let at = |(index, value): (usize, &f64)| {
            let place = self.grid.axes.iter().zip(self.grid.shown_values(index));
            let place = place.map(|(axis, x)| (axis.name, json!({ "value": x, "unit": axis.unit.name() })));
            json!({ "value": value, "at": place.collect::<BTreeMap<_, _>>() })
        };
        let quantity = |(quantity, values): (&Watched, &Vec<f64>)| {
            let [low, high] = self.extremes(values).map(|place| place.map(at));
            let unit = quantity.unit.name();
            (
                quantity.name,
                json!({ "shown": self.shown.word(), "unit": unit, "smallest": low, "largest": high }),
            )
        };
        let quantities = self.watched.iter().zip(&self.values).map(quantity);
        json!({
            "runs": self.grid.count(), "failed": self.failures,
            "quantities": quantities.collect::<BTreeMap<_, _>>(),
            "files": files.iter().map(|path| path.display().to_string()).collect::<Vec<_>>(),
        })
    }

    /// Where what is shown is smallest and largest.
    fn summary(&self) -> Table {
        let heading = |which: &str| format!("{which} {}", self.shown.word());
        let mut table = Table::new(["", &heading("smallest"), "at", &heading("largest"), "at"]);
        for (quantity, values) in self.watched.iter().zip(&self.values) {
            let [low, high] = self.extremes(values);
            let cells = |place: Option<(usize, &f64)>| match place {
                Some((at, value)) => {
                    let value = format!("{} {}", significant(*value, 6), quantity.unit.name());
                    [value.trim_end().to_owned(), self.grid.place(at)]
                }
                None => [const { String::new() }; 2],
            };
            table.row([quantity.name.to_owned()].into_iter().chain(cells(low)).chain(cells(high)));
        }
        table
    }

    /// Curves over one parameter, heat maps over two.
    pub(super) fn figure(&self, name: &str) -> Figure {
        let axis = |axis: &GridAxis| figure::axis(axis.name, axis.unit.name());
        let shown = self.shown.word();
        let value =
            |quantity: &Watched| figure::axis(&format!("{shown} {}", quantity.name), quantity.unit.name());
        let panel = |(quantity, values): (&Watched, &Vec<f64>)| match self.grid.axes.as_slice() {
            [x, y] => {
                let map = HeatMap {
                    x: x.shown_values(),
                    y: y.shown_values(),
                    values: values.clone(),
                    scale: value(quantity),
                };
                Panel::map(axis(x), axis(y), map)
            }
            axes => {
                let x = axes.first().map(GridAxis::shown_values).unwrap_or_default();
                let curve = Series::xy("", &x, values).stroke(Stroke::Dotted);
                Panel::lines(axes.first().map(axis).unwrap_or_default(), value(quantity), [curve])
            }
        };
        let panels = self.watched.iter().zip(&self.values).map(panel);
        panels.fold(Figure::new(format!("{name}: sweep")), Figure::panel)
    }
}
