//! `mbs export dxf`: a mechanism as a drawing for CAD programs.
//!
//! The drawing is DXF of release 12 (AC1009), which every program reads: groups of a code and
//! a value on two lines. It has no unit of its own; coordinates are in mm.

use std::fmt::{Display, Write};
use std::path::PathBuf;

use clap::Args;
use mbs_runtime::Sketch;

use crate::command::options::{Named, Values, signed};
use crate::models::Models;
use crate::picture::{Extent, Picture, Shape};
use crate::{Error, Settings, files, say};

/// The radius of a joint's circle as a part of the size of the drawing.
const JOINT: f64 = 0.015;

/// Layers beside those of the bodies.
const LAYERS: [&str; 4] = ["joints", "ground", "rails", "rods"];

type Point = [f64; 2];

#[derive(Args)]
#[command(
    about = "Write a mechanism as a DXF drawing in mm, at its start or at a time of its motion",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(super) struct Arguments {
    #[command(flatten)]
    model: Named,
    /// The drawing to write
    #[arg(long, value_name = "FILE.dxf")]
    out: PathBuf,
    /// The time of the drawing in s, or with a unit [default: the start]
    #[arg(long, value_name = "TIME")]
    at: Option<String>,
    #[command(flatten)]
    values: Values,
}

const EXAMPLES: &str = "\
Each body is a polyline on a layer of its name; joints are circles on the layer `joints`.

Examples:
  mbs export dxf four-bar --out four_bar.dxf
  mbs export dxf jansen-walker --set omega=30rpm --at 0.4s --out walker.dxf";

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let path = &self.out;
        if path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("dxf")) {
            let reason = "a drawing ends in .dxf".into();
            return Err(Error::Name { name: path.display().to_string(), reason });
        }
        let found = self.model.find(models)?;
        let model = found.model();
        let mut asked = self.values.asked(model.info())?;
        self.at.as_ref().map_or(Ok(()), |at| asked.set("end", at))?;
        let settings = asked.settings(model)?;
        // The start is the first instant of a run of one step.
        let end = if self.at.is_some() { settings.end } else { settings.step };
        let settings = Settings { end, ..settings };
        let recording = model.simulate(&settings, &mut |_, _| ())?;
        if let Some(cause) = recording.ended {
            return Err(Error::EndedEarly { cause, kept: String::new() });
        }
        let motion = model.motion(&settings, &recording)?;
        let instant = if self.at.is_some() { motion.places.len().saturating_sub(1) } else { 0 };
        let drawing = drawing(motion.sketch, &Picture::of(&motion), instant);
        files::write(path, drawing.as_bytes())?;
        say(format_args!("written: {}", path.display()))
    }
}

/// The file for an instant of a picture.
fn drawing(sketch: &Sketch, picture: &Picture, instant: usize) -> String {
    let places = picture.points.get(instant).cloned().unwrap_or_default();
    let span = Extent::around(places).map_or(0.0, |extent| extent.span());
    let layer_of = |body: usize| sketch.bodies.get(body).map_or_else(String::new, |body| layer(body.name));
    let mut dxf = Dxf::default();
    dxf.head(LAYERS.into_iter().map(layer).chain((0..sketch.bodies.len()).map(layer_of)));
    let radius = 1e3 * JOINT * span;
    let at = |point: usize| picture.place(instant, point).map(|metres| 1e3 * metres);
    for shape in &picture.shapes {
        match shape {
            Shape::Rail { from, ahead, reach } => {
                let ends = reach
                    .map(|reach| picture.along(instant, *from, *ahead, reach).map(|metres| 1e3 * metres));
                dxf.polyline("rails", &ends, false);
            }
            Shape::Circle { at: centre, rim, colour } => {
                let layer = colour.map_or_else(|| "ground".to_owned(), &layer_of);
                dxf.circle(&layer, at(*centre), 1e3 * picture.apart(instant, *centre, *rim));
            }
            Shape::Ground { at: tip } => dxf.point("ground", at(*tip)),
            Shape::Link { between } | Shape::Spring { between } => {
                dxf.polyline("rods", &between.map(at), false);
            }
            Shape::Bar { between, colour } => dxf.polyline(&layer_of(*colour), &between.map(at), false),
            Shape::Plate { corners, colour } => {
                let corners: Vec<Point> = corners.iter().map(|corner| at(*corner)).collect();
                dxf.polyline(&layer_of(*colour), &corners, true);
            }
            Shape::Dot { at: centre, colour } => dxf.circle(&layer_of(*colour), at(*centre), 2.0 * radius),
            Shape::Block { at: middle, from, ahead, colour } => {
                let along = picture.direction(instant, *from, *ahead);
                dxf.polyline(&layer_of(*colour), &block(at(*middle), along, radius), true);
            }
            Shape::Pin { at: place } | Shape::Weld { at: place } => dxf.circle("joints", at(*place), radius),
            // No part of the mechanism: names, centres, and signs for joints of other kinds.
            Shape::Coil { .. } | Shape::Mark { .. } | Shape::Centre { .. } | Shape::Label { .. } => {}
        }
    }
    dxf.end()
}

/// The corners of a block that slides along a direction.
fn block(middle: Point, along: Point, radius: f64) -> [Point; 4] {
    let across = [-along[1], along[0]];
    [(3.0, 2.0), (-3.0, 2.0), (-3.0, -2.0), (3.0, -2.0)]
        .map(|(x, y)| ahead_of(ahead_of(middle, x * radius, along), y * radius, across))
}

fn ahead_of(from: Point, length: f64, direction: Point) -> Point {
    [from[0] + length * direction[0], from[1] + length * direction[1]]
}

/// The name of a layer: letters, digits, `_`, `$` and `-`, at most 31.
fn layer(name: &str) -> String {
    let letter =
        |letter: char| if letter.is_ascii_alphanumeric() || "_$-".contains(letter) { letter } else { '_' };
    name.chars().take(31).map(letter).collect()
}

#[derive(Default)]
struct Dxf(String);

impl Dxf {
    /// A group: its code and its value.
    fn group(&mut self, code: u16, value: impl Display) {
        // a text takes everything
        let _ = write!(self.0, "{code}\n{value}\n");
    }

    fn head(&mut self, layers: impl Iterator<Item = String>) {
        let mut names: Vec<String> = layers.collect();
        names.sort();
        names.dedup();
        self.group(999, "lengths in mm");
        for (code, value) in [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), (0, "ENDSEC")] {
            self.group(code, value);
        }
        for (code, value) in [(0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LAYER")] {
            self.group(code, value);
        }
        self.group(70, names.len());
        for (at, name) in names.iter().enumerate() {
            self.group(0, "LAYER");
            self.group(2, name);
            self.group(70, 0);
            // The standard colours are 1 to 7.
            self.group(62, 1 + at % 7);
            self.group(6, "CONTINUOUS");
        }
        for (code, value) in [(0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")] {
            self.group(code, value);
        }
    }

    fn entity(&mut self, kind: &str, layer: &str) {
        self.group(0, kind);
        self.group(8, layer);
    }

    fn place(&mut self, [x, y]: Point) {
        for (code, value) in [(10, x), (20, y), (30, 0.0)] {
            self.group(code, value);
        }
    }

    fn point(&mut self, layer: &str, at: Point) {
        self.entity("POINT", layer);
        self.place(at);
    }

    fn circle(&mut self, layer: &str, centre: Point, radius: f64) {
        self.entity("CIRCLE", layer);
        self.place(centre);
        self.group(40, radius);
    }

    fn polyline(&mut self, layer: &str, corners: &[Point], is_closed: bool) {
        self.entity("POLYLINE", layer);
        // vertices follow
        self.group(66, 1);
        self.place([0.0; 2]);
        self.group(70, u8::from(is_closed));
        for corner in corners {
            self.entity("VERTEX", layer);
            self.place(*corner);
        }
        self.entity("SEQEND", layer);
    }

    fn end(mut self) -> String {
        self.group(0, "ENDSEC");
        self.group(0, "EOF");
        self.0
    }
}
