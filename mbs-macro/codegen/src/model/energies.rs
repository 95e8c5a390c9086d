//! `potential magnet = k/x;` and `dissipation oil = c*der(x)^2/2;`: forces as derivatives.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr};
use proc_macro2::Ident;

use super::names::Place;
use super::resolver::Resolver;
use crate::diagnostics::Diagnostic;
use crate::mechanics::Work;
use crate::syntax::{EnergyRole, Formula};

const ENERGY: Dimension = Dimension::of(1, 2, -2);

impl Resolver<'_> {
    /// −∂V/∂q along every coordinate, or −∂R/∂q̇.
    pub(super) fn resolve_energy(&mut self, name: &Ident, role: EnergyRole, value: &Formula) {
        if !self.declare_load(name) {
            return;
        }
        let (place, what, dimension) = match role {
            EnergyRole::Potential => (Place::Potential, "a potential", ENERGY),
            EnergyRole::Dissipation => (Place::Load, "a dissipation", ENERGY.over(Dimension::TIME)),
        };
        let value = self.scope.formula_of(value, place, (what, dimension), &mut self.errors);
        let Some(value) = value else { return };
        let algebra = Algebra::new(&mut self.scope.arena);
        let slopes = match role {
            EnergyRole::Potential => self.scope.motion.slopes(algebra.scalar(value)),
            EnergyRole::Dissipation => self.scope.motion.slopes_of_rate(algebra.scalar(value)),
        };
        let forces: Vec<(usize, Expr)> =
            slopes.into_iter().map(|(at, slope)| (at, (-algebra.scalar(slope)).expr())).collect();
        // a dissipation that depends on a state resists no change of it
        let of_bodies = forces.into_iter().filter(|(at, _)| !self.coordinates[*at].is_own());
        let of_bodies: Vec<(usize, Expr)> = of_bodies.collect();
        if of_bodies.is_empty() {
            let is_in_pieces = role == EnergyRole::Potential && self.depends_on_coordinates(value);
            let error = without_force(name, role, is_in_pieces);
            self.errors.push(error);
            return;
        }
        let one = self.scope.arena.one();
        for (at, force) in of_bodies {
            self.push_work(name, Work { force, along: vec![(at, one)] });
        }
        if role == EnergyRole::Potential {
            self.potentials.push(value);
        }
    }
}

fn without_force(name: &Ident, role: EnergyRole, is_in_pieces: bool) -> Diagnostic {
    let (of, example) = match role {
        EnergyRole::Potential => ("coordinate", "potential magnet = k/x;"),
        EnergyRole::Dissipation => ("rate of a coordinate", "dissipation oil = c*der(x)^2/2;"),
    };
    let message = match is_in_pieces {
        true => format!("`{name}` exerts no force: it is constant from piece to piece, and so has no slope"),
        false => format!("`{name}` exerts no force: no {of} is left in it"),
    };
    Diagnostic::new(name.span(), message).help(format!("its slopes are the forces, as in `{example}`"))
}
