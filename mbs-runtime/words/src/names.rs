//! Names that people type: what exists, and what they may have meant.

/// The message for a name that nothing has: the nearest name that exists, if
/// one is near, and the list of all. A long list would hide the nearest.
pub fn unknown(kind: &str, name: &str, known: &[String]) -> String {
    const FEW: usize = 12;
    let mut message = format!("there is no {kind} `{name}`");
    if let Some(nearest) = nearest(name, known) {
        message += &format!(", did you mean `{nearest}`?");
        if known.len() > FEW {
            return message;
        }
    }
    if known.is_empty() {
        return message + &format!(" (there is no {kind} at all)");
    }
    const MOST: usize = 60;
    let more = known.len().saturating_sub(MOST);
    let listed = known.get(..MOST).unwrap_or(known).join(", ");
    message
        + &if more == 0 {
            format!(" (there is {listed})")
        } else {
            format!(" (there is {listed}, … {more} more)")
        }
}

/// The first of some names, and how many more there are.
pub fn some_of(names: &[String]) -> String {
    const LISTED: usize = 8;
    let (first, more) = (names.get(..LISTED).unwrap_or(names), names.len().saturating_sub(LISTED));
    let more = if more == 0 { String::new() } else { format!(", … {more} more") };
    first.join(", ") + &more
}

/// The known name that a slip of the fingers away from `name`, if any:
/// the distance may be a third of the length, case aside.
pub fn nearest<'a>(name: &str, known: &'a [String]) -> Option<&'a str> {
    let distance = |k: &str| strsim::damerau_levenshtein(&name.to_lowercase(), &k.to_lowercase());
    let best = known.iter().min_by_key(|k| distance(k))?;
    let allowed = 1 + name.chars().count().max(best.chars().count()) / 3;
    (distance(best) <= allowed && distance(best) < best.chars().count()).then_some(best)
}

/// True if a name fits a pattern, in which `*` stands for any letters and `?` for one.
pub fn fits(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    // Where the last star was, and from where on the name is matched against what follows it.
    let (mut star, mut from) = (None, 0);
    let (mut at, mut letter) = (0, 0);
    while letter < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some(at);
                from = letter;
                at += 1;
            }
            Some(&wanted) if wanted == '?' || Some(&wanted) == name.get(letter) => {
                at += 1;
                letter += 1;
            }
            _ => match star {
                // The star takes one letter more.
                Some(last) => {
                    from += 1;
                    (at, letter) = (last + 1, from);
                }
                None => return false,
            },
        }
    }
    pattern.iter().skip(at).all(|rest| *rest == '*')
}

/// The keywords of Rust, reserved ones included.
pub const KEYWORDS: [&str; 52] = [
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do",
    "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual",
    "where", "while", "yield",
];

#[cfg(test)]
mod tests {
    use super::{fits, unknown};

    #[test]
    fn patterns() {
        for (pattern, name) in [("*", ""), ("x?", "x1"), ("der(*)", "der(x1)"), ("*a*b", "aabab"), ("t", "t")]
        {
            assert!(fits(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [("x", "x1"), ("x?", "x"), ("*a", "ab"), ("der(*)", "der(x1"), ("", "t")] {
            assert!(!fits(pattern, name), "{pattern} {name}");
        }
    }

    #[test]
    fn suggests_the_nearest_and_lists_all() {
        let known = ["l1", "omega", "inertia_factor"].map(str::to_owned);
        let message = unknown("parameter", "omgea", &known);
        assert_eq!(
            message,
            "there is no parameter `omgea`, did you mean `omega`? (there is l1, omega, inertia_factor)"
        );
        assert!(!unknown("parameter", "colour", &known).contains("did you mean"));
        assert!(unknown("input", "x", &[]).ends_with("(there is no input at all)"));
        let many: Vec<String> = (1..=13).map(|k| format!("link_{k}_angle")).collect();
        assert_eq!(
            unknown("coordinate", "link_3_angel", &many),
            "there is no coordinate `link_3_angel`, did you mean `link_3_angle`?"
        );
        assert!(unknown("coordinate", "colour", &many).ends_with("link_13_angle)"));
    }
}
