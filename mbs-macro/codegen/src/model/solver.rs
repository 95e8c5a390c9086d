//! `states = …;`, `step = …;`, `method = …;`, `feedback = …;`, `gradients = …;` and `limit …;`: how a mechanism is meant to be
//! integrated, and what that may cost.

use mbs_interface::{HEUN, Tableau};
use mbs_symbolic::Number;
use mbs_symbolic::units::Dimension;
use proc_macro2::{Ident, Span};

use super::Closes;
use super::names::Place;
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, listing};
use crate::syntax::{Formula, Limited};

/// Longer programs are emitted with loops, unless declared otherwise: straight
/// lines are as fast up to about this length, and slower and slower to compile
/// behind it.
const UNROLLED: u32 = 1024;

/// The declared choices, in SI units.
#[derive(Default)]
pub struct Solver {
    /// True if coordinates that a constraint gives explicitly are left out of the integration.
    pub has_reduced_states: Option<(bool, Span)>,
    /// Operations that one evaluation of the right-hand side may take.
    pub operations: Option<(u32, Span)>,
    /// Bytes of stack that a step in `f64` may take.
    pub stack: Option<(u32, Span)>,
    /// Instructions that a program may have before its repeated parts become
    /// loops.
    pub unrolled: Option<(u32, Span)>,
    pub step: Option<(f64, Span)>,
    pub scheme: Option<(&'static Tableau, Span)>,
    pub feedback: Option<Feedback>,
    /// Where it is said that runs are differentiated in reverse.
    pub reverse: Option<Span>,
}

pub struct Feedback {
    pub is_held: bool,
    pub alpha: f64,
    pub beta: f64,
    pub span: Span,
}

impl Solver {
    /// True if coordinates that a constraint gives explicitly are left out of the integration.
    pub fn has_reduced_states(&self) -> bool {
        self.has_reduced_states.is_some_and(|(is_reduced, _)| is_reduced)
    }

    /// The scheme of its steps: Heun's method, unless it declares another.
    pub fn scheme(&self) -> &'static Tableau {
        self.scheme.map_or(&HEUN, |(scheme, _)| scheme)
    }

    /// Instructions that a program may have before its repeated parts become
    /// loops.
    pub fn unrolled(&self) -> usize {
        self.unrolled.map_or(UNROLLED, |(limit, _)| limit) as usize
    }
}

impl Resolver<'_> {
    pub(super) fn resolve_closes(
        &mut self,
        keyword: Span,
        coordinate: Option<&Ident>,
        from: &Formula,
        to: &Formula,
    ) {
        if let Some(earlier) = self.closes.as_ref().map(|closes| closes.span) {
            self.repeated("`closes`", keyword, earlier);
            return;
        }
        let coordinate = match coordinate {
            None => None,
            Some(name) => match self.coordinates.iter().position(|c| name == &c.quantity.name && !c.is_own())
            {
                Some(at) => Some(at),
                None => {
                    let names: Vec<_> = self
                        .coordinates
                        .iter()
                        .filter(|c| !c.is_own())
                        .map(|c| c.quantity.name.as_str())
                        .collect();
                    let names = listing(names);
                    self.errors.push(
                        Diagnostic::new(name.span(), format!("there is no coordinate `{name}`")).help(
                            format!("the coordinates are {names}; without one, the span is one of time"),
                        ),
                    );
                    return;
                }
            },
        };
        let dimension = coordinate.map_or(Dimension::TIME, |at| self.coordinates[at].quantity.dimension);
        let what = ("an end of the span", dimension);
        let from = self.scope.formula_of(from, Place::Property, what, &mut self.errors);
        let to = self.scope.formula_of(to, Place::Property, what, &mut self.errors);
        if let (Some(from), Some(to)) = (from, to) {
            self.closes = Some(Closes { coordinate, from, to, span: keyword });
        }
    }

    pub(super) fn resolve_states(&mut self, keyword: Span, are_reduced: bool) {
        match self.solver.has_reduced_states {
            Some((_, earlier)) => self.repeated("`states`", keyword, earlier),
            None => self.solver.has_reduced_states = Some((are_reduced, keyword)),
        }
    }

    pub(super) fn resolve_limit(&mut self, keyword: Span, limited: Limited, value: u32) {
        let solver = &mut self.solver;
        let (limit, what) = match limited {
            Limited::Operations => (&mut solver.operations, "`limit operations`"),
            Limited::Stack => (&mut solver.stack, "`limit stack`"),
            Limited::Unrolled => (&mut solver.unrolled, "`limit unrolled`"),
        };
        match *limit {
            Some((_, earlier)) => self.repeated(what, keyword, earlier),
            None => *limit = Some((value, keyword)),
        }
    }

    pub(super) fn resolve_step(&mut self, keyword: Span, value: &Formula) {
        if let Some((_, earlier)) = self.solver.step {
            return self.repeated("`step`", keyword, earlier);
        }
        let Some(step) = self.number(value, ("the step", Dimension::of(0, 0, 1))) else { return };
        if step <= 0.0 {
            let message = format!("the step is {step} s, but it has to be positive");
            self.errors.push(Diagnostic::new(value.span, message).help("as in `step = 0.5 [ms];`"));
        }
        self.solver.step = Some((step, keyword));
    }

    pub(super) fn resolve_method(&mut self, keyword: Span, scheme: &'static Tableau) {
        match self.solver.scheme {
            Some((_, earlier)) => self.repeated("`method`", keyword, earlier),
            None => self.solver.scheme = Some((scheme, keyword)),
        }
    }

    pub(super) fn resolve_gradients(&mut self, keyword: Span) {
        match self.solver.reverse {
            Some(earlier) => self.repeated("`gradients`", keyword, earlier),
            None => self.solver.reverse = Some(keyword),
        }
    }

    pub(super) fn resolve_feedback(&mut self, keyword: Span, is_held: bool, gains: &[Formula; 2]) {
        if let Some(earlier) = &self.solver.feedback {
            let earlier = earlier.span;
            return self.repeated("`feedback`", keyword, earlier);
        }
        let [alpha, beta] = gains;
        let values = [("alpha", alpha), ("beta", beta)].map(|(name, formula)| {
            let gain = self.number(formula, (&format!("the gain {name}"), Dimension::of(0, 0, -1)))?;
            if gain < 0.0 {
                let message = format!("the gain {name} is {gain} 1/s, but it must not be negative");
                self.errors.push(Diagnostic::new(formula.span, message).help("0 switches a term off"));
            }
            Some(gain)
        });
        if let [Some(alpha), Some(beta)] = values {
            self.solver.feedback = Some(Feedback { is_held, alpha, beta, span: keyword });
        }
    }

    /// A finite number of constants alone.
    fn number(&mut self, formula: &Formula, what: (&str, Dimension)) -> Option<f64> {
        let expr = self.scope.formula_of(formula, Place::Constant, what, &mut self.errors)?;
        let value = self.scope.arena.as_number(expr).map(Number::to_f64).filter(|value| value.is_finite());
        if value.is_none() {
            let message = format!("{} is not a finite number", what.0);
            self.errors.push(Diagnostic::new(formula.span, message).help("check its divisors and functions"));
        }
        value
    }

    /// Gains need a step: whether they are stable depends on it.
    pub(super) fn check_solver(&mut self) {
        if let Solver { step: None, feedback: Some(feedback), .. } = &self.solver {
            self.errors.push(
                Diagnostic::new(
                    feedback.span,
                    "`feedback` is stable or not for a certain step, and there is none",
                )
                .help("add one, as in `step = 0.5 [ms];`"),
            );
        }
        if let (Some(span), false) = (self.solver.reverse, self.clocks.is_empty()) {
            self.errors.push(Diagnostic::new(span, "no way leads back through the samples of a clock").help(
                "leave `gradients = reverse;` out: derivatives by dual numbers go through samples, too",
            ));
        }
    }
}
