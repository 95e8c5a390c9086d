//! Warnings about parts of a declaration that compile and are likely mistakes.

use std::collections::{BTreeMap, BTreeSet};

use mbs_symbolic::{Beyond, Expr, Function, Interpolation, Node, SplineId, Stage};
use proc_macro2::Span;

use super::Stop;
use super::resolver::Resolver;
use crate::diagnostics::Diagnostic;
use crate::syntax::{Declaration, ItemKind, Outside, Points, Table};

/// A spline that leaves a dwell by less than this share of its range is not spoken of: one of three points of equal
/// values or more, and one of two, which may be a peak between points on both of its sides.
const OVERSHOOT: [f64; 2] = [1e-3, 2e-2];

/// A constraint or a particle, where formulas must not jump.
struct Jumping<'a> {
    name: &'a str,
    span: Span,
    formulas: Vec<Expr>,
    /// True if their slopes must not jump either.
    by_slope: bool,
}

impl Resolver<'_> {
    /// The warnings of a declaration: names that no formula uses, and used tables that leave their dwells.
    pub(super) fn warnings(&self, declaration: &Declaration) -> Vec<Diagnostic> {
        let tables = declaration.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Table(table) if self.scope.used.contains(&table.name.to_string()) => {
                self.overshoot(table)
            }
            _ => None,
        });
        self.unused(declaration)
            .into_iter()
            .chain(tables)
            .chain(self.impacts())
            .chain(self.jumping_stops())
            .chain(self.rates_of_positions())
            .chain(self.never_set(declaration))
            .chain(self.parallel_frictions())
            .collect()
    }

    /// Tables and conditions in constraints and in places of particles whose value or slope jumps: there the velocity does,
    /// too, by an impact that nothing computes. A table once.
    fn impacts(&self) -> Vec<Diagnostic> {
        let constraints = self.constraints.iter().map(|constraint| {
            let formulas = vec![constraint.declared()];
            // a slope that jumps in a rate is an acceleration that does
            Jumping {
                name: &constraint.name,
                span: constraint.span,
                formulas,
                by_slope: constraint.rate.is_none(),
            }
        });
        let names: Vec<String> = self.particle_idents.iter().map(ToString::to_string).collect();
        let particles = self.particles.iter().zip(&names).zip(&self.particle_idents);
        let particles = particles.map(|((particle, name), ident)| Jumping {
            name,
            span: ident.span(),
            formulas: particle.local.to_vec(),
            by_slope: true,
        });
        let mut told = BTreeSet::new();
        let found = constraints.chain(particles).flat_map(|jumping| self.impacts_of(&jumping, &mut told));
        found.collect()
    }

    fn impacts_of(&self, jumping: &Jumping<'_>, told: &mut BTreeSet<SplineId>) -> Vec<Diagnostic> {
        let Jumping { name, span, ref formulas, by_slope } = *jumping;
        let mut found = Vec::new();
        let mut is_chosen = false;
        for node in self.scope.arena.reachable(formulas) {
            if let Node::Call(Function::Greater | Function::Sign, _) = *self.scope.arena.node(node)
                && self.scope.arena.stage(node) == Stage::Variable
                && !is_chosen
            {
                is_chosen = true;
                let meets = if by_slope { " with one slope" } else { "" };
                let message = format!(
                    "`{name}` chooses by a condition: unless both values meet there{meets}, the velocity jumps, \
                     and no force of it is known"
                );
                found.push(
                    Diagnostic::new(span, message)
                        .help("let the pieces meet smoothly, or take a `monotone` table"),
                );
            }
            let Node::Spline(id, ..) = *self.scope.arena.node(node) else { continue };
            let Some(spline) = self.scope.arena.splines().get(id.index()) else { continue };
            let slope = spline.jump(1).filter(|_| by_slope);
            let what = [("value", spline.jump(0)), ("slope", slope)];
            let jump = what.into_iter().find_map(|(what, jump)| Some((what, jump?.0)));
            let Some((what, at)) = jump.filter(|_| told.insert(id)) else { continue };
            let table = spline.bends.as_ref().map_or(&spline.name, |bends| &bends.of);
            let message = format!(
                "the {what} of `{table}` jumps at {at}: there `{name}` gives a jump of velocity, and no force of it"
            );
            let help = match spline.bends {
                Some(_) => "a `cubic` table has no jump between its points",
                None => {
                    "between its points a `monotone` table has no jump; end it with two points of one value, and it \
                     has none where that value is held"
                }
            };
            found.push(Diagnostic::new(span, message).help(help));
        }
        found
    }

    /// Stops whose gaps jump at a time. A body that rests on one jumps with it; one that flies comes to be behind it.
    fn jumping_stops(&self) -> Vec<Diagnostic> {
        let arena = &self.scope.arena;
        let sees_time = |expr: Expr| arena.symbols_in(expr).contains(&self.scope.time);
        let jumps = |expr: Expr| match arena.node(expr) {
            Node::Call(Function::Greater | Function::Sign, _) => sees_time(expr),
            Node::Spline(id, ..) => {
                let spline = arena.splines().get(id.index());
                sees_time(expr) && spline.is_some_and(|spline| spline.jump(0).is_some())
            }
            _ => false,
        };
        let is_jumping = |stop: &&Stop| arena.reachable(&[stop.contact.gap]).into_iter().any(jumps);
        let told = |stop: &Stop| {
            let name = &stop.quantity.name;
            let message = format!(
                "the gap of `{name}` chooses by time: where its values do not meet, a body that rests on it jumps with it, \
                 and no impact is computed"
            );
            Diagnostic::new(stop.span, message)
                .help("let the pieces meet, or take a `linear` table of time, whose bends are impacts")
        };
        self.stops.iter().filter(is_jumping).map(told).collect()
    }

    /// The largest way that a cubic table goes between two points of equal values.
    fn overshoot(&self, table: &Table) -> Option<Diagnostic> {
        let spline =
            self.spline_named(&table.name).filter(|_| table.interpolation == Interpolation::Cubic)?;
        let values = || spline.segments.iter().map(|segment| segment.coefficients[0]);
        let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
        let dwells: Vec<(usize, f64)> = spline.overshoots().collect();
        let count = spline.segments.len();
        let is_flat = |at: usize| dwells.iter().any(|(other, _)| *other == at % count);
        let is_told = |at: usize, share: f64| {
            let [long, short] = OVERSHOOT;
            share > if is_flat(at + 1) || is_flat(at + count - 1) { long } else { short }
        };
        let told =
            dwells.iter().map(|(at, away)| (*at, away / range)).filter(|(at, share)| is_told(*at, *share));
        let (at, share) = told.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let (name, percent) = (&table.name, 100.0 * share);
        let message = format!(
            "behind this point `{name}` goes away from its value by {percent:.1} % of its range, and comes back"
        );
        // the value that holds before the first point is no piece between two
        let Points::Curve(points, outside) = &table.points else { return None };
        let before = match outside {
            Outside::By(Beyond::Hold) => 1,
            Outside::By(Beyond::Refuse) => 2,
            Outside::By(Beyond::Extend | Beyond::Periodic) | Outside::After(_) => 0,
        };
        let point = points.get(at.checked_sub(before)?)?;
        Some(Diagnostic::new(point.x.span, message).help(if table.word == "profile" {
            "a cubic spline overshoots where it is to dwell; give more points there, or compose the motion of laws that \
             rest at both ends, such as `cycloidal`"
        } else {
            "a `cubic` table overshoots; a `monotone` one does not"
        }))
    }

    /// Parameters, inputs, definitions and tables that no formula uses. The copies that a loop or an assembly
    /// makes of a statement are unused if all of them are.
    fn unused(&self, declaration: &Declaration) -> Vec<Diagnostic> {
        let mut statements: BTreeMap<usize, Option<Diagnostic>> = BTreeMap::new();
        for item in &declaration.items {
            let (what, name) = match &item.kind {
                ItemKind::Parameter { name, .. } | ItemKind::Binding { name, .. } => ("parameter", name),
                ItemKind::Input { name, .. } => ("input", name),
                ItemKind::Memory { name, .. } => ("memory", name),
                ItemKind::Let { name, .. } => ("definition", name),
                ItemKind::Table(table) => (table.word, &table.name),
                _ => continue,
            };
            let warning = || {
                Diagnostic::new(name.span(), format!("this {what} is never used"))
                    .help("use it in a formula, or remove it")
            };
            let statement = statements.entry(item.position).or_insert_with(|| Some(warning()));
            if self.scope.used.contains(&name.to_string()) {
                *statement = None;
            }
        }
        statements.into_values().flatten().collect()
    }
}
