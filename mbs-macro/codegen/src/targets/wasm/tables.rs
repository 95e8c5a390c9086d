//! The tables of a mechanism that the script of a run reads, as JSON.

use mbs_interface::{Explicit, Row};
use mbs_symbolic::units::Dimension;

use crate::compiled::{
    Comparison, Compiled, Condition, GROWTH_LIMIT, Pivot, Quantity, Results, Setting, Transition,
};
use crate::targets::words;

/// The tables of a mechanism. `<` is escaped, so that they can stand within a `script` element.
pub fn tables(compiled: &Compiled) -> String {
    let Compiled { choices, .. } = compiled;
    let settings =
        |settings: &[Setting]| array(settings.iter().map(|it| quantity(&it.quantity, Some(it.value))));
    let quantities = |quantities: &[Quantity]| array(quantities.iter().map(|it| quantity(it, None)));
    let constraints = compiled.constraints.iter().map(|it| {
        object([
            ("name", text(&it.name)),
            ("length", length(it.dimension)),
            ("drive", it.is_drive.to_string()),
        ])
    });
    let pivots = |pivots: &[Pivot]| array(pivots.iter().map(|pivot| text(&words::pivot(pivot))));
    let positions = |positions: &[usize]| array(positions.iter().map(ToString::to_string));
    let places = compiled.jacobian.iter().map(|(row, column)| format!("[{row},{column}]"));
    let errors = words::errors().map(|(code, words)| (code, text(words)));
    let feedback = choices.feedback.map_or_else(
        || "null".to_owned(),
        |it| {
            object([("held", it.is_held.to_string()), ("alpha", number(it.alpha)), ("beta", number(it.beta))])
        },
    );
    object([
        ("name", text(&compiled.name)),
        ("doc", text(&compiled.doc)),
        ("parameters", settings(&compiled.parameters)),
        ("inputs", settings(&compiled.inputs)),
        ("memories", compiled.sampling.memories.to_string()),
        ("clocks", compiled.sampling.clocks.to_string()),
        (
            "samples",
            array(compiled.sampling.samples.iter().map(|[clock, memory]| format!("[{clock},{memory}]"))),
        ),
        ("stops", array(compiled.contact_memories().map(|memory| memory.to_string()))),
        ("frictions", compiled.frictions.len().to_string()),
        ("rubbing", array(compiled.rubbing_rows().map(|[row, stop]| format!("[{row},{stop}]")))),
        ("noted", array(compiled.noted().map(|[row, memory]| format!("[{row},{memory}]")))),
        ("ofRates", array(compiled.locks.iter().map(|lock| lock.is_rate.to_string()))),
        ("transitions", array(compiled.transitions.iter().map(transition))),
        ("contacts", compiled.length(Results::Contacts).to_string()),
        ("coordinates", quantities(&compiled.coordinates)),
        ("lines", compiled.line_count.to_string()),
        ("outputs", quantities(&compiled.outputs)),
        ("constraints", array(constraints)),
        ("freedom", compiled.degrees_of_freedom.to_string()),
        ("states", positions(&compiled.states)),
        ("redundant", positions(&compiled.redundant)),
        ("jacobian", array(places)),
        ("pivots", pivots(&compiled.pivots)),
        ("startPivots", pivots(&compiled.start_pivots)),
        ("points", compiled.sketch.points.len().to_string()),
        ("hoisted", compiled.length(Results::Hoisted).to_string()),
        ("conditionValues", compiled.length(Results::Conditions).to_string()),
        ("conditions", array(compiled.conditions.iter().map(condition))),
        ("errors", object(errors)),
        ("growthLimit", number(GROWTH_LIMIT)),
        ("scheme", scheme(compiled)),
        ("step", choices.step.map_or_else(|| "null".to_owned(), number)),
        ("feedback", feedback),
        ("fused", compiled.fused_step.is_some().to_string()),
    ])
}

/// The memory of a transition, the sign with which it holds, that of 0 at the start, and whether it holds within
/// rounding of 0.
fn transition(
    Transition { is_rising, is_strict, holds_near, sees_forces, memory, .. }: &Transition,
) -> String {
    let sign = |is_positive| if is_positive { 1 } else { -1 };
    let signs = [sign(*is_rising), sign(is_rising != is_strict)];
    format!("[{memory},{},{},{holds_near},{sees_forces}]", signs[0], signs[1])
}

fn quantity(quantity: &Quantity, declared: Option<f64>) -> String {
    let Quantity { name, doc, unit, scale, dimension } = quantity;
    object([
        ("name", text(name)),
        ("doc", text(doc)),
        ("unit", text(unit)),
        ("scale", number(*scale)),
        ("length", length(*dimension)),
        ("value", number(declared.unwrap_or(0.0))),
    ])
}

/// The power of a length in a dimension; one with fractions is none of a constraint or a coordinate.
fn length(dimension: Dimension) -> String {
    dimension.exponents().map_or(0, |[_, length, ..]| length).to_string()
}

fn condition(condition: &Condition) -> String {
    let (sign, is_strict) = match condition.comparison {
        Comparison::Less => (-1, true),
        Comparison::LessOrEqual => (-1, false),
        Comparison::Greater => (1, true),
        Comparison::GreaterOrEqual => (1, false),
    };
    object([
        ("name", text(&condition.name)),
        ("words", text(&condition.requirement)),
        ("value", condition.value.to_string()),
        ("difference", condition.difference.to_string()),
        ("sign", sign.to_string()),
        ("strict", is_strict.to_string()),
    ])
}

/// The table of the scheme, a row per stage and one of the end, and its gains for a step of 1 s.
fn scheme(compiled: &Compiled) -> String {
    let tableau = compiled.choices.scheme;
    let rows: Vec<&Row> = tableau.stages.iter().chain([&tableau.update]).collect();
    let numbers = |numbers: &mut dyn Iterator<Item = f64>| array(numbers.map(number));
    object([
        ("share", numbers(&mut rows.iter().map(|row| row.share))),
        ("node", numbers(&mut rows.iter().map(|row| row.node()))),
        ("weight", array(rows.iter().map(|row| numbers(&mut row.weights.iter().copied())))),
        ("deadbeat", numbers(&mut Explicit::held(tableau).deadbeat(1.0).into_iter())),
    ])
}

fn object<'a>(members: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let members: Vec<String> =
        members.into_iter().map(|(name, value)| format!("\"{name}\":{value}")).collect();
    format!("{{{}}}", members.join(","))
}

fn array(elements: impl Iterator<Item = String>) -> String {
    format!("[{}]", elements.collect::<Vec<_>>().join(","))
}

/// The shortest form that reads back as the same number; JSON has no others than finite ones.
fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { "null".to_owned() }
}

fn text(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            '<' | '>' | '&' | '\u{0}'..='\u{1f}' | '\u{2028}' | '\u{2029}' => {
                quoted += &format!("\\u{:04x}", u32::from(letter));
            }
            _ => quoted.push(letter),
        }
    }
    quoted + "\""
}
