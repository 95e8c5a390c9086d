//! Tables of two arguments: functions over a grid.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Beyond, Grid, Interpolation, Outside};
use proc_macro2::Ident;

use super::known::{Curve, Typed};
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics, counted};
use crate::syntax::{Formula, Table};

impl Scope<'_> {
    pub(super) fn surface_of(
        &mut self,
        table: &Table,
        (points, outside): (&[[Formula; 3]], &[Beyond; 2]),
        errors: &mut Diagnostics,
    ) -> Option<Curve> {
        let name = &table.name;
        let [x, y, value] = [
            (0, format!("a first argument of `{name}`")),
            (1, format!("a second argument of `{name}`")),
            (2, format!("a value of `{name}`")),
        ]
        .map(|(at, what)| {
            let formulas = points.iter().map(|point| &point[at]).collect();
            self.numbers(&what, formulas, errors)
        });
        let ((x, along), (y, across), (values, value)) = (x?, y?, value?);
        let numbers: Vec<[f64; 3]> =
            x.into_iter().zip(y).zip(values).map(|((x, y), value)| [x, y, value]).collect();
        let grid = errors.take(grid(name, points, &numbers))?;
        let (grid, outside) = errors.take(closed(table, grid, outside))?;
        if table.interpolation == Interpolation::Monotone {
            let message = format!("`{name}` is a table of two arguments, of which none is `monotone`");
            errors.push(Diagnostic::new(name.span(), message).help("take `linear`, `cubic` or `step`"));
            return None;
        }
        let surface = self.arena.add_surface(&name.to_string(), &grid, table.interpolation, outside);
        let Some(surface) = surface else {
            let message = format!("the points of `{name}` do not give finite slopes");
            errors.push(Diagnostic::new(name.span(), message).help("check their size and distances"));
            return None;
        };
        self.surfaces.push(surface);
        Some(Curve::Surface { at: self.surfaces.len() - 1, arguments: [along, across], value })
    }

    /// `map(speed, load)`
    pub(super) fn on_surface(
        &mut self,
        (name, at): (&Ident, usize),
        arguments: &[Formula],
        (dimensions, value): ([Dimension; 2], Dimension),
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let [x, y] = arguments else {
            let message = format!("`{name}` takes 2 arguments, not {}", arguments.len());
            errors.push(Diagnostic::new(name.span(), message).help(format!("write `{name}(x, y)`")));
            return None;
        };
        let mut argument = |which: &str, formula: &Formula, dimension| {
            let what = format!("the {which} argument of `{name}`");
            self.formula_of(formula, place, (&what, dimension), errors)
        };
        let x = argument("first", x, dimensions[0]);
        let y = argument("second", y, dimensions[1]);
        let arguments = [x?, y?];
        let surface = self.surfaces.get(at)?.clone();
        let expr = self.arena.surface(&surface, arguments);
        Some(Typed { expr, dimension: Some(value) })
    }
}

/// The grid of points that are given line by line.
fn grid(name: &Ident, points: &[[Formula; 3]], numbers: &[[f64; 3]]) -> Result<Grid, Diagnostic> {
    let mut grid = Grid { x: Vec::new(), y: Vec::new(), values: Vec::new() };
    let help = "give the values for the first argument's first value, by ascending second argument, then those for its next value";
    let unfit = |at: usize, message: String| {
        let span = points.get(at).map_or(name.span(), |point| point[0].span);
        Diagnostic::new(span, message).help(help)
    };
    let (mut line, mut before) = (0, None);
    for (at, &[x, y, value]) in numbers.iter().enumerate() {
        let is_new = grid.x.last().is_none_or(|last| *last != x);
        if is_new && grid.x.len() > 1 && line < grid.y.len() {
            return Err(unfit(at.saturating_sub(1), incomplete(name, line, grid.y.len())));
        }
        let is_ordered = match is_new {
            true => grid.x.last().is_none_or(|last| *last < x),
            false => before.is_some_and(|before| before < y),
        };
        if !is_ordered {
            return Err(unfit(at, format!("point {} of `{name}` is out of order", at + 1)));
        }
        if is_new {
            grid.x.push(x);
            line = 0;
        }
        match grid.y.get(line) {
            _ if grid.x.len() == 1 => grid.y.push(y),
            Some(expected) if *expected == y => {}
            _ => {
                let message =
                    format!("point {} of `{name}` has a second argument that the first line has not", at + 1);
                return Err(unfit(at, message));
            }
        }
        grid.values.push(value);
        (line, before) = (line + 1, Some(y));
    }
    if line < grid.y.len() {
        return Err(unfit(numbers.len().saturating_sub(1), incomplete(name, line, grid.y.len())));
    }
    if grid.x.len() < 2 || grid.y.len() < 2 {
        let (x, y) = (counted(grid.x.len(), "value"), counted(grid.y.len(), "value"));
        let message = format!("`{name}` has {x} of its first argument and {y} of its second one");
        return Err(Diagnostic::new(name.span(), message).help("a grid has two or more of each"));
    }
    Ok(grid)
}

fn incomplete(name: &Ident, found: usize, expected: usize) -> String {
    format!(
        "the line of this point has {} of the second argument of `{name}`, where the first line has {expected}",
        counted(found, "value")
    )
}

/// A grid with its rules for outside. Along a periodic argument it ends with its first line again, which is taken away.
fn closed(table: &Table, mut grid: Grid, beyond: &[Beyond; 2]) -> Result<(Grid, [Outside; 2]), Diagnostic> {
    let mut outside = [Outside::Hold; 2];
    for (axis, (beyond, outside)) in beyond.iter().zip(&mut outside).enumerate() {
        *outside = match beyond {
            Beyond::Hold => Outside::Hold,
            Beyond::Extend => Outside::Extend,
            Beyond::Refuse => Outside::Refuse,
            Beyond::Periodic => Outside::Periodic(close(table, &mut grid, axis)?),
        };
    }
    Ok((grid, outside))
}

/// The period along an argument, whose last line, which is the first one again, is taken away.
fn close(table: &Table, grid: &mut Grid, axis: usize) -> Result<f64, Diagnostic> {
    let name = &table.name;
    let (along, which) = if axis == 0 { (&grid.x, "first") } else { (&grid.y, "second") };
    let (count, across) = (along.len(), grid.values.len() / along.len());
    let value = |line: usize, at: usize| match axis {
        0 => grid.values.get(line * across + at),
        _ => grid.values.get(at * count + line),
    };
    let period = along.last().zip(along.first()).map_or(f64::NAN, |(last, first)| last - first);
    let needed = if table.interpolation == Interpolation::Cubic { 4 } else { 3 };
    if count < needed {
        let found = counted(count, "value");
        let message = format!("`{name}` has {found} of its {which} argument, along which it is periodic");
        let help = format!("give it {needed} or more, of which the last is the first again");
        return Err(Diagnostic::new(name.span(), message).help(help));
    }
    if (0..across).any(|at| value(0, at) != value(count - 1, at)) {
        let message = format!(
            "`{name}` does not close along its {which} argument: its last values are not the first ones again"
        );
        return Err(Diagnostic::new(name.span(), message)
            .help("end it with the values that it begins with; the period is the distance of these points"));
    }
    if axis == 0 {
        grid.x.pop();
        grid.values.truncate((count - 1) * across);
    } else {
        grid.y.pop();
        let kept = grid.values.iter().enumerate().filter(|(at, _)| at % count != count - 1);
        grid.values = kept.map(|(_, value)| *value).collect();
    }
    Ok(period)
}
