//! Tables and profiles: functions through given points, as splines.

use mbs_symbolic::Spline;
use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Beyond, Interpolation, Outside as Around};
use proc_macro2::Ident;

use super::functions;
use super::known::{Curve, Table, Typed};
use super::names::{Place, Scope, duplicate};
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, Diagnostics, counted, described};
use crate::syntax::{self, Formula, FormulaKind, Outside, Points, Vector};

impl<'a> Resolver<'a> {
    /// Enters the name of a table, once all quantities are known.
    pub(super) fn declare_table(&mut self, table: &'a syntax::Table) {
        let name = &table.name;
        let text = name.to_string();
        if functions::is_known(&text) {
            let message = format!("`{text}` is a function of the language and cannot be declared");
            self.errors.push(Diagnostic::new(name.span(), message).help("choose another name"));
            return;
        }
        let quantity = self.scope.values.get(&text).map(|value| value.span());
        let earlier = self.scope.tables.get(&text).map(|table| table.span).or(quantity);
        if let Some(earlier) = earlier {
            self.errors.push(duplicate(name, earlier));
        }
        // one without a curve has its error
        let curve = if earlier.is_none() { Curve::Untouched } else { Curve::Failed };
        let known = Table { span: name.span(), points: table, curve };
        self.scope.tables.entry(text).or_insert(known);
    }

    pub(super) fn resolve_table(&mut self, table: &syntax::Table) {
        self.scope.curve(&table.name, &mut self.errors);
    }

    /// The spline of a table that was resolved.
    pub(super) fn spline_named(&self, name: &Ident) -> Option<&Spline> {
        match self.scope.tables.get(&name.to_string())?.curve {
            Curve::Done { spline, .. } => {
                self.scope.arena.splines().get(spline.index()).map(|spline| &**spline)
            }
            Curve::Untouched | Curve::Open | Curve::Failed | Curve::Surface { .. } => None,
        }
    }
}

impl Scope<'_> {
    /// The curve of a table, resolved when it is first needed.
    fn curve(&mut self, name: &Ident, errors: &mut Diagnostics) -> Option<Curve> {
        let text = name.to_string();
        let table = self.tables.get_mut(&text)?;
        match table.curve {
            Curve::Done { .. } | Curve::Surface { .. } => Some(table.curve),
            Curve::Failed => None,
            Curve::Open => {
                let error = Diagnostic::new(name.span(), format!("`{text}` is defined through itself"))
                    .note(table.span, format!("the definition of `{text}` starts here"));
                errors.push(error.help("break the circle: give one of its points a number"));
                None
            }
            Curve::Untouched => {
                table.curve = Curve::Open;
                let points = table.points;
                let curve = match &points.points {
                    Points::Curve(along, outside) => self.spline_of(points, (along, outside), errors),
                    Points::Grid(grid, outside) => self.surface_of(points, (grid, outside), errors),
                };
                self.tables.get_mut(&text)?.curve = curve.unwrap_or(Curve::Failed);
                curve
            }
        }
    }

    fn spline_of(
        &mut self,
        table: &syntax::Table,
        (given, outside): (&[Vector], &Outside),
        errors: &mut Diagnostics,
    ) -> Option<Curve> {
        let name = &table.name;
        let (arguments, values): (Vec<_>, Vec<_>) = given.iter().map(|point| (&point.x, &point.y)).unzip();
        let period = if let Outside::After(period) = outside { Some(period) } else { None };
        let arguments = arguments.into_iter().chain(period).collect();
        let arguments = self.numbers(&format!("an argument of `{name}`"), arguments, errors);
        let values = self.numbers(&format!("a value of `{name}`"), values, errors);
        let ((mut arguments, argument), (values, value)) = (arguments?, values?);
        let period = period.and_then(|period| Some((period, arguments.pop()?)));
        let points: Vec<_> = arguments.into_iter().zip(values).collect();
        errors.take(check(table, (given, outside), &points, period))?;
        let (text, interpolation) = (name.to_string(), table.interpolation);
        let spline = match outside {
            Outside::By(beyond) => Spline::by_rule(&text, &points, interpolation, *beyond),
            Outside::After(_) => Spline::through(&text, &points, interpolation, Around::Periodic(period?.1)),
        };
        let Some(spline) = spline else {
            let message = format!("the points of `{name}` do not give finite slopes");
            errors.push(Diagnostic::new(name.span(), message).help("check their size and distances"));
            return None;
        };
        Some(Curve::Done { spline: self.arena.add_spline(spline), argument, value })
    }

    /// Constants of one dimension.
    pub(super) fn numbers(
        &mut self,
        what: &str,
        formulas: Vec<&Formula>,
        errors: &mut Diagnostics,
    ) -> Option<(Vec<f64>, Dimension)> {
        let typed: Vec<_> =
            formulas.iter().map(|formula| self.formula(formula, Place::Constant, errors)).collect();
        let typed: Vec<Typed> = typed.into_iter().collect::<Option<_>>()?;
        let dimension = typed.iter().find_map(|typed| typed.dimension).unwrap_or(Dimension::NONE);
        let mut agree = true;
        for (formula, typed) in formulas.iter().zip(&typed) {
            if let Some(found) = typed.dimension.filter(|found| *found != dimension) {
                let message =
                    format!("{what} is {}, but another one is {}", described(found), described(dimension));
                errors.push(
                    Diagnostic::new(formula.span, message).help("give all of them in units of one kind"),
                );
                agree = false;
            }
        }
        let exprs: Vec<_> = typed.iter().map(|typed| typed.expr).collect();
        agree.then(|| (self.arena.evaluate(&exprs, &|_| f64::NAN), dimension))
    }
}

/// Points enough, in order and within the period.
fn check(
    table: &syntax::Table,
    (given, outside): (&[Vector], &Outside),
    points: &[(f64, f64)],
    period: Option<(&Formula, f64)>,
) -> Result<(), Diagnostic> {
    let (name, word) = (&table.name, table.word);
    let is_closed = matches!(outside, Outside::By(Beyond::Periodic));
    let is_smooth = table.interpolation == Interpolation::Cubic && (is_closed || period.is_some());
    let (needed, help) = match (is_smooth, is_closed) {
        (true, false) => (3, "a periodic spline needs at least three"),
        (true, true) => (4, "a periodic cubic one needs at least four, of which the last is the first again"),
        (false, true) => (3, "a periodic one needs at least three, of which the last is the first again"),
        (false, false) => (2, "give it two or more"),
    };
    let (Some(first), Some(last), true) = (points.first(), points.last(), points.len() >= needed) else {
        let count = counted(points.len(), "point");
        return Err(Diagnostic::new(name.span(), format!("{word} `{name}` has {count}")).help(help));
    };
    if let Some((formula, _)) = period.filter(|(_, period)| *period <= 0.0) {
        return Err(Diagnostic::new(formula.span, format!("the period of `{name}` is not positive"))
            .help("it is the distance after which the first point returns, as in `period 360 [deg]`"));
    }
    for (at, (pair, point)) in points.windows(2).zip(given.iter().skip(1)).enumerate() {
        if pair[1].0 <= pair[0].0 {
            return Err(Diagnostic::new(
                point.x.span,
                format!("point {} of `{name}` is out of order", at + 2),
            )
            .help("this argument has to be larger than the one before it"));
        }
        if let Some((formula, _)) = period.filter(|(_, period)| pair[1].0 - first.0 >= *period) {
            let is_bare = |formula: &Formula| matches!(formula.kind, FormulaKind::Number { unit: None, .. });
            let message = format!("this point of `{name}` is a period or more behind the first one");
            return Err(Diagnostic::new(point.x.span, message).help(
                if is_bare(&point.x) && !is_bare(formula) {
                    "give it the unit that the period has"
                } else {
                    "leave it out: after a period the first point returns by itself"
                },
            ));
        }
    }
    if let Some(point) = given.last().filter(|_| is_closed && last.1 != first.1) {
        let message = format!("`{name}` does not close: its last point is not the first one again");
        return Err(Diagnostic::new(point.y.span, message).help(
            "a periodic table ends with the value that it begins with; its period is the distance of these points",
        ));
    }
    Ok(())
}

impl Scope<'_> {
    /// `lift(angle)`
    pub(super) fn table(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        self.used.insert(name.to_string());
        let (spline, argument, value) = match self.curve(name, errors)? {
            Curve::Done { spline, argument, value } => (spline, argument, value),
            Curve::Surface { at, arguments: of, value } => {
                return self.on_surface((name, at), arguments, (of, value), place, errors);
            }
            Curve::Untouched | Curve::Open | Curve::Failed => return None,
        };
        let [x] = arguments else {
            let message = format!("`{name}` takes 1 argument, not {}", arguments.len());
            errors.push(Diagnostic::new(name.span(), message).help(format!("write `{name}(x)`")));
            return None;
        };
        let what = format!("the argument of `{name}`");
        let argument = self.formula_of(x, place, (&what, argument), errors)?;
        let expr = self.arena.spline(spline, argument);
        let is_refused = self.arena.as_number(argument).is_some() && self.arena.as_number(expr).is_none();
        if is_refused {
            let message = format!("this argument is outside of `{name}`, which refuses it");
            errors.push(Diagnostic::new(x.span, message).help("change it, or say what holds `outside`"));
            return None;
        }
        Some(Typed { expr, dimension: Some(value) })
    }
}
