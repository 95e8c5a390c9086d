//! A page in which a mechanism runs: one offline HTML file with its WebAssembly module, in which parameters
//! and inputs can be changed and bodies dragged.

mod equations;

use std::io::{self, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use mbs_runtime::{Info, Quantity};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::recording::columns;
use crate::report::{
    DRAWING_SCRIPT, SHAPES_SCRIPT, UPLOT_SCRIPT, UPLOT_STYLE, animation, escaped, escaped_json,
};
use crate::template::filled;
use crate::{Error, Model, Picture, Settings, Unit};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPTS: [&str; 7] = [
    include_str!("session.js"),
    include_str!("drag.js"),
    include_str!("scene.js"),
    include_str!("quantities.js"),
    include_str!("curves.js"),
    include_str!("files.js"),
    include_str!("page.js"),
];

/// What a browser shows that cannot run the page.
const FAILED: &str = "(error) => {
  document.getElementById(\"message\").textContent = `This browser cannot run the page: ${error.message}`;
  throw error;
}";

/// The page of a mechanism whose declaration is a text; nothing of one that is not.
///
/// # Errors
/// Settings that the mechanism refuses, an equation that cannot be typeset.
pub(crate) fn page(name: &str, model: &dyn Model, settings: &Settings) -> Result<Option<String>, Error> {
    let Some(text) = model.text() else { return Ok(None) };
    let wasm = text.wasm()?;
    let recording = model.simulate(settings, &mut |_, _| ())?;
    let picture = Picture::of(&model.motion(settings, &recording)?);
    let info = model.info();
    let data = json!({
        "file": name,
        "module": BASE64.encode(deflated(&wasm.module).map_err(Error::file("write", Path::new(name)))?),
        "step": settings.step,
        "end": settings.end,
        "feedback": feedback(settings),
        "columns": columns(info).iter().map(|column| column.heading()).collect::<Vec<_>>(),
        "parameters": declared(info.parameters),
        "inputs": declared(info.inputs),
        "outputs": declared(info.outputs),
        "bodies": model.sketch().bodies.iter().map(|body| json!({ "name": body.name, "points": body.points })).collect::<Vec<_>>(),
        "picture": drawn(&picture),
    });
    Ok(Some(html(info, &[escaped_json(&data), wasm.tables], &equations::mathml(model.derivation())?)))
}

/// Compressed as browsers read it.
fn deflated(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// The gains that were asked for; none where the deadbeat ones of the step are meant.
fn feedback(settings: &Settings) -> Value {
    let (Some(alpha), Some(beta)) = (settings.alpha, settings.beta) else { return Value::Null };
    let held = settings.stabilization != Some(mbs_runtime::Stabilization::PerStage);
    json!({ "held": held, "alpha": alpha, "beta": beta })
}

/// The units in which quantities are shown.
fn declared(quantities: &[Quantity]) -> Vec<Value> {
    let shown = |quantity: &Quantity| {
        let unit = Unit::of(quantity);
        json!({ "unit": unit.name().replace('*', "·"), "scale": unit.read(1.0) })
    };
    quantities.iter().map(shown).collect()
}

/// The shapes between the points of the module, and what a run has shown of their places.
fn drawn(picture: &Picture) -> Value {
    let extent = picture.extent();
    json!({
        "shapes": picture.shapes.iter().map(animation::shape).collect::<Vec<_>>(),
        "traced": picture.traced, "weight": picture.weight, "low": extent.low, "high": extent.high,
    })
}

/// The page; its policy of content allows this script, this style and the module, and nothing from elsewhere.
fn html(info: &Info, [data, tables]: &[String; 2], equations: &str) -> String {
    let style = format!("{UPLOT_STYLE}\n{STYLE}");
    let scripts =
        [&[UPLOT_SCRIPT, DRAWING_SCRIPT, SHAPES_SCRIPT, mbs_live::RUN_SCRIPT][..], &SCRIPTS].concat();
    // the module is unpacked while nothing waits for it
    let script = format!("(async () => {{\n{}\n}})().catch({FAILED});", scripts.join("\n"));
    let hash = |text: &str| format!("'sha256-{}'", BASE64.encode(Sha256::digest(text.as_bytes())));
    let policy = format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval'; style-src {}",
        hash(&script),
        hash(&style)
    );
    let parts = [
        ("POLICY", policy),
        ("TITLE", escaped(info.name)),
        ("LEAD", escaped(info.doc.trim())),
        ("EQUATIONS", equations.to_owned()),
        ("DATA", data.clone()),
        ("TABLES", tables.clone()),
        ("STYLE", style),
        ("SCRIPT", script),
    ];
    filled(PAGE, &parts.each_ref().map(|(name, part)| (*name, part.as_str())))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use std::path::Path;

    use super::page;
    use crate::{Settings, model};

    fn page_of(file: &str) -> String {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src").join(file);
        let model = model::as_declared(&mbs_live::Text::read(&file).unwrap()).unwrap();
        page("name", &*model, &Settings { end: 0.1, ..model.defaults() }).unwrap().unwrap()
    }

    /// A page is to be sent by mail and opened on a telephone.
    #[test]
    fn a_page_has_less_than_250_kilobytes() {
        for file in ["double_pendulum.rs", "slider_crank.rs", "andrews_squeezer.rs", "jansen_walker.rs"] {
            let length = page_of(file).len();
            assert!(length < 250_000, "{file}: {length} bytes");
        }
    }

    #[test]
    fn a_page_needs_nothing_from_elsewhere() {
        let html = page_of("double_pendulum.rs");
        assert!(html.contains("default-src 'none'; script-src 'sha256-"));
        // neither a place nor a policy is left open
        for part in ["@DATA@", "@POLICY@", "unsafe-inline", "'unsafe-eval'", "src=\"", "href=\"", "url("] {
            assert!(!html.contains(part), "{part}");
        }
        assert!(html.contains("<math display=\"block\">"));
    }

    /// Texts of a declaration stand in the page as texts.
    #[test]
    fn hostile_texts_stay_texts() {
        let text = "/// </script><script>alert(1)</script> <img src=x onerror=alert(1)>
            Hostile { dof = 1; body ball (x) { mass = 1 [kg]; } start { x = 1 [m]; } }";
        let model = model::as_declared(&mbs_live::Text::declaration("hostile.mbs", text)).unwrap();
        let html = page("</script>@DATA@", &*model, &model.defaults()).unwrap().unwrap();
        assert_eq!(html.matches("<script").count(), 3);
        assert_eq!(html.matches("</script>").count(), 3);
        assert!(!html.contains("<img") && html.contains("&lt;img"));
    }
}
