//! `rate edge: der(y)*cos(phi) = der(x)*sin(phi);`: equations between rates, which restrict no position.
//!
//! A row is Φ̇ = A(q, t) v + b(q, t), and its Φ is 0. So whatever reads A, Φ̇ and γ treats it as any other row.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr};
use proc_macro2::{Ident, Span};

use super::known::Typed;
use super::names::Place;
use super::resolver::Resolver;
use super::{Constraint, Meaning, Source};
use crate::diagnostics::Diagnostic;
use crate::syntax::{Formula, Role};

impl Resolver<'_> {
    pub(super) fn resolve_rate_row(
        &mut self,
        name: &Ident,
        (left, equals, right): (&Formula, Span, &Formula),
        doc: &str,
    ) {
        let [left, right] =
            [left, right].map(|side| self.scope.formula(side, Place::RateRow, &mut self.errors));
        let found = left.zip(right).map(|(left, right)| self.rate_equation(name, (left, equals, right)));
        let found = found.and_then(|found| self.errors.take(found));
        let zero = self.scope.arena.zero();
        if let Some(row) = self.scope.rows.get_mut(&name.to_string()) {
            row.is_broken = found.is_none();
            row.dimension = found.map(|(_, dimension)| dimension);
            row.phi = found.map(|_| zero);
            row.rate = found.map(|(rate, _)| rate);
        }
        let Some((rate, dimension)) = found else { return };
        let source = Source { kind: Role::Rate.word(), name: name.to_string(), bodies: None };
        self.push_row(Constraint {
            name: name.to_string(),
            source,
            doc: doc.to_owned(),
            span: name.span(),
            is_drive: false,
            phi: zero,
            rate: Some(rate),
            dimension,
        });
    }

    /// Φ̇ = left − right, and the dimension of its integral over time.
    fn rate_equation(
        &mut self,
        name: &Ident,
        (left, equals, right): (Typed, Span, Typed),
    ) -> Result<(Expr, Dimension), Diagnostic> {
        let (rate, dimension) = self.difference(left, right, equals)?;
        let algebra = Algebra::new(&mut self.scope.arena);
        let slopes = self.scope.motion.slopes_of_rate(algebra.scalar(rate));
        if let Some(state) =
            slopes.iter().map(|(at, _)| &self.coordinates[*at]).find(|coordinate| coordinate.is_own())
        {
            let state = &state.quantity.name;
            let message = format!("`{name}` depends on the state `{state}`, which no reaction drives");
            let help =
                "an equation between rates is one of coordinates of bodies; let a `force` follow the state";
            return Err(Diagnostic::new(name.span(), message).help(help));
        }
        if slopes.is_empty() {
            let message =
                format!("`{name}` does not restrict any motion: no rate of a coordinate is left in it");
            let help = "write an equation between rates, as in `der(y)*cos(phi) = der(x)*sin(phi)`; one between \
                        positions is a `constraint`";
            return Err(Diagnostic::new(name.span(), message).help(help));
        }
        for &(_, slope) in &slopes {
            let is_velocity = |symbol: &_| matches!(self.scope.meaning(*symbol), Meaning::Velocity(_));
            if let Some(symbol) = self.scope.arena.symbols_in(slope).into_iter().find(is_velocity) {
                let rate = self.scope.arena.name(symbol);
                let message = format!("`{name}` is not linear in `{rate}`");
                let help = "an equation between rates is a sum of rates, each times a function of positions and time";
                return Err(Diagnostic::new(name.span(), message).help(help));
            }
        }
        Ok((rate, dimension.times(Dimension::TIME)))
    }

    /// Equations between rates with factors that no position changes: those of equations between positions, of
    /// which nothing holds the positions.
    pub(super) fn rates_of_positions(&self) -> Vec<Diagnostic> {
        let arena = &self.scope.arena;
        let mut found = Vec::new();
        for constraint in &self.constraints {
            let Some(rate) = constraint.rate else { continue };
            let is_fixed =
                |symbol| matches!(self.scope.meaning(symbol), Meaning::Velocity(_) | Meaning::Parameter(_));
            if arena.symbols_in(rate).into_iter().all(is_fixed) {
                let name = &constraint.name;
                let message =
                    format!("`{name}` is the rate of an equation between positions, which nothing holds");
                let help = "write that as a `constraint`, without `der`: its rate follows, and positions do not drift";
                found.push(Diagnostic::new(constraint.span, message).help(help));
            }
        }
        found
    }
}
