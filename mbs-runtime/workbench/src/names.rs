//! Names that people type: what exists, and what they may have meant.

/// The message for a name that nothing has: the nearest name that exists, if
/// one is near, and the list of all.
pub(crate) fn unknown(kind: &str, name: &str, known: &[String]) -> String {
    let mut message = format!("there is no {kind} `{name}`");
    if let Some(nearest) = nearest(name, known) {
        message += &format!(", did you mean `{nearest}`?");
    }
    if known.is_empty() {
        return message + &format!(" (there is no {kind} at all)");
    }
    message + &format!(" (there is {})", known.join(", "))
}

/// The known name that a slip of the fingers away from `name`, if any:
/// the distance may be a third of the length, case aside.
fn nearest<'a>(name: &str, known: &'a [String]) -> Option<&'a str> {
    let distance = |k: &str| strsim::damerau_levenshtein(&name.to_lowercase(), &k.to_lowercase());
    let best = known.iter().min_by_key(|k| distance(k))?;
    let allowed = 1 + name.chars().count().max(best.chars().count()) / 3;
    (distance(best) <= allowed && distance(best) < best.chars().count()).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::unknown;

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
    }
}
