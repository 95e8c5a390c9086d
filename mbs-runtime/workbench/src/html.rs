//! Parts of pages: places to fill, texts, and the scripts that several of them share.
//!
//! A page is filled in one pass.

pub(crate) const DRAWING_SCRIPT: &str = include_str!("html/drawing.js");
pub(crate) const SHAPES_SCRIPT: &str = include_str!("html/mechanism.js");
pub(crate) const UPLOT_STYLE: &str = include_str!("../assets/uplot/uPlot.min.css");
pub(crate) const UPLOT_SCRIPT: &str = include_str!("../assets/uplot/uPlot.iife.min.js");

/// The template with every `@NAME@` replaced by the part of that name. Parts are not looked through again, so
/// they may contain anything. Other than around names, a template has no `@`.
pub fn filled(template: &str, parts: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (at, piece) in template.split('@').enumerate() {
        let part = parts.iter().find(|(name, _)| at % 2 == 1 && *name == piece);
        text += part.map_or(piece, |(_, part)| part);
    }
    text
}

/// Text as it has to be written in HTML, between tags and in attributes.
pub fn escaped(text: &str) -> String {
    let letter = |c: char| match c {
        '&' => "&amp;".into(),
        '<' => "&lt;".into(),
        '>' => "&gt;".into(),
        '"' => "&quot;".into(),
        '\'' => "&#39;".into(),
        other => other.to_string(),
    };
    text.chars().map(letter).collect()
}

/// JSON as it has to be written in a script element: there `</script` would end the data,
/// and `<!--` with `<script` would swallow what follows.
pub fn escaped_json(data: &serde_json::Value) -> String {
    // Outside strings JSON has none of these.
    data.to_string().replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

#[cfg(test)]
mod tests {
    use super::filled;

    #[test]
    fn a_part_is_not_filled_in_turn() {
        let parts = [("A", "1 @B@ @A@"), ("B", "two")];
        assert_eq!(filled("<@A@|@B@|@A@>", &parts), "<1 @B@ @A@|two|1 @B@ @A@>");
        assert_eq!(filled("no places", &parts), "no places");
    }
}
