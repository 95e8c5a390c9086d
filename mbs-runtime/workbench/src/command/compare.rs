//! Runs of one mechanism that differ in one value, side by side.

use mbs_runtime::Info;

use super::curves::compared;
use super::options;
use super::simulate::{Request, recorded};
use super::{json, page};
use crate::console::{Warnings, complain};
use crate::figure::{SERIES_COLOURS, Save};
use crate::signals::Signals;
use crate::start::settable;
use crate::{Column, Error, Recording, Settings, Table, Unit, quantity, say, write_csv};

/// The value that differs.
pub(super) struct Comparison {
    name: String,
    unit: Unit,
    /// In SI units.
    values: Vec<f64>,
    runs: Vec<Settings>,
}

impl Comparison {
    /// Reads `NAME=VALUE,…`.
    pub fn of(info: &'static Info, settings: &Settings, text: &str) -> Result<Self, Error> {
        let (name, list) = quantity::split_setting(text)?;
        let inputs = settable(info);
        let known = || info.parameters.iter().chain(&inputs);
        let quantity = known()
            .find(|quantity| quantity.name == name)
            .ok_or_else(|| Error::unknown("parameter or input", name, known().map(|q| q.name)))?;
        let values: Vec<f64> =
            list.split(',').map(|text| quantity::parse_as(quantity, text)).collect::<Result<_, _>>()?;
        let refused = |reason: String| Error::Name { name: name.to_owned(), reason };
        if settings.parameters.iter().chain(&settings.inputs).any(|(other, _)| other == name) {
            return Err(refused("it is set as well as compared".into()));
        }
        if settings.signals.iter().flat_map(Signals::names).any(|other| other == name) {
            return Err(refused("it is given over time as well as compared".into()));
        }
        if values.len() > SERIES_COLOURS.len() {
            let most = SERIES_COLOURS.len();
            return Err(refused(format!(
                "{most} values can be told apart in a picture; for more there is `sweep`"
            )));
        }
        let is_input = inputs.iter().any(|input| input.name == name);
        let with = |value: &f64| {
            let mut settings = settings.clone();
            let list = if is_input { &mut settings.inputs } else { &mut settings.parameters };
            list.push((name.to_owned(), *value));
            settings
        };
        let runs = values.iter().map(with).collect();
        Ok(Self { name: name.to_owned(), unit: Unit::of(quantity), values, runs })
    }
}

/// Runs, writes and prints.
pub(super) fn carry_out(request: &Request<'_>, comparison: &Comparison) -> Result<Warnings, Error> {
    let mut runs: Vec<(String, Recording)> = Vec::new();
    for (value, settings) in comparison.values.iter().zip(&comparison.runs) {
        let name = format!("{} = {}", comparison.name.replace('_', " "), comparison.unit.text(*value, 6));
        runs.push((name, recorded(request.model, settings)?));
    }
    if let Some(path) = &request.files.out {
        write_csv(path, &one_table(request, comparison, &runs)?)?;
    }
    if let Some(path) = &request.files.plot {
        compared(request.name, &runs, &request.choice)?.save(path)?;
    }
    if request.json {
        let each = comparison.runs.iter().zip(&runs);
        let each: Vec<_> = each.map(|(settings, (_, run))| json::run(request, settings, run)).collect();
        say(serde_json::Value::Array(each))?;
    } else {
        say(table(request, &runs)?.to_string().trim_end())?;
        options::say_written(request.files.all())?;
    }
    let notes = runs.first().map_or(&[][..], |(_, run)| &run.notes);
    notes.iter().for_each(|note| complain(format_args!("note: {note}")));
    let ended = runs.iter().find_map(|(name, run)| run.ended.map(|cause| (name, cause)));
    if let Some((name, cause)) = ended {
        return Err(Error::EndedEarly { cause, kept: format!(" ({name})") });
    }
    let doubts = |(name, run): &(String, Recording)| {
        run.doubts.iter().map(|doubt| format!("{name}: {doubt}")).collect::<Vec<_>>()
    };
    Ok(runs.iter().flat_map(doubts).collect())
}

/// The runs one below the other, behind a column that says which one a row is of.
fn one_table(
    request: &Request<'_>,
    comparison: &Comparison,
    runs: &[(String, Recording)],
) -> Result<Vec<Column>, Error> {
    let mut columns = vec![Column::new(comparison.name.clone(), comparison.unit.name())];
    for (value, (_, recording)) in comparison.values.iter().zip(runs) {
        let written = request.choice.written(recording)?;
        let rows = written.first().map_or(0, |column| column.values.len());
        columns[0].values.extend(std::iter::repeat_n(comparison.unit.shown(*value), rows));
        for (at, column) in written.into_iter().enumerate() {
            match columns.get_mut(at + 1) {
                Some(all) => all.values.extend(&column.values),
                None => columns.push(column.clone()),
            }
        }
    }
    Ok(columns)
}

/// The summaries side by side.
fn table(request: &Request<'_>, runs: &[(String, Recording)]) -> Result<Table, Error> {
    let headings = [request.name].into_iter().chain(runs.iter().map(|(name, _)| name.as_str())).chain([""]);
    let mut table = Table::new(headings);
    let summaries: Vec<Table> = runs
        .iter()
        .map(|(_, run)| Ok(page::summary(request.name, &[], run, request.shown(run)?)))
        .collect::<Result<_, Error>>()?;
    // runs may have other events, and other numbers of them
    let keyed: Vec<Vec<(Key, &[String])>> = summaries.iter().map(keyed).collect();
    let mut keys: Vec<Key> = Vec::new();
    for rows in &keyed {
        let mut behind = 0;
        for (key, _) in rows {
            behind = match keys.iter().position(|known| known == key) {
                Some(at) => at + 1,
                None => {
                    keys.insert(behind, key.clone());
                    behind + 1
                }
            };
        }
    }
    for key in keys {
        let found: Vec<Option<&[String]>> =
            keyed.iter().map(|rows| rows.iter().find(|(own, _)| *own == key).map(|(_, row)| *row)).collect();
        let cell = |row: &[String], column: usize| row.get(column).cloned().unwrap_or_default();
        let values = found.iter().map(|row| row.map_or_else(|| "–".to_owned(), |row| cell(row, 1)));
        let unit = found.iter().flatten().map(|row| cell(row, 2)).next().unwrap_or_default();
        table.row([key.0.clone()].into_iter().chain(values).chain([unit]));
    }
    Ok(table)
}

/// The name of a row, and the number of rows of that name before it.
type Key = (String, usize);

/// The rows of a summary with their keys.
fn keyed(summary: &Table) -> Vec<(Key, &[String])> {
    let rows = summary.rows();
    let name = |row: &[String]| row.first().cloned().unwrap_or_default();
    let before = |at: usize| rows.iter().take(at).filter(|row| name(row) == name(&rows[at])).count();
    rows.iter().enumerate().map(|(at, row)| ((name(row), before(at)), &row[..])).collect()
}
