//! The profile of a cam: the distance ρ of its follower, over the polar angle.
//!
//! The angle is that of an arctangent and runs from −180° to 180°, so ρ has to
//! be the same at both ends, and rise as steeply. Otherwise the follower would
//! jump, or be struck, wherever the cam turns through that position.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Number, Symbol};
use rustc_hash::FxHashMap as HashMap;

use super::known::Typed;
use super::names::{Local, Place};
use super::resolver::Resolver;
use super::{Meaning, Requirement};
use crate::diagnostics::Diagnostic;
use crate::mechanics::joints::POLAR_ANGLE;
use crate::quantity::Comparison;
use crate::syntax::{Formula, Joint};

/// A jump of this share of the radius is one. Single precision meets it with
/// sines of several turns.
const JUMP: f64 = 1e-4;

/// Parameters are changed by up to this share, to see whether a profile closes
/// whatever they are.
const CHANGES: [f64; 3] = [0.9, 1.07, 1.19];

impl Resolver<'_> {
    /// ρ at a polar angle: a length that closes around a turn.
    pub(super) fn polar_profile(&mut self, joint: &Joint, formula: &Formula, angle: Expr) -> Option<Expr> {
        let profile = self.profile_at(joint, formula, angle)?;
        self.closes(joint, formula);
        Some(profile)
    }

    fn profile_at(&mut self, joint: &Joint, formula: &Formula, angle: Expr) -> Option<Expr> {
        let typed = Typed { expr: angle, dimension: Some(Dimension::NONE) };
        self.scope.locals.push(Local { name: POLAR_ANGLE, typed });
        let what = format!("the profile of `{}`", joint.name);
        let place = (what.as_str(), Dimension::LENGTH);
        let profile = self.scope.formula_of(formula, Place::Property, place, &mut self.errors);
        self.scope.locals.clear();
        profile
    }

    /// Refuses a profile that jumps or bends sharply at half a turn, at the
    /// declared parameters; at others, where that may happen, the jump is
    /// refused when a mechanism is built.
    fn closes(&mut self, joint: &Joint, formula: &Formula) -> Option<()> {
        // A profile cannot depend on time, so the symbol is free to be the angle.
        let (time, half_turn) = (self.scope.time, std::f64::consts::PI);
        let angle = self.scope.arena.variable(time);
        let profile = self.profile_at(joint, formula, angle)?;
        let direction = HashMap::from_iter([(time, self.scope.arena.one())]);
        let slope = self.scope.arena.derivative(profile, &direction);
        let at = |expr: Expr, angle: f64, change: &dyn Fn(usize) -> f64| {
            let value = |symbol: Symbol| match self.scope.meaning(symbol) {
                Meaning::Parameter(at) => self.parameters[at].value * change(at),
                Meaning::Time => angle,
                _ => f64::NAN,
            };
            self.scope.arena.evaluate(&[expr], &value)[0]
        };
        let declared = |_: usize| 1.0;
        let (from, to) = (at(profile, -half_turn, &declared), at(profile, half_turn, &declared));
        let size = from.abs().max(to.abs());
        if (to - from).abs() > JUMP * size {
            self.errors.push(jump(joint, formula, "radius", [to, from].map(|radius| (radius, "m"))));
            return None;
        }
        // just inside, where pieces have no other neighbour
        let near = half_turn - 1e-7;
        let (from, to) = (at(slope, -near, &declared), at(slope, near, &declared));
        if (to - from).abs() > JUMP * size.max(from.abs()).max(to.abs()) {
            self.errors.push(jump(joint, formula, "slope", [to, from].map(|slope| (slope, "m/rad"))));
            return None;
        }
        let differs = |scale: f64| {
            // each parameter by another amount
            let change = |at: usize| 1.0 + (scale - 1.0) * (1.0 + 0.37 * at as f64).sin();
            let (from, to) = (at(profile, -half_turn, &change), at(profile, half_turn, &change));
            (to - from).abs() > JUMP * from.abs().max(to.abs())
        };
        if CHANGES.into_iter().any(differs) {
            self.require_closed(joint, formula);
        }
        Some(())
    }

    /// |ρ(180°) − ρ(−180°)| is small against ρ(180°), for the parameters of a run.
    fn require_closed(&mut self, joint: &Joint, formula: &Formula) -> Option<()> {
        let ends = [Number::pi(1, 1), Number::pi(-1, 1)].map(|angle| self.scope.arena.number(angle));
        let to = self.profile_at(joint, formula, ends[0])?;
        let from = self.profile_at(joint, formula, ends[1])?;
        let algebra = Algebra::new(&mut self.scope.arena);
        let [to, from] = [to, from].map(|radius| algebra.scalar(radius));
        let jump = to - from;
        let allowed = Number::from(JUMP) * to;
        self.scope.requirements.push(Requirement {
            name: format!("jump of the radius of {}", joint.name),
            value: jump.expr(),
            difference: (jump.squared() - allowed.squared()).expr(),
            comparison: Comparison::LessOrEqual,
            text: "the profile of a cam has to be the same at -180 deg and at 180 deg".to_owned(),
            span: formula.span,
        });
        Some(())
    }
}

fn jump(joint: &Joint, formula: &Formula, what: &str, [to, from]: [(f64, &str); 2]) -> Diagnostic {
    let [to, from] = [to, from].map(|(value, unit)| {
        let digits = format!("{value:.3e}");
        let rounded: f64 = digits.parse().unwrap_or(value);
        format!("{rounded} {unit}")
    });
    let message = format!(
        "the {what} of `{}` jumps at half a turn: it is {to} at 180 deg and {from} at -180 deg",
        joint.name
    );
    Diagnostic::new(formula.span, message).help(
        "`angle` runs from -180 deg to 180 deg, where the profile has to close: use `sin(angle)` and `cos(angle)`, \
         or a `profile … period 360 [deg]`",
    )
}
