//! The mechanism in motion, as data for the page's script.

use serde_json::{Value, json};

use super::data::number;

/// A moving picture: points whose places are known at every instant, and what
/// is drawn between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// The caption.
    pub title: String,
    /// The instants, ascending, in s.
    pub times: Vec<f64>,
    /// For every instant the points, in m.
    pub points: Vec<Vec<[f64; 2]>>,
    /// Pairs of points that a bar joins.
    pub bars: Vec<(usize, usize)>,
    /// Points at which a sliding block is drawn.
    pub blocks: Vec<usize>,
    /// Points that are fixed to the ground.
    pub fixed: Vec<usize>,
    /// Points whose path is drawn.
    pub traced: Vec<usize>,
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
        // A tenth of a millimetre is finer than any screen; it keeps the page small.
        let place = |p: &[f64; 2]| p.map(|x| (x * 1e5).round() / 1e5);
        let frames: Vec<Vec<_>> =
            self.points.iter().map(|points| points.iter().map(place).collect()).collect();
        let readouts: Vec<_> = self
            .readouts
            .iter()
            .map(|r| json!({ "name": r.name, "unit": r.unit, "values": numbers(&r.values) }))
            .collect();
        json!({
            "kind": "animation", "title": self.title, "times": numbers(&self.times), "frames": frames,
            "bars": self.bars, "blocks": self.blocks, "fixed": self.fixed, "traced": self.traced,
            "readouts": readouts,
        })
    }
}
