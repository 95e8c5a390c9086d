//! Profiles: functions through given points, as splines.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Spline, SplineId};
use proc_macro2::{Ident, Span};

use super::functions;
use super::names::{Place, Scope, Typed, duplicate};
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, Diagnostics, described};
use crate::syntax::{self, Formula, FormulaKind};

/// A profile as formulas know it.
pub struct Profile {
    span: Span,
    state: State,
}

#[derive(Clone, Copy)]
enum State {
    Untouched,
    Failed,
    Done { spline: SplineId, argument: Dimension, value: Dimension },
}

impl Resolver<'_> {
    /// Enters the name of a profile, once all quantities are known.
    pub(super) fn declare_profile(&mut self, name: &Ident) {
        let text = name.to_string();
        if functions::is_known(&text) {
            let message = format!("`{text}` is a function of the language and cannot be declared");
            self.errors.push(Diagnostic::new(name.span(), message).help("choose another name"));
            return;
        }
        let quantity = self.scope.values.get(&text).map(|value| value.span());
        let earlier = self.scope.profiles.get(&text).map(|profile| profile.span).or(quantity);
        match earlier {
            Some(earlier) => self.errors.push(duplicate(name, earlier)),
            None => {
                let profile = Profile { span: name.span(), state: State::Untouched };
                self.scope.profiles.insert(text, profile);
            }
        }
    }

    pub(super) fn resolve_profile(&mut self, profile: &syntax::Profile) {
        let state = self.spline_of(profile).unwrap_or(State::Failed);
        if let Some(known) = self.scope.profiles.get_mut(&profile.name.to_string()) {
            known.state = state;
        }
    }

    fn spline_of(&mut self, profile: &syntax::Profile) -> Option<State> {
        let name = &profile.name;
        let (arguments, values): (Vec<_>, Vec<_>) =
            profile.points.iter().map(|point| (&point.x, &point.y)).unzip();
        let arguments = arguments.into_iter().chain([&profile.period]).collect();
        let arguments = self.numbers(&format!("an argument of `{name}`"), arguments);
        let values = self.numbers(&format!("a value of `{name}`"), values);
        let ((mut arguments, argument), (values, value)) = (arguments?, values?);
        let period = arguments.pop()?;
        self.errors.take(check(profile, &arguments, period))?;
        let points: Vec<_> = arguments.into_iter().zip(values).collect();
        let Some(spline) = Spline::periodic(&name.to_string(), &points, period) else {
            let message = format!("the points of `{name}` do not give finite slopes");
            self.errors.push(Diagnostic::new(name.span(), message).help("check their size and distances"));
            return None;
        };
        Some(State::Done { spline: self.scope.arena.add_spline(spline), argument, value })
    }

    /// The spline of a profile that was resolved.
    pub(super) fn spline_named(&self, name: &Ident) -> Option<&Spline> {
        match self.scope.profiles.get(&name.to_string())?.state {
            State::Done { spline, .. } => {
                self.scope.arena.splines().get(spline.index()).map(|spline| &**spline)
            }
            State::Untouched | State::Failed => None,
        }
    }

    /// Constants of one dimension.
    fn numbers(&mut self, what: &str, formulas: Vec<&Formula>) -> Option<(Vec<f64>, Dimension)> {
        let errors = &mut self.errors;
        let typed: Vec<_> =
            formulas.iter().map(|formula| self.scope.formula(formula, Place::Constant, errors)).collect();
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
        agree.then(|| (self.scope.arena.evaluate(&exprs, &|_| f64::NAN), dimension))
    }
}

/// Points enough, in order and within the period.
fn check(profile: &syntax::Profile, arguments: &[f64], period: f64) -> Result<(), Diagnostic> {
    let name = &profile.name;
    let (Some(first), true) = (arguments.first(), arguments.len() >= 3) else {
        let message = format!("profile `{name}` has {} points", arguments.len());
        return Err(Diagnostic::new(name.span(), message).help("a periodic spline needs at least three"));
    };
    if period <= 0.0 {
        let message = format!("the period of `{name}` is not positive");
        return Err(Diagnostic::new(profile.period.span, message)
            .help("it is the distance after which the first point returns, as in `period 360 [deg]`"));
    }
    for (pair, point) in arguments.windows(2).zip(profile.points.iter().skip(1)) {
        if pair[1] <= pair[0] {
            return Err(Diagnostic::new(point.x.span, format!("the points of `{name}` are out of order"))
                .help("this argument has to be larger than the one before it"));
        }
        if pair[1] - first >= period {
            let is_bare = |formula: &Formula| matches!(formula.kind, FormulaKind::Number { unit: None, .. });
            let message = format!("this point of `{name}` is a period or more behind the first one");
            return Err(Diagnostic::new(point.x.span, message).help(
                if is_bare(&point.x) && !is_bare(&profile.period) {
                    "give it the unit that the period has"
                } else {
                    "leave it out: after a period the first point returns by itself"
                },
            ));
        }
    }
    Ok(())
}

impl Scope<'_> {
    /// `lift(angle)`
    pub(super) fn profile(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let profile = self.profiles.get(&name.to_string())?;
        self.used.insert(name.to_string());
        let (spline, argument, value) = match profile.state {
            State::Done { spline, argument, value } => (spline, argument, value),
            State::Failed => return None,
            State::Untouched => {
                let message = format!("`{name}` cannot stand here: profiles are given by numbers");
                let span = profile.span;
                errors.push(
                    Diagnostic::new(name.span(), message)
                        .note(span, format!("`{name}` is declared here"))
                        .help("write the value itself"),
                );
                return None;
            }
        };
        let [x] = arguments else {
            let message = format!("`{name}` takes 1 argument, not {}", arguments.len());
            errors.push(Diagnostic::new(name.span(), message).help(format!("write `{name}(x)`")));
            return None;
        };
        let what = format!("the argument of `{name}`");
        let x = self.formula_of(x, place, (&what, argument), errors)?;
        Some(Typed { expr: self.arena.spline(spline, x), dimension: Some(value) })
    }
}
