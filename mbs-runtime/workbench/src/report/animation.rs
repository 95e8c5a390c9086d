//! The mechanism in motion, as data for the page's script.

use serde_json::{Value, json};

use super::data::number;
use crate::picture::{Picture, json::shape};

/// A moving picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// The caption.
    pub title: String,
    /// The mechanism that moves.
    pub picture: Picture,
    /// Values shown beside the picture.
    pub readouts: Vec<Readout>,
}

/// A value shown beside a moving picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Readout {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// One value per instant.
    pub values: Vec<f64>,
}

impl Animation {
    pub(super) fn data(&self) -> Value {
        let numbers = |values: &[f64]| values.iter().map(|x| number(*x)).collect::<Vec<_>>();
        let picture = &self.picture;
        let extent = picture.extent();
        // The fourth digit is finer than any screen; the fifth would make the page longer.
        let unit = 10_f64.powf((extent.span() / 5000.0).log10().floor());
        let place = |p: &[f64; 2]| p.map(|x| (x / unit).round() as i64);
        let frames: Vec<Vec<_>> =
            picture.points.iter().map(|points| points.iter().map(place).collect()).collect();
        let readouts: Vec<_> = self
            .readouts
            .iter()
            .map(|r| json!({ "name": r.name, "unit": r.unit, "values": numbers(&r.values) }))
            .collect();
        json!({
            "kind": "animation", "title": self.title, "times": numbers(&picture.times),
            "unit": unit, "frames": frames, "low": extent.low, "high": extent.high,
            "shapes": picture.shapes.iter().map(shape).collect::<Vec<_>>(),
            "traced": picture.traced, "weight": picture.weight, "readouts": readouts,
        })
    }
}
