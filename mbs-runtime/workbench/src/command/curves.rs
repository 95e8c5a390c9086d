//! The choice of columns to draw, and how curves share panels.

use crate::figure::axis;
use crate::figure::{Axis, Figure, Panel, SERIES_COLOURS, Series};
use crate::{Column, Error, Recording};

/// A list of more coordinates than this is shown by its ends.
const MANY: usize = 12;
/// Each end of a long list has so many coordinates. In a chain, the ends of the list are those of the chain.
const ENDS: usize = 3;
/// Curves of one panel: as many as there are colours.
const MOST: usize = SERIES_COLOURS.len();

/// Which columns of a recording are wanted, and over what.
#[derive(Clone, Debug, Default)]
pub(super) struct Choice {
    /// Patterns of names; none for what is usual.
    pub columns: Vec<String>,
    /// The abscissa; time if none is named.
    pub x: Option<String>,
}

impl Choice {
    /// The columns to be written: all of them if none are chosen. The abscissa comes first.
    pub fn written<'a>(&self, recording: &'a Recording) -> Result<Vec<&'a Column>, Error> {
        let mut columns = match self.columns.as_slice() {
            [] => recording.columns.iter().collect(),
            patterns => recording.select(patterns.iter().map(String::as_str))?,
        };
        let first = self.abscissa(recording)?;
        columns.retain(|column| column.name != first.name);
        columns.insert(0, first);
        Ok(columns)
    }

    /// The columns to be drawn: coordinates, own states, outputs and the violation of constraints if none are chosen.
    pub fn drawn<'a>(&self, recording: &'a Recording) -> Result<Vec<&'a Column>, Error> {
        if !self.columns.is_empty() {
            return recording.select(self.columns.iter().map(String::as_str));
        }
        let (n, hidden, memories) = (recording.coordinates, hidden(recording.lines), recording.of_memories());
        let has_constraints = recording.columns.iter().any(|column| column.name.starts_with("lambda("));
        let is_usual = |at: usize, name: &str| match at.checked_sub(1) {
            None => false,
            Some(place) if place < n => place < recording.lines && !hidden.contains(&place),
            // rates of coordinates, then own states
            Some(place) if place < 2 * n => place - n >= recording.lines,
            Some(_) if memories.contains(&at) => false,
            Some(_) => !name.starts_with("lambda(") && (has_constraints || name != "violation"),
        };
        let columns = recording.columns.iter().enumerate();
        Ok(columns.filter(|(at, column)| is_usual(*at, &column.name)).map(|(_, column)| column).collect())
    }

    fn abscissa<'a>(&self, recording: &'a Recording) -> Result<&'a Column, Error> {
        let name = self.x.as_deref().unwrap_or("t");
        recording.column(name).ok_or_else(|| {
            Error::unknown("column", name, recording.columns.iter().map(|column| column.name.as_str()))
        })
    }
}

/// Of a list of coordinates, those that are not shown unless they are asked for.
pub(super) fn hidden(count: usize) -> std::ops::Range<usize> {
    if count <= MANY { 0..0 } else { ENDS..count - ENDS }
}

/// The axis of a column.
fn axis_of(column: &Column) -> Axis {
    match column.name.as_str() {
        "t" => Axis::new("time", "s"),
        // It mixes metres and radians.
        "violation" => Axis::new("violation ‖Φ‖", ""),
        name => axis(name, &column.unit),
    }
}

/// The kind of quantity of a column. Columns of one kind and one unit share panels.
fn kind(recording: &Recording, column: &Column) -> &'static str {
    let at = recording.columns.iter().position(|other| other.name == column.name).unwrap_or(0);
    let is_length = !matches!(column.unit.split('/').next(), None | Some("" | "1" | "rad" | "deg" | "rev"));
    match at.checked_sub(1) {
        Some(at) if at < 2 * recording.coordinates && at % recording.coordinates >= recording.lines => {
            if at < recording.coordinates { "integral of a state" } else { "state" }
        }
        Some(at) if at < recording.coordinates => {
            if is_length {
                "position"
            } else {
                "angle"
            }
        }
        Some(at) if at < 2 * recording.coordinates => {
            if is_length {
                "velocity"
            } else {
                "angular velocity"
            }
        }
        Some(_) if recording.of_memories().contains(&at) => "memories",
        _ if column.name.starts_with("lambda(") => "multiplier",
        _ if column.name == "violation" => "violation",
        _ => "outputs",
    }
}

/// A run: columns of a kind and a unit share panels, as many to one as there are colours.
pub(super) fn curves(title: &str, recording: &Recording, choice: &Choice) -> Result<Figure, Error> {
    let x = choice.abscissa(recording)?;
    let mut groups: Vec<(&str, Vec<&Column>)> = Vec::new();
    for column in choice.drawn(recording)? {
        let kind = kind(recording, column);
        let is_same = |(other, columns): &&mut (&str, Vec<&Column>)| {
            *other == kind && columns.first().is_some_and(|first| first.unit == column.unit)
        };
        match groups.iter_mut().find(is_same) {
            Some((_, columns)) => columns.push(column),
            None => groups.push((kind, vec![column])),
        }
    }
    // along the time, the events of a run
    let is_time = recording.columns.first().is_some_and(|time| time.name == x.name);
    let marks = || recording.occurrences.iter().filter(|_| is_time).map(|event| event.t);
    let mut figure = Figure::new(title).panel_height(300);
    for (kind, columns) in &groups {
        // As many to each panel.
        let panels = columns.len().div_ceil(MOST);
        for shared in columns.chunks(columns.len().div_ceil(panels.max(1)).max(1)) {
            figure = figure.panel(panel(kind, x, shared).marked(marks()));
        }
    }
    Ok(figure)
}

fn panel(kind: &str, x: &Column, shared: &[&Column]) -> Panel {
    let curve = |name: &str, column: &Column| Series::xy(name, &x.values, &column.values);
    match shared {
        [alone] => Panel::lines(axis_of(x), axis_of(alone), [curve("", alone)]),
        shared => {
            let unit = shared.first().map_or("", |column| &column.unit);
            let curves = shared.iter().map(|column| curve(&column.name.replace('_', " "), column));
            Panel::lines(axis_of(x), axis(kind, unit), curves)
        }
    }
}

/// Runs in one picture: a panel for every column, a curve for every run.
pub(super) fn compared(title: &str, runs: &[(String, Recording)], choice: &Choice) -> Result<Figure, Error> {
    let mut figure = Figure::new(title).panel_height(300);
    let Some((_, first)) = runs.first() else { return Ok(figure) };
    for column in choice.drawn(first)? {
        let curves = runs.iter().map(|(name, recording)| {
            let x = choice.abscissa(recording).map_or(&[][..], |x| &x.values);
            Series::xy(name, x, recording.column(&column.name).map_or(&[][..], |y| &y.values))
        });
        let x = axis_of(choice.abscissa(first)?);
        figure = figure.panel(Panel::lines(x, axis_of(column), curves));
    }
    Ok(figure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Content;

    mbs_runtime::mechanism! {
        /// A chain of weights.
        pub Chain {
            dof = 10;
            gravity = (0, -9.81) [m/s^2];
            for i in 1..=10 {
                body bob[i] (x[i], y[i]) { mass = 1 [kg]; }
                if i == 1 {
                    distance rod[i] (bob[i], ground) = 1 [m];
                } else {
                    distance rod[i] (bob[i], bob[i-1]) = 1 [m];
                }
                start { x[i] = i*1 [m]; guess y[i] = 0; }
            }
            /// The force on the hook.
            output pull [kN] = lambda(rod[1]);
        }
    }

    /// Columns of two numbers each, all of them different.
    fn recording() -> Recording {
        let mut recording = Recording::empty(<Chain as mbs_runtime::Mechanism>::INFO);
        for (at, column) in recording.columns.iter_mut().enumerate() {
            column.values = vec![at as f64, at as f64 + 0.5];
        }
        recording
    }

    fn choice(columns: &[&str], x: Option<&str>) -> Choice {
        Choice { columns: columns.iter().map(|&name| name.to_owned()).collect(), x: x.map(str::to_owned) }
    }

    fn shape(figure: &Figure) -> Vec<(String, usize)> {
        let count = |panel: &Panel| match &panel.content {
            Content::Lines(curves) => curves.len(),
            Content::Map(_) | Content::Mechanism(_) => 0,
        };
        figure.panels.iter().map(|panel| (panel.y.heading(), count(panel))).collect()
    }

    /// The axis said N over values in kN.
    #[test]
    fn an_output_is_drawn_in_the_unit_that_its_axis_names() {
        let recording = recording();
        let figure = curves("chain", &recording, &Choice::default()).unwrap();
        let panel = figure.panels.iter().find(|panel| panel.y.heading() == "pull (kN)").unwrap();
        let Content::Lines(curves) = &panel.content else { panic!() };
        let shown = recording.column("pull").unwrap();
        assert_eq!(shown.unit, "kN");
        assert_eq!(curves[0].points[1][1], shown.values[1]);
        assert!(figure.svg().unwrap().contains("kN)"));
    }

    #[test]
    fn long_lists_are_small_multiples() {
        let recording = recording();
        let usual = shape(&curves("", &recording, &Choice::default()).unwrap());
        let expected = [("position (m)", 6), ("pull (kN)", 1), ("violation ‖Φ‖", 1)];
        assert_eq!(usual, expected.map(|(name, count)| (name.to_owned(), count)));
        let all = shape(&curves("", &recording, &choice(&["x*", "der(y*)"], None)).unwrap());
        let expected =
            [("position (m)", 5), ("position (m)", 5), ("velocity (m/s)", 5), ("velocity (m/s)", 5)];
        assert_eq!(all, expected.map(|(name, count)| (name.to_owned(), count)));
    }

    #[test]
    fn one_quantity_over_another() {
        let recording = recording();
        let choice = choice(&["y_10"], Some("x_10"));
        let figure = curves("", &recording, &choice).unwrap();
        let panel = &figure.panels[0];
        assert_eq!((panel.x.heading(), panel.y.heading()), ("x 10 (m)".into(), "y 10 (m)".into()));
        let names = |columns: Vec<&Column>| columns.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
        assert_eq!(names(choice.written(&recording).unwrap()), ["x_10", "y_10"]);
        let wrong = curves("", &recording, &self::choice(&["z*"], None)).unwrap_err().to_string();
        assert!(wrong.contains("no column `z*`"), "{wrong}");
    }

    #[test]
    fn runs_share_a_panel() {
        let runs = ["a", "b"].map(|name| (name.to_owned(), recording()));
        let figure = compared("", &runs, &choice(&["x_1", "y_1"], None)).unwrap();
        assert_eq!(shape(&figure), [("x 1 (m)".to_owned(), 2), ("y 1 (m)".to_owned(), 2)]);
    }
}
