//! Names of the language for things that other programs named.

use std::collections::BTreeSet;

use mbs_symbolic::Function;

use mbs_words::names::KEYWORDS;

/// Words of the language that name nothing else.
const WORDS: [&str; 10] = ["t", "pi", "der", "lambda", "effort", "ground", "x", "y", "angle", "guess"];

/// The names that a declaration has so far.
#[derive(Default)]
pub(super) struct Names(BTreeSet<String>);

impl Names {
    /// A name that is free, also with each of the endings: `wanted` where it is one, else as
    /// near to it as can be.
    pub fn take(&mut self, wanted: &str, fallback: &str, endings: &[&str]) -> String {
        let base = identifier(wanted, fallback);
        let mut name = base.clone();
        let mut count = 1;
        while !self.is_free(&name, endings) {
            count += 1;
            name = format!("{base}_{count}");
        }
        self.0.insert(name.clone());
        self.0.extend(endings.iter().map(|ending| format!("{name}{ending}")));
        name
    }

    fn is_free(&self, name: &str, endings: &[&str]) -> bool {
        let is_word = KEYWORDS.contains(&name) || WORDS.contains(&name) || Function::named(name).is_some();
        let mut all = endings.iter().map(|ending| format!("{name}{ending}"));
        !is_word && !self.0.contains(name) && !all.any(|name| self.0.contains(&name))
    }
}

/// The letters, digits and underscores of a name, which begins with a letter.
fn identifier(wanted: &str, fallback: &str) -> String {
    let mut name = String::new();
    for letter in wanted.chars().take(60) {
        if letter.is_ascii_alphanumeric() {
            name.push(letter);
        } else if !name.ends_with('_') {
            name.push('_');
        }
    }
    let name = name.trim_matches('_');
    match name.chars().next() {
        None => fallback.to_owned(),
        Some(first) if first.is_ascii_digit() => format!("{fallback}_{name}"),
        Some(_) => name.to_owned(),
    }
}

/// The name of a mechanism, its words joined: `Four-bar linkage` is `FourBarLinkage`.
pub(super) fn camel(name: &str) -> String {
    let words = name.split(|letter: char| !letter.is_ascii_alphanumeric());
    let capital = |word: &str| {
        let mut letters = word.chars();
        letters
            .next()
            .map(|first| first.to_ascii_uppercase().to_string() + letters.as_str())
            .unwrap_or_default()
    };
    let joined: String = words.map(capital).collect::<String>().chars().take(60).collect();
    match joined.chars().next() {
        Some(first) if first.is_ascii_alphabetic() && !KEYWORDS.contains(&joined.as_str()) => joined,
        _ => format!("Imported{joined}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_kept_where_they_are_valid() {
        let mut names = Names::default();
        let mut take = |wanted| names.take(wanted, "joint", &["_x"]);
        assert_eq!(take("crank"), "crank");
        assert_eq!(take("crank"), "crank_2");
        assert_eq!(take("left arm (2)"), "left_arm_2");
        assert_eq!(take("7"), "joint_7");
        assert_eq!(take("über"), "ber");
        assert_eq!(take(""), "joint");
        assert_eq!((take("sin"), take("fn"), take("t")), ("sin_2".into(), "fn_2".into(), "t_2".into()));
        // the coordinates of a body
        assert_eq!((take("x"), take("y")), ("x_2".into(), "y_2".into()));
        assert_eq!(take("crank_x"), "crank_x_2");
        assert_eq!(
            (camel("Four-bar linkage"), camel("4 bar")),
            ("FourBarLinkage".into(), "Imported4Bar".into())
        );
    }
}
