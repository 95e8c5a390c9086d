//! In which unit a quantity is shown and read.
//!
//! Every command reads, writes and draws a quantity in the unit that is decided here.

use mbs_analysis::{Signal, Variable};
use mbs_runtime::{Dimension, Info, Quantity};

use crate::number::significant;
use crate::quantity::si_unit;

/// The unit of a quantity for people: how it is called, and how many SI units one of it is.
///
/// Tables, files, pictures and the command line take it from here, so that they agree.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    name: String,
    scale: f64,
}

impl Unit {
    /// The unit in which a parameter, an input or an output was declared; the SI unit
    /// where the declaration names none.
    pub fn of(quantity: &Quantity) -> Self {
        if quantity.unit.is_empty() || quantity.scale == 0.0 {
            return Self::si(quantity.dimension);
        }
        Self { name: quantity.unit.to_owned(), scale: quantity.scale }
    }

    /// The unit of a coordinate: m or rad of one of a body, as declared of one of its own.
    pub fn of_coordinate(coordinate: &Quantity) -> Self {
        match coordinate.unit {
            "" => Self::of_place(coordinate.dimension),
            _ => Self::of(coordinate),
        }
    }

    /// The unit of what is a length or an angle: m or rad.
    pub(crate) fn of_place(dimension: Dimension) -> Self {
        let Self { name, scale } = Self::si(dimension);
        Self { name: if name.is_empty() { "rad".into() } else { name }, scale }
    }

    /// The SI unit of the multiplier λ of a constraint with this dimension of Φ: λ does work on Φ,
    /// so it is that of energy over Φ.
    pub fn of_multiplier(phi: Dimension) -> Self {
        Self::si(Dimension::of(1, 2, -2).over(phi))
    }

    /// The unit in which a quantity of an analysis is shown.
    pub fn of_signal(info: &Info, signal: &Signal) -> Self {
        let declared = |list: &[Quantity], at: usize| list.get(at).map(Self::of);
        let found = match signal.variable {
            Variable::Velocity(at) if info.is_own(at) => declared(info.coordinates, at),
            Variable::Coordinate(at) if info.is_own(at) => None,
            Variable::Coordinate(at) => info.coordinates.get(at).map(Self::of_coordinate),
            Variable::Velocity(at) => info.coordinates.get(at).map(|q| Self::of_coordinate(q).per_second()),
            Variable::Input(at) => declared(info.inputs, at),
            Variable::Parameter(at) => declared(info.parameters, at),
            Variable::Output(at) => declared(info.outputs, at),
            Variable::Multiplier(_) => None,
        };
        found.unwrap_or_else(|| Self::si(signal.dimension))
    }

    /// The SI unit of a dimension.
    pub fn si(dimension: Dimension) -> Self {
        Self { name: si_unit(dimension), scale: 1.0 }
    }

    /// The unit of its change with time, in SI units.
    #[must_use]
    pub fn per_second(&self) -> Self {
        Self { name: format!("{}/s", self.name), scale: self.scale }
    }

    /// Its name, such as `N*m`; empty for a bare number.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A value in SI units, expressed in this unit.
    pub fn shown(&self, si: f64) -> f64 {
        si / self.scale
    }

    /// A value in this unit, expressed in SI units.
    pub fn read(&self, shown: f64) -> f64 {
        shown * self.scale
    }

    /// A value in SI units as text in this unit: `60 mm`.
    pub fn text(&self, si: f64, digits: usize) -> String {
        format!("{} {}", significant(self.shown(si), digits), self.name).trim_end().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn quantity(unit: &'static str, scale: f64, dimension: [i8; 3]) -> Quantity {
        let [mass, length, time] = dimension;
        let dimension = Dimension::of(mass, length, time);
        Quantity { name: "q", doc: "", unit, scale, dimension, default: 0.0 }
    }

    #[test]
    fn name_and_size_belong_together() {
        let force = Unit::of(&quantity("kN", 1e3, [1, 1, -2]));
        assert_eq!((force.name(), force.shown(57e3), force.read(57.0)), ("kN", 57.0, 57e3));
        assert_eq!(force.text(57_123.0, 3), "57.1 kN");
        let derived = Unit::of(&quantity("", 1.0, [1, 1, -2]));
        assert_eq!((derived.name(), derived.shown(57e3)), ("N", 57e3));
        let ratio = Unit::of(&quantity("", 1.0, [0, 0, 0]));
        assert_eq!((ratio.name(), ratio.text(0.5, 3).as_str()), ("", "0.5"));
        let angle = Unit::of_coordinate(&quantity("", 1.0, [0, 0, 0]));
        assert_eq!((angle.name(), angle.per_second().name()), ("rad", "rad/s"));
    }
}
