//! Force elements, a file each: how they are declared, their properties, and the forces
//! that come of them. A new element is such a file and a row of [`ELEMENTS`].

mod bushing;
mod contact;
mod drag;
mod effects;
mod friction;
mod kind;
mod law;
mod motor;
mod nearest;
mod one_sided;
mod properties;
mod spring;

pub use contact::{LOOSE_PRISMATIC, LOOSE_REVOLUTE};
pub use effects::{Effects, Element, Exerts, Sticks};
pub use friction::{COULOMB, LUGRE, PRESLIDING, is_divisor};
pub use kind::{ElementKind, Freedom, Known, Places};
pub use law::{FORCE_BETWEEN, LAW, TORQUE_BETWEEN};
pub use properties::{Given, Property, Range, Unsaid};

/// Every kind of element.
pub const ELEMENTS: &[&ElementKind] = &[
    &spring::SPRING,
    &spring::TORSION_SPRING,
    &one_sided::ROPE,
    &one_sided::STRUT,
    &bushing::BUSHING,
    &motor::MOTOR,
    &friction::FRICTION,
    &friction::TORSION_FRICTION,
    &drag::DRAG,
    &contact::CONTACT,
];
