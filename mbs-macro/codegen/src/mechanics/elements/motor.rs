//! A motor by its torque–speed line: T = stall·(level − ω/no_load) on the first
//! body, the reaction on the second, ω = φ̇₁ − φ̇₂.
//!
//! A direct-current machine with a constant voltage has this line; `level` is
//! the voltage as a share of the nominal one.

use mbs_symbolic::units::Dimension;

use super::properties::{Property, RATE, TORQUE};
use super::{Effects, Element, ElementKind, Places};

pub const MOTOR: ElementKind = ElementKind {
    word: "motor",
    meaning: "turns a body along its torque-speed line",
    example: "(rotor, ground) { stall = 2 [N*m]; no_load = 3000 [rpm]; }",
    places: Places::Two,
    properties: &[
        Property::fixed("stall", TORQUE).not_negative(),
        Property::fixed("no_load", RATE).positive(),
        Property::varying("level", Dimension::NONE),
    ],
    said: |given| given.all(&["stall", "no_load"], "{ stall = 2 [N*m]; no_load = 3000 [rpm]; }"),
    knows: &[],
    moved: |motor| vec![motor.relative_angle()],
    mend: "one of its bodies has to turn",
    needs: None,
    refuses: |_| None,
    forces,
};

fn forces(motor: &Element<'_>, effects: &mut Effects<'_>) -> Option<()> {
    let (stall, no_load) = (motor.get("stall")?, motor.get("no_load")?);
    let level = motor.get("level").unwrap_or_else(|| motor.algebra.number(1));
    let angle = motor.relative_angle();
    let torque = (stall * (level - effects.rate(angle) / no_load)).shared();
    effects.apply(torque, angle);
    effects.exert(torque, TORQUE);
    Some(())
}
