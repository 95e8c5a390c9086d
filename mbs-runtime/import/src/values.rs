//! Values of JSON with messages that say where they stand.

use serde_json::Value;

use super::geometry::Point;
use super::{Refusal, shown};

/// A list that has to be there.
pub(super) fn list<'a>(of: &'a Value, key: &str, place: &str) -> Result<&'a [Value], Refusal> {
    let list = of.get(key).and_then(Value::as_array);
    list.map(Vec::as_slice).ok_or_else(|| Refusal(format!("{place} has no list `{key}`")))
}

/// A text that has to be there.
pub(super) fn text<'a>(of: &'a Value, key: &str, place: &str) -> Result<&'a str, Refusal> {
    of.get(key).and_then(Value::as_str).ok_or_else(|| Refusal(format!("{place} has no text `{key}`")))
}

/// A number that has to be there.
pub(super) fn number(of: &Value, key: &str, place: &str) -> Result<f64, Refusal> {
    optional(of, key, place)?.ok_or_else(|| Refusal(format!("{place} has no number `{key}`")))
}

/// A number that may be missing or null.
pub(super) fn optional(of: &Value, key: &str, place: &str) -> Result<Option<f64>, Refusal> {
    match of.get(key) {
        None | Some(Value::Null) => Ok(None),
        Some(value) => match value.as_f64().filter(|number| number.abs() < 1e9) {
            Some(number) => Ok(Some(number)),
            None => Err(Refusal(format!(
                "{place}: `{key}` = {} is no number below 1e9",
                shown(&value.to_string())
            ))),
        },
    }
}

/// Two numbers that have to be there.
pub(super) fn pair(of: &Value, key: &str, place: &str) -> Result<Point, Refusal> {
    let numbers: Option<Vec<f64>> =
        of.get(key).and_then(Value::as_array).and_then(|list| list.iter().map(Value::as_f64).collect());
    match numbers.as_deref() {
        Some(&[x, y]) => Ok([x, y]),
        _ => Err(Refusal(format!("{place} has no pair of numbers `{key}`"))),
    }
}
