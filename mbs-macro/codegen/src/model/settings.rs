//! The declared values of what is set from outside: `param l = 60 [mm];`, `input push [N] = 2 [kN];`.

use mbs_symbolic::{Expr, Number};
use proc_macro2::Ident;

use super::Meaning;
use super::hints::unit_help_for_products;
use super::known::Value;
use super::names::Place;
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, described};
use crate::syntax::{Formula, Item, ItemKind};

impl<'a> Resolver<'a> {
    /// The value of a parameter, or that of an input at first. If a parameter has an error, what uses it has none of
    /// its own.
    pub(super) fn resolve_value(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Parameter { name, value, .. } => {
                let before = self.errors.len();
                self.resolve_parameter(name, value);
                if self.errors.len() > before {
                    self.scope.values.insert(name.to_string(), Value::Refused(name.span()));
                }
            }
            ItemKind::Input { name, value: Some(value), .. }
            | ItemKind::Memory { name, value: Some(value), .. }
            | ItemKind::Mode { name, value: Some(value), .. } => self.resolve_input(name, value),
            _ => {}
        }
    }

    fn resolve_parameter(&mut self, name: &Ident, formula: &Formula) {
        // Statements are resolved in the order in which they were declared.
        let at = self.resolved_parameters;
        self.resolved_parameters += 1;
        if at >= self.parameters.len() {
            return;
        }
        let Some(typed) = self.scope.formula(formula, Place::Constant, &mut self.errors) else { return };
        let Some(value) = self.declared_value(name, formula, typed.expr) else { return };
        let declared = self.parameters[at].quantity.dimension;
        let found = typed.dimension.unwrap_or(declared);
        if found != declared {
            let message = format!(
                "the declared value of `{name}` is {}, but no unit stands behind it",
                described(found)
            );
            self.errors.push(Diagnostic::new(formula.span, message).help(
                unit_help_for_products(formula).unwrap_or_else(|| {
                    "write a number with its unit, as in `param l = 60 [mm];`, or use `const` or `let` for computed values".to_owned()
                }),
            ));
            return;
        }
        self.parameters[at].value = value;
    }

    fn resolve_input(&mut self, name: &Ident, formula: &Formula) {
        let Some(Value::Symbol { symbol, .. }) = self.scope.values.get(&name.to_string()) else { return };
        // a name that is declared twice is that of something else
        let Meaning::Input(at) = self.scope.meaning(*symbol) else { return };
        let what = format!("the declared value of `{name}`");
        let dimension = self.inputs[at].quantity.dimension;
        let value = self.scope.formula_of(formula, Place::Constant, (&what, dimension), &mut self.errors);
        if let Some(value) = value.and_then(|value| self.declared_value(name, formula, value)) {
            self.inputs[at].value = value;
        }
    }

    /// The number of a declared value, which has to be finite.
    fn declared_value(&mut self, name: &Ident, formula: &Formula, value: Expr) -> Option<f64> {
        let value = self.scope.arena.as_number(value).map(Number::to_f64).filter(|value| value.is_finite());
        if value.is_none() {
            let message = format!("the declared value of `{name}` is not a finite number");
            self.errors.push(Diagnostic::new(formula.span, message).help("check its divisors and functions"));
        }
        value
    }
}
