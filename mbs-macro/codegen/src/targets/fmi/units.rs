//! Units as FMI defines them: products of SI units, and others for display.

use std::collections::BTreeMap;

use mbs_symbolic::units::{Dimension, lookup};

use super::xml::Element;
use crate::compiled::Quantity;

/// The unit that values of a variable have, and the one that people are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Its name; empty of a bare number.
    pub name: String,
    dimension: Dimension,
    /// The power of rad.
    angles: i8,
    /// The declared unit, and how many SI units one of it is, where it is another.
    pub display: Option<(String, f64)>,
}

impl Unit {
    /// That of a parameter, an input or an output.
    pub fn of(quantity: &Quantity) -> Self {
        let unit = Self::si(quantity.dimension, angles(&quantity.unit));
        let is_other = !quantity.unit.is_empty() && quantity.unit != unit.name;
        Self { display: is_other.then(|| (quantity.unit.clone(), quantity.scale)), ..unit }
    }

    /// That of a coordinate, which is a length or an angle, or of its derivative of an order.
    pub fn of_coordinate(dimension: Dimension, order: i16) -> Self {
        let is_angle = dimension == Dimension::NONE;
        Self::si(dimension.times(Dimension::of(0, 0, -order)), i8::from(is_angle))
    }

    /// The SI unit of a dimension with a power of rad.
    pub fn si(dimension: Dimension, angles: i8) -> Self {
        // FMI has no unit with a fractional power
        let unit = dimension.exponents().map(|_| dimension.si_unit()).unwrap_or_default();
        let name = match (unit, angles) {
            (name, 0) => name,
            (name, 1) if name.is_empty() => "rad".to_owned(),
            (name, 1) if name.starts_with("1/") => name.replacen('1', "rad", 1),
            (name, -1) => format!("{}/rad", if name.is_empty() { "1" } else { &name }),
            (name, power) if name.is_empty() => format!("rad^{power}"),
            (name, power) => format!("{name}*rad^{power}"),
        };
        Self { name, dimension, angles, display: None }
    }
}

/// The power of an angle in a unit as it was written: 1 of `rpm`, −1 of `N*m/deg`.
fn angles(unit: &str) -> i8 {
    let (mut sum, mut sign, mut rest) = (0_i8, 1, unit);
    while !rest.is_empty() {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let (name, exponent) = rest[..end].split_once('^').unwrap_or((&rest[..end], "1"));
        let is_angle =
            lookup(name.trim()).is_some_and(|it| it.dimension == Dimension::NONE) || name.trim() == "rpm";
        if is_angle {
            sum = sum.saturating_add(sign * exponent.trim().parse::<i8>().unwrap_or(1));
        }
        sign = if rest[end..].starts_with('/') { -1 } else { 1 };
        rest = rest.get(end + 1..).unwrap_or_default();
    }
    sum
}

/// The definitions of all units of some variables.
pub fn definitions<'a>(units: impl Iterator<Item = &'a Unit>) -> Element {
    let mut known: BTreeMap<&str, (&Unit, BTreeMap<&str, f64>)> = BTreeMap::new();
    for unit in units.filter(|unit| !unit.name.is_empty()) {
        let (_, displays) = known.entry(&unit.name).or_insert_with(|| (unit, BTreeMap::new()));
        displays.extend(unit.display.iter().map(|(name, scale)| (name.as_str(), *scale)));
    }
    Element::new("UnitDefinitions").holding(known.into_iter().map(|(name, (unit, displays))| {
        let exponents = unit.dimension.exponents().unwrap_or_default();
        let powers = ["kg", "m", "s", "A", "K"].into_iter().zip(exponents);
        let base = powers.chain([("rad", unit.angles)]).filter(|(_, power)| *power != 0);
        let base = base.fold(Element::new("BaseUnit"), |base, (unit, power)| base.with(unit, power));
        // display value = factor * value
        let displays = displays.into_iter().map(|(name, scale)| {
            Element::new("DisplayUnit").with("name", name).number("factor", Some(1.0 / scale))
        });
        Element::new("Unit").with("name", name).holding([base]).holding(displays)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_counted_as_they_are_written() {
        for (unit, expected) in
            [("rpm", 1), ("N*m/deg", -1), ("m", 0), ("rad/s", 1), ("N*m*s/rad", -1), ("rad^2", 2), ("", 0)]
        {
            assert_eq!(angles(unit), expected, "{unit}");
        }
    }

    #[test]
    fn units_have_names_and_powers() {
        let named = |dimension, angles| Unit::si(dimension, angles).name;
        assert_eq!(named(Dimension::NONE, 1), "rad");
        assert_eq!(named(Dimension::of(0, 0, -1), 1), "rad/s");
        assert_eq!(named(Dimension::of(1, 2, -2), -1), "N*m/rad");
        assert_eq!(Unit::of_coordinate(Dimension::LENGTH, 2).name, "m/s^2");
        assert_eq!(Unit::of_coordinate(Dimension::NONE, 0).name, "rad");
        let speed = Quantity {
            name: "omega".into(),
            doc: String::new(),
            unit: "rpm".into(),
            scale: 0.5,
            dimension: Dimension::of(0, 0, -1),
        };
        let text = definitions([Unit::of(&speed)].iter()).to_string();
        assert!(
            text.contains("<Unit name=\"rad/s\">") && text.contains("<BaseUnit s=\"-1\" rad=\"1\"/>"),
            "{text}"
        );
        assert!(text.contains("<DisplayUnit name=\"rpm\" factor=\"2.0\"/>"), "{text}");
    }
}
