//! The equations of a mechanism for people to read, and its picture, for the life of the
//! process.

use mbs_codegen::compiled;
use mbs_runtime::sketch::{Body, Joint, Spring};
use mbs_runtime::{Derivation, Elimination, Formula, Sketch};

use crate::statics::{leak, text};

/// The equations and their elimination. Formulas that are 0 are left out, as `mechanism!`
/// does.
pub fn derivation(derivation: &compiled::Derivation) -> Derivation {
    let some = |formulas: &[compiled::Formula]| {
        leak(formulas.iter().filter(|formula| !formula.is_zero).map(formula))
    };
    Derivation {
        given: leak(derivation.given.iter().map(formula)),
        phi: some(&derivation.phi),
        phi_q: some(&derivation.phi_q),
        phi_t: some(&derivation.phi_t),
        phi_dot: some(&derivation.phi_dot),
        gamma: some(&derivation.gamma),
        mass: some(&derivation.mass),
        forces: some(&derivation.forces),
        rates: some(&derivation.rates),
        samples: leak(derivation.samples.iter().map(formula)),
        keeps_energy: derivation.keeps_energy,
        kinetic_energy: formula(&derivation.kinetic_energy),
        potential_energy: formula(&derivation.potential_energy),
        strategy: derivation.strategy,
        order: leak(derivation.order.iter().map(elimination)),
    }
}

fn formula(formula: &compiled::Formula) -> Formula {
    Formula {
        of: text(&formula.of),
        of_latex: text(&formula.of_latex),
        by: text(&formula.by),
        by_latex: text(&formula.by_latex),
        text: text(&formula.text),
        latex: text(&formula.latex),
    }
}

fn elimination(step: &compiled::Elimination) -> Elimination {
    Elimination {
        unknowns: leak(step.unknowns.iter().map(|unknown| text(unknown))),
        pivot: text(&step.pivot),
        latex: text(&step.latex),
        is_watched: step.is_watched,
    }
}

/// The picture of a mechanism.
pub fn sketch(sketch: &compiled::Sketch) -> Sketch {
    let body = |body: &compiled::SketchBody| Body {
        name: text(&body.name),
        points: leak(body.points.clone()),
        is_rigid: body.is_rigid,
    };
    let joint = |link: &compiled::Link| Joint {
        name: text(&link.name),
        kind: link.kind,
        first: link.first,
        second: link.second,
        ahead: link.ahead,
    };
    let spring = |link: &compiled::Link| Spring {
        name: text(&link.name),
        kind: link.kind,
        first: link.first,
        second: link.second,
    };
    Sketch {
        points: leak(sketch.points.iter().map(|point| text(point))),
        bodies: leak(sketch.bodies.iter().map(body)),
        ground: leak(sketch.ground.clone()),
        particles: leak(sketch.particles.clone()),
        joints: leak(sketch.joints.iter().map(joint)),
        springs: leak(sketch.springs.iter().map(spring)),
    }
}
