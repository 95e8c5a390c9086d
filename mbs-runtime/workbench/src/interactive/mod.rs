//! A page in which a mechanism runs: one offline HTML file with its WebAssembly module, in which parameters
//! and inputs can be changed and bodies dragged.
//!
//! # How it works
//!
//! The page is put together of the module and the script of its runs (`targets/wasm` of `mbs-codegen`), the
//! tables, the picture of a native run, the equations (`equations`, MathML from the LaTeX of `mbs explain`),
//! and the scripts beside this file. Module and tables are packed. The policy of the page allows these parts
//! and nothing else. Shapes and axes are drawn by the scripts of reports. `tests/page` drives a page in
//! Chromium.
//!
//! A dragged body needs no second mechanism. Let J say how the held place moves with each coordinate. A force
//! f there causes the accelerations M⁻¹Jᵀf, which the kernel `projection` projects onto the constraints. At
//! rest the mechanism goes along them. While it plays they change the velocities every 2 ms, so that steps
//! stay those of the native run.
//!
//! * `session.js` has the run and its rows, `page.js` buttons and keys.
//! * `scene.js` has picture and pointer, `drag.js` a pull on a body.
//! * `quantities.js` has sliders, `curves.js` plots, `files.js` downloads.
//! * `framed.js` tells the frame around the page how the next page goes on.

mod equations;

use std::io::{self, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use mbs_runtime::{Info, Quantity, Stabilization};
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use crate::html::{DRAWING_SCRIPT, SHAPES_SCRIPT, UPLOT_SCRIPT, UPLOT_STYLE, escaped, escaped_json, filled};
use crate::model::without_text;
use crate::picture::json::shape;
use crate::recording::{columns, memories};
use crate::settings::{Start, StartKind};
use crate::{Error, Model, Picture, Settings, Unit};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPTS: [&str; 8] = [
    include_str!("session.js"),
    include_str!("drag.js"),
    include_str!("scene.js"),
    include_str!("quantities.js"),
    include_str!("curves.js"),
    include_str!("files.js"),
    include_str!("page.js"),
    include_str!("framed.js"),
];

/// The handler of errors in the page's script: it shows that this browser cannot run the page.
const FAILED: &str = "(error) => {
  document.getElementById(\"message\").textContent = `This browser cannot run the page: ${error.message}`;
  throw error;
}";

impl dyn Model + '_ {
    /// One HTML file in which the mechanism runs, offline: it can be played, changed and dragged.
    ///
    /// Parameters and inputs at its start, the step, the end and the feedback are those of the settings; `file` is
    /// what its downloads are called.
    ///
    /// # Errors
    /// A mechanism whose declaration is no text, settings that the mechanism refuses, and those that ask for
    /// other runs than such with a constant step of the declared scheme.
    pub fn interactive_page(&self, file: &str, settings: &Settings) -> Result<String, Error> {
        if let Some(other) = other_than_played(settings) {
            let reason = "a page makes constant steps of the declared scheme; leave this out".into();
            return Err(Error::Name { name: other.into(), reason });
        }
        let Start { parameters, inputs, step, .. } = Start::of(self, settings)?;
        let wasm = self.text().ok_or_else(|| without_text(self.info().name))?.wasm()?;
        let recording = self.simulate(settings, &mut |_, _| ())?;
        let picture = Picture::of(&self.motion(settings, &recording)?);
        let info = self.info();
        // what is not named is in SI units
        let all = info.coordinates.iter().zip(shown(info.coordinates)).enumerate();
        let scaled = all.filter(|(_, (quantity, _))| quantity.scale != 1.0);
        let scaled: Vec<(usize, Value)> = scaled.map(|(at, (_, unit))| (at, unit)).collect();
        let of = |most: usize| -> Map<String, Value> {
            let units = scaled.iter().filter(|(at, _)| *at < most);
            units.map(|(at, unit)| (at.to_string(), unit.clone())).collect()
        };
        let (places, rates) = (of(info.lines), of(info.coordinates.len()));
        let data = json!({
            "file": file,
            "step": step,
            "end": settings.end,
            "feedback": feedback(settings),
            "columns": columns(info).iter().map(|column| column.heading()).collect::<Vec<_>>(),
            "parameters": shown(info.parameters),
            "inputs": shown(info.inputs),
            "outputs": shown(info.outputs),
            "places": places,
            "rates": rates,
            "memories": memories(info).iter().map(|(at, unit)| json!([at, unit.read(1.0)])).collect::<Vec<_>>(),
            "holding": holding(info),
            "impulses": info.stops.iter().map(|stop| stop.memory + 1).collect::<Vec<_>>(),
            "start": { "parameters": parameters, "inputs": inputs },
            "bodies": self.sketch().bodies.iter().map(|body| json!({ "name": body.name, "points": body.points })).collect::<Vec<_>>(),
            "picture": drawn(&picture),
        });
        let parts = [&wasm.module[..], data.to_string().as_bytes(), wasm.tables.as_bytes()].map(packed);
        let parts = parts.into_iter().collect::<io::Result<Vec<_>>>().map_err(Error::file("write", file))?;
        Ok(html(info, &json!(parts), &equations::mathml(self.derivation())?))
    }
}

/// The option that asks for other steps than a page makes, if there is one.
pub(crate) fn other_than_played(settings: &Settings) -> Option<&'static str> {
    let Settings { signals, scheme, other, tolerances, stabilization, start, from, .. } = settings;
    let asked = [
        ("rtol", tolerances.is_some()),
        ("method", scheme.is_some() || other.is_some()),
        ("input", signals.is_some()),
        ("feedback", *stabilization == Some(Stabilization::Projection)),
        ("start", *start != StartKind::default()),
        ("from", !from.is_empty()),
    ];
    asked.into_iter().find(|(_, is_asked)| *is_asked).map(|(option, _)| option)
}

/// The gains that were asked for; none where the deadbeat ones of the step are meant.
fn feedback(settings: &Settings) -> Value {
    let (Some(alpha), Some(beta)) = (settings.alpha, settings.beta) else { return Value::Null };
    let held = settings.stabilization != Some(Stabilization::PerStage);
    json!({ "held": held, "alpha": alpha, "beta": beta })
}

/// The units in which quantities are shown.
fn shown(quantities: &[Quantity]) -> Vec<Value> {
    let unit = |quantity: &Quantity| {
        let unit = Unit::of(quantity);
        json!({ "unit": unit.name().replace('*', "·"), "scale": unit.read(1.0) })
    };
    quantities.iter().map(unit).collect()
}

/// The places among the inputs of what may hold: stops that are rested on, and modes.
fn holding(info: &Info) -> Vec<usize> {
    let stops = info.stops.iter().map(|stop| stop.memory);
    stops.chain(info.modes.modes.iter().map(|mode| mode.memory)).collect()
}

/// The shapes between the points of the module, and what a run has shown of their places.
fn drawn(picture: &Picture) -> Value {
    let extent = picture.extent();
    json!({
        "shapes": picture.shapes.iter().map(shape).collect::<Vec<_>>(),
        "traced": picture.traced, "weight": picture.weight, "low": extent.low, "high": extent.high,
    })
}

/// Style and script of every page in which a mechanism runs. A page that shows such pages in frames of its own
/// allows them by their [hashes](source_hash) in its policy of content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sources {
    /// The contents of the element `style`.
    pub style: String,
    /// The contents of the element `script`.
    pub script: String,
}

impl Sources {
    /// Those of [interactive pages](Model#method.interactive_page) with one of the [scripts](mbs_live::RUN_SCRIPTS) of a run.
    pub fn of_pages(run: &str) -> Self {
        let scripts = [&[UPLOT_SCRIPT, DRAWING_SCRIPT, SHAPES_SCRIPT, run][..], &SCRIPTS].concat();
        // comments and indents stay at home: a page is to be small
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        // a text that goes over lines is HTML, in which indents say nothing
        let lines = scripts.iter().flat_map(|script| script.lines()).filter(is_code).map(str::trim_start);
        let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
        // the module is unpacked while nothing waits for it
        let script = format!("(async () => {{\n{}\n}})().catch({FAILED});", lines.join("\n"));
        Self { style: format!("{UPLOT_STYLE}\n{STYLE}"), script }
    }
}

/// How a policy of content names the text of an element `script` or `style`.
pub fn source_hash(text: &str) -> String {
    format!("'sha256-{}'", BASE64.encode(Sha256::digest(text.as_bytes())))
}

/// Bytes as they stand in a page: compressed as browsers read it (`deflate-raw`), in letters of base 64.
pub fn packed(bytes: &[u8]) -> io::Result<String> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    Ok(BASE64.encode(encoder.finish()?))
}

/// The page; its policy of content allows this script, this style and the module, and nothing from elsewhere.
fn html(info: &Info, packed: &Value, equations: &str) -> String {
    let rubs = info.frictions.iter().any(|friction| friction.stop.is_some());
    let [free, smooth, rough] = mbs_live::RUN_SCRIPTS;
    let Sources { style, script } = Sources::of_pages(if rubs {
        rough
    } else if info.jumps() {
        smooth
    } else {
        free
    });
    let policy = format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval'; style-src {}",
        source_hash(&script),
        source_hash(&style)
    );
    let parts = [
        ("POLICY", policy),
        ("TITLE", escaped(info.name)),
        ("LEAD", escaped(info.doc.trim())),
        ("EQUATIONS", equations.to_owned()),
        ("PACKED", escaped_json(packed)),
        ("STYLE", style),
        ("SCRIPT", script),
    ];
    filled(PAGE, &parts.each_ref().map(|(name, part)| (*name, part.as_str())))
}
