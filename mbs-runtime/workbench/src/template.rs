//! Texts with places to fill.

/// The template with every `@NAME@` replaced by the part of that name. What is filled in
/// is not looked through again: a part may contain anything. Other than around names, a
/// template has no `@`.
pub(crate) fn filled(template: &str, parts: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (at, piece) in template.split('@').enumerate() {
        let part = parts.iter().find(|(name, _)| at % 2 == 1 && *name == piece);
        text += part.map_or(piece, |(_, part)| part);
    }
    text
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
