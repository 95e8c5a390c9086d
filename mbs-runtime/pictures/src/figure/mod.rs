//! Figures: what is shown, apart from how it is drawn.
//!
//! A [`Figure`] is a title and panels stacked on top of each other; a
//! [`Panel`] is a pair of axes with lines or a heat map. It is drawn as SVG or
//! PNG.

mod canvas;
mod colour;
mod columns;
mod contour;
mod draw;
mod gif;
mod icon;
mod labels;
mod layout;
mod lines;
mod map;
mod mechanism;
mod output;
mod palette;
mod ticks;

pub use colour::{SERIES_COLOURS, colour_map};
pub use gif::{Drawn, gif};
pub use icon::icon;

use crate::picture::Picture;

/// A picture of one or more panels.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The title over everything.
    pub title: String,
    /// The panels, from top to bottom.
    pub panels: Vec<Panel>,
    /// Height of a panel in pixels; the width is 900.
    pub panel_height: u32,
}

impl Figure {
    /// A figure without panels.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), panels: Vec::new(), panel_height: 480 }
    }

    /// With one more panel below the others.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// With this height of every panel, in pixels.
    #[must_use]
    pub fn panel_height(mut self, pixels: u32) -> Self {
        self.panel_height = pixels;
        self
    }
}

/// A pair of axes and what is drawn on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The curves, the map or the mechanism on them.
    pub content: Content,
    /// Where ticks at the upper edge mark something, such as events of a run.
    pub marks: Vec<f64>,
}

/// The content of a panel.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Curves.
    Lines(Vec<Series>),
    /// A quantity over a plane, as colours and contour lines.
    Map(HeatMap),
    /// A mechanism at the start of its motion, with later poses behind it; both
    /// axes have the same scale.
    Mechanism(Picture),
}

impl Panel {
    /// A panel of curves.
    pub fn lines(x: Axis, y: Axis, series: impl IntoIterator<Item = Series>) -> Self {
        Self { x, y, content: Content::Lines(series.into_iter().collect()), marks: Vec::new() }
    }

    /// A panel with a mechanism.
    pub fn mechanism(picture: Picture) -> Self {
        let axis = |label: &str| Axis::new(label, "m");
        Self { x: axis("x"), y: axis("y"), content: Content::Mechanism(picture), marks: Vec::new() }
    }

    /// A panel with a heat map.
    pub fn map(x: Axis, y: Axis, map: HeatMap) -> Self {
        Self { x, y, content: Content::Map(map), marks: Vec::new() }
    }

    /// With ticks at the upper edge.
    #[must_use]
    pub fn marked(self, marks: impl IntoIterator<Item = f64>) -> Self {
        Self { marks: marks.into_iter().collect(), ..self }
    }
}

/// An axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// The quantity that it measures, such as `‖Φ‖`.
    pub label: String,
    /// The unit; may be empty.
    pub unit: String,
    /// True if it is logarithmic.
    pub log: bool,
    /// The range to show; by default that of the data.
    pub range: Option<(f64, f64)>,
    /// The distance of labelled ticks that is a unit of its own, such as a quarter of a turn; multiples and
    /// simple parts of it are taken where there is more or less room. By default powers of ten.
    pub unit_tick: Option<f64>,
}

/// The axis for values called `name` in a unit, in the letters of a picture.
pub fn axis(name: &str, unit: &str) -> Axis {
    Axis::new(name.replace('_', " "), unit.replace('*', "·"))
}

impl Axis {
    /// A linear axis over the range of the data.
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), log: false, range: None, unit_tick: None }
    }

    /// The same, logarithmic.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.log = true;
        self
    }

    /// The same, from `low` to `high`.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// The same, with ticks at multiples and simple parts of this.
    #[must_use]
    pub fn ticks_of(mut self, distance: f64) -> Self {
        self.unit_tick = Some(distance);
        self
    }

    /// `label (unit)`, or the label alone where there is no unit.
    pub fn heading(&self) -> String {
        if self.unit.is_empty() { self.label.clone() } else { format!("{} ({})", self.label, self.unit) }
    }
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stroke {
    /// A solid line.
    #[default]
    Solid,
    /// A dashed line.
    Dashed,
    /// A line with a dot at every point.
    Dotted,
    /// A dot at every point, and no line: measured values.
    Points,
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Its points; the line is broken where one is not finite.
    pub points: Vec<[f64; 2]>,
    /// The way in which it is drawn.
    pub stroke: Stroke,
}

impl Series {
    /// A solid curve.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), stroke: Stroke::Solid }
    }

    /// A solid curve through (x, y) pairs of two equally long slices.
    pub fn xy(name: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self::new(name, x.iter().zip(y).map(|(&x, &y)| [x, y]))
    }

    /// The same, drawn otherwise.
    #[must_use]
    pub fn stroke(mut self, stroke: Stroke) -> Self {
        self.stroke = stroke;
        self
    }
}

/// A quantity on a rectangular grid.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// The columns' abscissae, ascending.
    pub x: Vec<f64>,
    /// The rows' ordinates, ascending.
    pub y: Vec<f64>,
    /// The values, row after row; positive on a logarithmic scale.
    pub values: Vec<f64>,
    /// The quantity that is shown, and the kind of its scale.
    pub scale: Axis,
}

impl HeatMap {
    /// The value in a column and a row; NaN outside.
    pub fn value(&self, column: usize, row: usize) -> f64 {
        if column >= self.x.len() {
            return f64::NAN;
        }
        self.values.get(row * self.x.len() + column).copied().unwrap_or(f64::NAN)
    }
}
