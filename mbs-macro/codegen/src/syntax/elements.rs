//! Force elements, a word with places and a block of properties:
//! `spring s (a.p, b.q) { stiffness = k; length = l; damping = c; }`.

use syn::parse::ParseStream;
use syn::{Ident, Result, braced};

use super::formula::is_vector;
use super::joints::two_places;
use super::words::{block, equals, expect_word, helped, name, property_name, semicolon};
use super::{Element, ElementProperty, ItemKind, Load};
use crate::mechanics::elements::{ElementKind, LAW, Places};

pub(super) fn element(input: ParseStream<'_>, kind: &'static ElementKind) -> Result<ItemKind> {
    let name = name(input)?;
    let example = format!("{} {name} {}", kind.word, kind.example);
    let (first, second) = if kind.places != Places::One {
        let (first, second) =
            two_places(input, "what it connects is", &format!("a {}", kind.word), &example)?;
        (first, Some(second))
    } else {
        expect_word(input, "on", &example)?;
        (input.parse()?, None)
    };
    let along = if kind.places == Places::TwoAlong {
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
    Ok(ItemKind::Element(Box::new(Element { name, kind, first, second, along, properties })))
}

/// `(a.p, b.q) = k*(length - l) + c*rate;` behind the name of a force or a torque.
pub(super) fn law(input: ParseStream<'_>, name: Ident, kind: &'static ElementKind) -> Result<ItemKind> {
    let example = format!("{} {name} {}", kind.word, kind.example);
    let (first, second) = two_places(input, "what it connects is", &format!("this {}", kind.word), &example)?;
    let equals = equals(input)?;
    if is_vector(input) {
        let help = format!("as in `{example}`");
        return Err(helped(
            input.span(),
            format!("the law of a {} between two places is a scalar", kind.word),
            help,
        ));
    }
    let value = Load::Scalar(input.parse()?);
    semicolon(input)?;
    let properties = vec![ElementProperty { name: Ident::new(LAW, equals), value }];
    let second = Some(second);
    Ok(ItemKind::Element(Box::new(Element { name, kind, first, second, along: None, properties })))
}

/// `stiffness = 3 [N/m];` or `wind = (5, 0) [m/s];`
fn property(input: ParseStream<'_>) -> Result<ElementProperty> {
    let name = property_name(input)?;
    equals(input)?;
    let value = if is_vector(input) { Load::Vector(input.parse()?) } else { Load::Scalar(input.parse()?) };
    semicolon(input)?;
    Ok(ElementProperty { name, value })
}
