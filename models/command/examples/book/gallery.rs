//! The gallery: every mechanism of the library in motion, with its page and its declaration.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::{Outcome, Places};

/// Writes the chapter, and pictures, pages and declarations beside it.
pub fn write(places: &Places, chapters: &Path) -> Outcome {
    let folder = chapters.join("gallery");
    fs::create_dir_all(&folder)?;
    let listed: Value = serde_json::from_str(&places.printed(&["list", "--json"])?)?;
    let mut cards = String::new();
    for entry in listed.as_array().ok_or("a list")? {
        let name = entry["name"].as_str().ok_or("a name")?;
        let file = |ending: &str| folder.join(format!("{name}{ending}")).display().to_string();
        places.printed(&["export", "svg", name, "--out", &file(".svg")])?;
        places.printed(&["export", "page", name, "--out", &file(".html")])?;
        places.printed(&["simulate", name, "--sketch", &file("-still.svg")])?;
        cards += &card(name, entry)?;
    }
    fs::write(chapters.join("gallery.md"), format!("{HEAD}<div class=\"gallery\">\n{cards}</div>\n"))?;
    Ok(())
}

const HEAD: &str = "\
# Gallery

These are the mechanisms that `mbs list` shows. Each picture leads to a page in which the mechanism runs. There you may
stop it, drag its bodies, and change its parameters. The pages work without a network. `mbs export page NAME --out FILE.html`
writes such a page, also for [a mechanism of your own](page.md). Their declarations are in the folders `models/src` and `models/texts`, to start
from.

";

/// The picture of a mechanism, at rest for those who ask for no motion, its name, and what it is.
fn card(name: &str, entry: &Value) -> Outcome<String> {
    let what = entry["doc"].as_str().unwrap_or_default().split("\n\n").next().unwrap_or_default();
    let count = |key: &str| entry[key].as_array().map_or(0, Vec::len);
    let dof = entry["dof"].as_u64().ok_or("degrees of freedom")?;
    let freedom = if dof == 1 { "degree of freedom" } else { "degrees of freedom" };
    let mut card = String::new();
    writeln!(card, "<figure id=\"{name}\"><a href=\"gallery/{name}.html\"><picture>")?;
    writeln!(
        card,
        "<source media=\"(prefers-reduced-motion: reduce)\" srcset=\"gallery/{name}-still.svg\">\
         <img loading=\"lazy\" src=\"gallery/{name}.svg\" alt=\"{name} in motion\">"
    )?;
    writeln!(card, "</picture></a><figcaption><a href=\"gallery/{name}.html\">{name}</a>")?;
    writeln!(card, "<span>{}</span>", escaped(what))?;
    writeln!(card, "<small>{} coordinates, {dof} {freedom}</small>", count("coordinates"))?;
    writeln!(card, "</figcaption></figure>")?;
    Ok(card)
}

/// A text that HTML shows as it is.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('\n', " ")
}
