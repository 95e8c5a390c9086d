//! Columns of numbers in short: what is least and largest of each.

use serde_json::{Map, Value, json};

use super::json::number;
use crate::number::significant;
use crate::{Column, Table};

/// A table with the least and the largest value of columns, and their root mean squares.
pub(super) fn table<'a>(title: &str, columns: impl IntoIterator<Item = &'a Column>) -> Table {
    let mut table = Table::new([title, "least", "largest", "rms", ""]);
    for column in columns {
        let [least, largest, rms] = of(column).map(|x| significant(x, 6));
        table.row([column.name.as_str(), &least, &largest, &rms, &column.unit]);
    }
    table
}

/// The same for scripts.
pub(super) fn json<'a>(columns: impl IntoIterator<Item = &'a Column>) -> Map<String, Value> {
    let value = |column: &Column| {
        let [least, largest, rms] = of(column).map(number);
        json!({ "least": least, "largest": largest, "rms": rms, "unit": column.unit })
    };
    columns.into_iter().map(|column| (column.name.clone(), value(column))).collect()
}

fn of(column: &Column) -> [f64; 3] {
    let values = || column.values.iter().copied();
    let squares: f64 = values().map(|x| x * x).sum();
    let count = column.values.len().max(1) as f64;
    [
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
        (squares / count).sqrt(),
    ]
}
