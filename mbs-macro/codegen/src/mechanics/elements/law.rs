//! Forces and torques between two places by a law of the declaration's own:
//! `force f (a.p, b.q) = k*(length - l) + c*rate;`, `torque m (a, b) = -k*angle;`.
//!
//! The law of a force knows the distance d of its places as `length` and ḋ as `rate`. It is a tension F: it does
//! the work −F δd. The law of a torque knows φ = φ₁ − φ₂ as `angle` and φ̇ as `rate`, and turns the first body: it
//! does the work T δφ.

use mbs_symbolic::units::Dimension;

use super::kind::{ElementKind, Known, Places};
use super::properties::{FORCE, Property, RATE, SPEED, TORQUE};

/// The name of the law among the properties.
pub const LAW: &str = "law";

pub const FORCE_BETWEEN: ElementKind = ElementKind {
    word: "force",
    meaning: "pulls two points together by a law",
    example: "(arm.end, ground) = 100 [N/m]*(length - 0.1 [m]) + 5 [N*s/m]*rate;",
    places: Places::Two,
    properties: &[Property::varying(LAW, FORCE)],
    said: |_| Ok(()),
    knows: &[
        Known {
            name: "length",
            dimension: Dimension::LENGTH,
            value: |force, _| force.first.distance_to(force.second),
        },
        Known {
            name: "rate",
            dimension: SPEED,
            value: |force, effects| effects.rate(force.first.distance_to(force.second)).shared(),
        },
    ],
    moved: |force| (force.first.position - force.second.position).components().into(),
    mend: "let it act between points that move apart",
    needs: None,
    refuses: |_| None,
    forces: |force, effects| {
        let distance = force.first.distance_to(force.second);
        effects.gap = Some((distance.expr(), force.algebra.number(0).expr()));
        let tension = force.get(LAW)?.shared();
        effects.apply(-tension, distance);
        effects.exert(tension, FORCE);
        Some(())
    },
};

pub const TORQUE_BETWEEN: ElementKind = ElementKind {
    word: "torque",
    meaning: "turns two bodies against each other by a law",
    example: "(arm, ground) = -5 [N*m]*angle - 0.1 [N*m*s]*rate;",
    places: Places::Two,
    properties: &[Property::varying(LAW, TORQUE)],
    said: |_| Ok(()),
    knows: &[
        Known { name: "angle", dimension: Dimension::NONE, value: |torque, _| torque.relative_angle() },
        Known {
            name: "rate",
            dimension: RATE,
            value: |torque, effects| effects.rate(torque.relative_angle()),
        },
    ],
    moved: |torque| vec![torque.relative_angle()],
    mend: "one of its bodies has to turn",
    needs: None,
    refuses: |_| None,
    forces: |element, effects| {
        let (torque, angle) = (element.get(LAW)?.shared(), element.relative_angle());
        effects.apply(torque, angle);
        effects.exert(torque, TORQUE);
        Some(())
    },
};
