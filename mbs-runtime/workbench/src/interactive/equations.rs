//! The derived equations as MathML.

use mbs_runtime::Derivation;
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

use crate::Error;
use crate::derivation::typeset;
use crate::html::escaped;

/// Letters of MathML under a heading, behind which no more formulas are typeset: they would make the page
/// long, and `mbs explain` has them all.
const MOST_LETTERS: usize = 6_000;

/// The equations under their headings.
///
/// # Errors
/// A formula that cannot be typeset, which is a mistake of this program.
pub(super) fn mathml(derivation: &'static Derivation) -> Result<String, Error> {
    let mut html = String::new();
    for (heading, formulas) in typeset(derivation) {
        html += &format!("<h3>{}</h3>\n", escaped(heading));
        let begin = html.len();
        for (at, (name, formula)) in formulas.iter().enumerate() {
            let line = rendered(&format!("{name} = {formula}"))?;
            if html.len() + line.len() > begin + MOST_LETTERS {
                let more = formulas.len() - at;
                html += &format!("<p>… and {more} more, which <code>mbs explain</code> prints.</p>\n");
                break;
            }
            html += &format!("<div class=\"formula\">{line}</div>\n");
        }
    }
    Ok(html)
}

fn rendered(latex: &str) -> Result<String, Error> {
    let storage = Storage::new();
    let mut html = String::new();
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    push_mathml(&mut html, Parser::new(latex, &storage), config).map_err(|source| {
        let reason = format!("it cannot be typeset: {source}");
        Error::Name { name: latex.to_owned(), reason }
    })?;
    // the letters of a name need one element; a dot above is an accent, in the size of what is below
    let html = html.replace(r#"</mi><mi mathvariant="normal">"#, "");
    Ok(html.replace("<mover>", r#"<mover accent="true">"#))
}
