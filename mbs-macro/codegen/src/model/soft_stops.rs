//! `stop end: x <= 0.2 [m] { stiffness = 1 [MN/m]; damping = 2 [kN*s/m]; }`: ends of the way that give way.
//!
//! Where the gap g is negative, by δ = −g, a force N pushes along it. With friction it rubs along s.
//!
//! ```text
//! N = max(0, k δ + c δ̇),   F = −μ N tanh(ṡ/v_t)
//! ```
//!
//! It is a force like others: nothing jumps, and no memory tells of it.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr};
use proc_macro2::Ident;

use super::measures::{ENERGY, TIME};
use super::resolver::Resolver;
use super::stop_properties::{ALONG, FRICTION, Row, Takes};
use crate::diagnostics::Diagnostic;
use crate::mechanics::elements::Effects;
use crate::syntax::{Condition, Property};

const STIFFNESS: &str = "stiffness";
const DAMPING: &str = "damping";
const TRANSITION: &str = "transition";
const PROPERTIES: &[Row] = &[
    (STIFFNESS, Takes::Positive(|gap| ENERGY.over(gap).over(gap))),
    (DAMPING, Takes::NotNegative(|gap| ENERGY.times(TIME).over(gap).over(gap))),
    (FRICTION, Takes::NotNegative(|_| Dimension::NONE)),
    (ALONG, Takes::Way),
    (TRANSITION, Takes::Positive(|gap| gap.over(TIME))),
];

/// True of a stop that gives way.
pub(super) fn is_soft(properties: &[Property]) -> bool {
    properties.iter().any(|Property { name, .. }| name == STIFFNESS || name == DAMPING)
}

impl Resolver<'_> {
    pub(super) fn resolve_soft_stop(&mut self, name: &Ident, condition: &Condition, properties: &[Property]) {
        if !self.declare_load(name) {
            return;
        }
        let Some((gap, dimension)) = self.gap(name, condition) else { return };
        let Some(found) = self.read_properties(name, dimension, (PROPERTIES, properties)) else { return };
        let get = |property: &str| found.get(property).copied();
        let Some(friction) = self.friction_at(name, [FRICTION, ALONG].map(get)) else { return };
        let Some(stiffness) = get(STIFFNESS) else {
            let message = format!("`{name}` does not say its `{STIFFNESS}`");
            self.errors.push(Diagnostic::new(name.span(), message).help(EXAMPLE));
            return;
        };
        let rubs = match (friction, get(TRANSITION)) {
            (Some((size, along)), Some(transition)) => Some([size, along, transition]),
            (None, None) => None,
            (friction, _) => {
                let missing = if friction.is_some() { TRANSITION } else { FRICTION };
                let message = format!("`{name}` does not say its `{missing}`");
                self.errors.push(Diagnostic::new(name.span(), message).help(EXAMPLE));
                return;
            }
        };
        self.push_soft([gap, stiffness], get(DAMPING), rubs, (name, ENERGY.over(dimension)));
    }

    /// Adds the forces of a gap with its stiffness and damping, and with its friction: coefficient, way and transition.
    fn push_soft(
        &mut self,
        [gap, stiffness]: [Expr; 2],
        damping: Option<Expr>,
        rubs: Option<[Expr; 3]>,
        (name, dimension): (&Ident, Dimension),
    ) {
        let mut effects = Effects::new(&self.scope.motion);
        let algebra = Algebra::new(&mut self.scope.arena);
        let [gap, stiffness] = [gap, stiffness].map(|value| algebra.scalar(value));
        let (zero, depth) = (algebra.number(0), (-gap).shared());
        let touches = depth.greater(zero).shared();
        let elastic = stiffness * depth;
        let push = match damping {
            Some(damping) => elastic - algebra.scalar(damping) * effects.rate(gap),
            None => elastic,
        };
        let push = touches.gate(zero.max(push)).shared();
        effects.energies.push(touches.gate(stiffness * depth.squared() / 2).expr());
        effects.apply(push, gap);
        if let Some(rubs) = rubs {
            let [size, along, transition] = rubs.map(|value| algebra.scalar(value));
            effects.apply(-(size * push * (effects.rate(along) / transition).tanh()), along);
        }
        effects.exert(push, dimension);
        let Effects { applied, energies, exerts, .. } = effects;
        self.push_forces(name, applied, energies, exerts);
    }
}

const EXAMPLE: &str = "as in `{ stiffness = 1 [MN/m]; damping = 2 [kN*s/m]; friction = 0.3; along = foot.x; transition = 1 [mm/s]; }`";
