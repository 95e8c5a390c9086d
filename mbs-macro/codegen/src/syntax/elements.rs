//! Force elements, a word with places and a block of properties:
//! `spring s (a.p, b.q) { stiffness = k; length = l; damping = c; }`.

use syn::parse::ParseStream;
use syn::{Result, braced};

use super::formula::is_vector;
use super::joints::two_places;
use super::words::{block, equals, expect_word, name, semicolon};
use super::{Element, ElementKind, ElementProperty, ItemKind, Load};

/// How an element is written.
pub struct Shape {
    pub word: &'static str,
    pub kind: ElementKind,
    /// Between two places, or `on` one.
    is_between: bool,
    /// Whether `along (ux, uy)` follows the places.
    has_direction: bool,
    /// What follows its name.
    pub example: &'static str,
    /// What it does.
    pub meaning: &'static str,
}

/// Every element.
pub const ELEMENTS: &[Shape] = &[
    Shape {
        word: "spring",
        kind: ElementKind::Spring,
        is_between: true,
        has_direction: false,
        example: "(arm.end, ground) { stiffness = 100 [N/m]; length = 0.1 [m]; }",
        meaning: "pulls two points together or apart, with a damper",
    },
    Shape {
        word: "torsion_spring",
        kind: ElementKind::TorsionSpring,
        is_between: true,
        has_direction: false,
        example: "(arm, ground) { stiffness = 5 [N*m]; angle = 0; }",
        meaning: "turns two bodies against each other, with a damper",
    },
    Shape {
        word: "motor",
        kind: ElementKind::Motor,
        is_between: true,
        has_direction: false,
        example: "(rotor, ground) { stall = 2 [N*m]; no_load = 3000 [rpm]; }",
        meaning: "turns a body along its torque-speed line",
    },
    Shape {
        word: "friction",
        kind: ElementKind::Friction,
        is_between: true,
        has_direction: true,
        example: "(block, ground) along (1, 0) { coefficient = 0.3; normal = 20 [N]; transition = 1e-3 [m/s]; }",
        meaning: "brakes what slides",
    },
    Shape {
        word: "torsion_friction",
        kind: ElementKind::TorsionFriction,
        is_between: true,
        has_direction: false,
        example: "(arm, ground) { torque = 0.1 [N*m]; transition = 0.1 [rad/s]; }",
        meaning: "brakes what turns",
    },
    Shape {
        word: "drag",
        kind: ElementKind::Drag,
        is_between: false,
        has_direction: false,
        example: "on plate { density = 1.2 [kg/m^3]; area = 0.1 [m^2]; coefficient = 1; }",
        meaning: "brakes what moves through a fluid",
    },
];

impl ElementKind {
    /// The word that declares it.
    pub fn word(self) -> &'static str {
        ELEMENTS.iter().find(|shape| shape.kind == self).map_or("element", |shape| shape.word)
    }
}

pub(super) fn element(input: ParseStream<'_>, shape: &Shape) -> Result<ItemKind> {
    let name = name(input)?;
    let example = format!("{} {name} {}", shape.word, shape.example);
    let (first, second) = if shape.is_between {
        let (first, second) =
            two_places(input, "what it connects is", &format!("a {}", shape.word), &example)?;
        (first, Some(second))
    } else {
        expect_word(input, "on", &example)?;
        (input.parse()?, None)
    };
    let along = if shape.has_direction {
        expect_word(input, "along", &example)?;
        Some(input.parse()?)
    } else {
        None
    };
    block(input, &example)?;
    let content;
    braced!(content in input);
    let mut properties = Vec::new();
    while !content.is_empty() {
        properties.push(property(&content)?);
    }
    Ok(ItemKind::Element(Box::new(Element { name, kind: shape.kind, first, second, along, properties })))
}

/// `stiffness = 3 [N/m];` or `wind = (5, 0) [m/s];`
fn property(input: ParseStream<'_>) -> Result<ElementProperty> {
    let name = name(input)?;
    equals(input)?;
    let value = if is_vector(input) { Load::Vector(input.parse()?) } else { Load::Scalar(input.parse()?) };
    semicolon(input)?;
    Ok(ElementProperty { name, value })
}
