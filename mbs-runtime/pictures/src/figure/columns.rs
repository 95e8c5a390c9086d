//! The numbers behind a figure, as columns of a table.

use super::{Axis, Content, Figure, HeatMap, Panel};
use crate::Column;

impl Figure {
    /// Everything that the figure shows, at full precision: for curves an
    /// abscissa (shared by curves that have the same) and a column each, for a
    /// heat map one row per cell. Names are in plain ASCII.
    pub fn columns(&self) -> Vec<Column> {
        let mut columns = Vec::new();
        for panel in &self.panels {
            match &panel.content {
                Content::Lines(_) => add_curves(panel, &mut columns),
                Content::Map(map) => add_cells(panel, map, &mut columns),
                // Its points are those of the recording.
                Content::Mechanism(_) => {}
            }
        }
        columns
    }
}

fn column(axis: &Axis, name: &str, values: Vec<f64>) -> Column {
    let name = if name.is_empty() { &axis.label } else { name };
    Column { name: plain(name), unit: plain(&axis.unit), values }
}

fn add_curves(panel: &Panel, columns: &mut Vec<Column>) {
    let Content::Lines(series) = &panel.content else { return };
    for curve in series {
        let abscissa = column(&panel.x, "", curve.points.iter().map(|p| p[0]).collect());
        // The last abscissa is the one that a reader takes to belong to the columns after it.
        let current = columns.iter().rfind(|c| c.name == abscissa.name);
        if current.is_none_or(|c| c.values != abscissa.values) {
            columns.push(abscissa);
        }
        let ordinate = column(&panel.y, &curve.name, curve.points.iter().map(|p| p[1]).collect());
        if !columns.contains(&ordinate) {
            columns.push(ordinate);
        }
    }
}

fn add_cells(panel: &Panel, map: &HeatMap, columns: &mut Vec<Column>) {
    let x = map.y.iter().flat_map(|_| map.x.iter().copied()).collect();
    let y = map.y.iter().flat_map(|y| map.x.iter().map(|_| *y)).collect();
    columns.push(column(&panel.x, "", x));
    columns.push(column(&panel.y, "", y));
    columns.push(column(&map.scale, "", map.values.clone()));
}

/// Greek letters spelt out, mathematical signs as on a keyboard.
fn plain(text: &str) -> String {
    let spelt = |c: char| match c {
        'α' => "alpha".into(),
        'β' => "beta".into(),
        'θ' => "theta".into(),
        'λ' => "lambda".into(),
        'τ' => "tau".into(),
        'ω' => "omega".into(),
        'Φ' => "Phi".into(),
        '‖' => "|".into(),
        '·' => "*".into(),
        '−' => "-".into(),
        '²' => "^2".into(),
        '³' => "^3".into(),
        '√' => "sqrt".into(),
        '½' => "1/2".into(),
        '¾' => "3/4".into(),
        '\u{307}' => "_dot".into(),
        '₀'..='₉' => char::from_digit(c as u32 - '₀' as u32, 10).unwrap_or(c).to_string(),
        other => other.to_string(),
    };
    text.chars().map(spelt).collect()
}

#[cfg(test)]
mod tests {
    use crate::figure::{Axis, Figure, Panel, Series};

    #[test]
    fn curves_share_their_abscissa() {
        let (t, y) = (Axis::new("time", "s"), Axis::new("θ₂", "N·m"));
        let first = Series::new("θ₁", [[0.0, 1.0], [1.0, 2.0]]);
        let second = Series::new("", [[0.0, 3.0], [1.0, 4.0]]);
        let third = Series::new("other", [[0.5, 3.0]]);
        let figure = Figure::new("").panel(Panel::lines(t, y, [first, second, third]));
        let headings: Vec<_> = figure.columns().iter().map(super::Column::heading).collect();
        assert_eq!(headings, ["time [s]", "theta1 [N*m]", "theta2 [N*m]", "time [s]", "other [N*m]"]);
    }
}
