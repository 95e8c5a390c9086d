//! Joints line by line, `ground,input,R,0.0,350.0,0.0,tfft`, or in a web address between `|`.

use super::{Joint, Kind, Sheet, Speed};
use crate::address::query;
use crate::{Refusal, shown};

/// True if a text begins as a file or an address does.
pub(crate) fn is_begun(text: &str) -> bool {
    let text = content(text);
    let first = statements(&text).into_iter().find(|statement| !statement.trim().is_empty());
    first.is_some_and(|first| {
        let (key, _) = key_and_value(&first);
        let keys = ["mech", "set", "ts"];
        keys.contains(&key.as_str()) || kind_at(&words(&first)).is_some()
    })
}

pub(super) fn read(text: &str) -> Result<Sheet, Refusal> {
    let mut sheet = Sheet::default();
    for statement in statements(&content(text)) {
        let (key, value) = key_and_value(&statement);
        match key.as_str() {
            "" | "mech" => joint(value, &mut sheet)?,
            "set" => speed(value, &mut sheet)?,
            "name" => sheet.name = value.into(),
            "s" => sheet.speed = Some(Speed::OfTheLibrary(number(value, "its speed `s`")?)),
            "d" => sheet.input = Some(index(value)?),
            "ts" => sheet.notes.push("The shape to reach (`ts`) is not carried over".into()),
            // how finely the program computes
            "e" | "f" => {}
            _ => sheet.notes.push(format!("What {} says is not carried over", shown(&key))),
        }
    }
    Ok(sheet)
}

/// The part of a web address behind `?`, decoded; all of another text.
fn content(text: &str) -> String {
    match query(text) {
        Some(query) => query.replace('"', "").replace('&', "\n"),
        None => text.replace('\r', "\n"),
    }
}

/// Joints and settings; the settings of `set` have the bar of joints between them.
fn statements(text: &str) -> Vec<String> {
    let lines = text.lines().flat_map(|line| {
        let is_settings = line.trim_start().to_ascii_lowercase().starts_with("set=");
        if is_settings { vec![line] } else { line.split('|').collect() }
    });
    lines.map(str::to_owned).filter(|line| !line.trim().is_empty()).collect()
}

/// `mech=…`, or a joint without a key.
fn key_and_value(statement: &str) -> (String, &str) {
    match statement.split_once('=') {
        Some((key, value)) => (key.trim().to_ascii_lowercase(), value.trim()),
        None => (String::new(), statement),
    }
}

fn words(statement: &str) -> Vec<&str> {
    statement
        .split(|letter: char| letter == ',' || letter.is_whitespace())
        .filter(|word| !word.is_empty())
        .collect()
}

/// The place of the joint's kind: the last word that is one, since a link may be called so too.
fn kind_at(words: &[&str]) -> Option<usize> {
    let is_kind = |word: &&str| ["R", "P", "RP", "G"].iter().any(|kind| word.eq_ignore_ascii_case(kind));
    words.iter().rposition(is_kind)
}

fn joint(statement: &str, sheet: &mut Sheet) -> Result<(), Refusal> {
    let words = words(statement);
    if words.is_empty() {
        return Ok(());
    }
    let place = sheet.joints.len();
    let of = format!("the joint P{place}");
    let Some(at) = kind_at(&words) else {
        return Err(Refusal(format!("{of} has no kind R, P or RP: {}", shown(statement))));
    };
    let (names, rest) = (&words[..at], &words[at + 1..]);
    let kind = Kind::of(words[at], &of)?;
    let [x, y, behind @ ..] = rest else {
        return Err(Refusal(format!("{of} has no place x, y: {}", shown(statement))));
    };
    if names.is_empty() {
        return Err(Refusal(format!("{of} is on no link: {}", shown(statement))));
    }
    let (degrees, flags) = match behind {
        [first, flags @ ..] if first.parse::<f64>().is_ok() => (number(first, &of)?, flags),
        flags => (0.0, flags),
    };
    if is_input(flags) && sheet.input.is_none() {
        sheet.input = Some(place);
    }
    let links = names.iter().map(|name| (*name).to_owned()).collect();
    let at = [number(x, &of)?, number(y, &of)?];
    sheet.joints.push(Joint { kind, at, angle: degrees.to_radians(), links });
    Ok(())
}

/// The fourth flag: `tfft`, `+--+`, or words.
fn is_input(flags: &[&str]) -> bool {
    match flags {
        [flags] if flags.len() == 4 => flags.ends_with(['t', '+']),
        [_, _, _, last, ..] => last.eq_ignore_ascii_case("true"),
        _ => false,
    }
}

fn number(word: &str, of: &str) -> Result<f64, Refusal> {
    let number = word.trim().parse::<f64>().ok().filter(|number| number.abs() < 1e9);
    number.ok_or_else(|| Refusal(format!("{of} has {} in the place of a number below 1e9", shown(word))))
}

fn index(word: &str) -> Result<usize, Refusal> {
    word.parse().map_err(|_| Refusal(format!("its input `d` is {}, not the number of a joint", shown(word))))
}

/// `s50|f0.5`: only the speed matters here.
fn speed(settings: &str, sheet: &mut Sheet) -> Result<(), Refusal> {
    for setting in settings.split('|') {
        if let Some(value) = setting.trim().strip_prefix('s') {
            sheet.speed = Some(Speed::OfThePage(number(value, "its speed `set=s`")?));
        }
    }
    Ok(())
}
