//! The source: tables, kernels, and what a run does with them.

use std::fmt::Write;

use mbs_symbolic::units::Dimension;

use super::docs::comment;
use super::header::errors;
use super::kernels::Kernel;
use super::loops::lines;
use super::names::Struct;
use super::{Scalar, Target};
use crate::compiled::{Comparison, Condition, GROWTH_LIMIT, Pivot};

/// The text from the functions of the programs, and from a step that is one program.
pub fn source(target: &Target<'_>, kernels: &[Kernel], fused: &[Kernel]) -> String {
    let step = if fused.is_empty() {
        "NAME_step_again(run, t_next)"
    } else {
        "run->is_held ? NAME_step_held(run, t_next) : NAME_step_per_stage(run, t_next)"
    };
    let code = [
        kernels.iter().map(Kernel::text).collect(),
        target.fill(include_str!("text/vectors.c")),
        target.fill(include_str!("text/init.c")),
        target.fill(include_str!("text/start.c")),
        target.fill(include_str!("text/step.c")),
        fused.iter().map(Kernel::text).collect(),
        target.fill(&include_str!("text/results.c").replace("STEP", step)),
    ];
    let code = code.concat();
    format!("{}{}{}{}{code}", head(target), tables(target), construction(target), helpers(target, &code))
}

/// What stands before everything else.
fn head(target: &Target<'_>) -> String {
    let [limit, epsilon] = match target.scalar {
        Scalar::Double => [GROWTH_LIMIT, f64::EPSILON],
        Scalar::Float => [1.0 / (1024.0 * f64::from(f32::EPSILON)), f32::EPSILON.into()],
    };
    let mut text = target
        .fill(include_str!("text/head.c"))
        .replace("EPSILON", &target.scalar.literal(epsilon))
        .replace("LIMIT", &target.scalar.literal(limit));
    for Struct { name, members, .. } in &target.names.structs {
        let (prefix, count) = (&target.names.prefix, members.len().max(1));
        let size = format!("sizeof(struct {prefix}_{name}) == {count} * sizeof(real)");
        let _ = writeln!(text, "typedef char {prefix}_{name}_are_an_array[{size} ? 1 : -1];");
    }
    text + "\n"
}

/// Names, places, dimensions and splines.
fn tables(target: &Target<'_>) -> String {
    let (compiled, prefix) = (target.compiled, &target.names.prefix);
    let mut text = String::new();
    let mut names = |list: &str, names: Vec<&str>| {
        let names = names.into_iter().map(quoted).collect();
        text += &table(&format!("const char *const {prefix}_{list}_names"), "", names, "0");
    };
    for Struct { name, members, .. } in &target.names.structs {
        names(name.trim_end_matches('s'), members.iter().map(|member| member.declared.as_str()).collect());
    }
    names("point", compiled.sketch.points.iter().map(String::as_str).collect());
    let pivots = [("pivot", &compiled.pivots), ("start_pivot", &compiled.start_pivots)];
    for (list, pivots) in pivots {
        let names = pivots.iter().map(|pivot| quoted(&pivot_name(pivot))).collect();
        text += &table(&format!("static const char *const {prefix}_{list}_names"), "", names, "0");
    }
    let places = compiled.jacobian.iter().map(|(row, column)| format!("{{{row}, {column}}}"));
    text += &table(&format!("const int {prefix}_phi_q_places"), "[2]", places.collect(), "{0, 0}");
    let redundant = compiled.redundant.iter().map(ToString::to_string).collect();
    text += &table(&format!("static const int {prefix}_redundant"), "", redundant, "0");
    // a dimension with fractions is none of a constraint or a coordinate
    let length = |dimension: Dimension| dimension.exponents().map_or(0, |[_, length, _]| length).to_string();
    let coordinates = compiled.coordinates.iter().map(|it| length(it.dimension)).collect();
    let constraints = compiled.constraints.iter().map(|it| length(it.dimension)).collect();
    text += "/* The power of a length in the dimension of each. */\n";
    text += &table(&format!("static const int {prefix}_coordinate_length"), "", coordinates, "0");
    text += &table(&format!("static const int {prefix}_constraint_length"), "", constraints, "0");
    text + &splines(target)
}

fn pivot_name(Pivot { constraint, coordinate }: &Pivot) -> String {
    let between = if constraint.is_empty() || coordinate.is_empty() { "" } else { " of " };
    format!("{constraint}{between}{coordinate}")
}

/// A table with one element more at its end, because C has no arrays without elements.
fn table(declaration: &str, columns: &str, mut elements: Vec<String>, last: &str) -> String {
    elements.push(last.to_owned());
    format!("{declaration}[{}]{columns} = {{\n{}}};\n\n", elements.len(), lines(&elements, "    "))
}

/// A string literal.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' | '?' => quoted.extend(['\\', letter]),
            '\n' => quoted.push_str("\\n"),
            _ => quoted.push(letter),
        }
    }
    quoted + "\""
}

fn splines(target: &Target<'_>) -> String {
    let (splines, prefix) = (&target.compiled.splines, &target.names.prefix);
    let mut text = String::new();
    if !splines.is_empty() {
        text += &target.fill(include_str!("text/spline.c"));
    }
    // where an argument lies is decided in double precision
    let number = |value: f64| Scalar::Double.literal(value);
    for (at, spline) in splines.iter().enumerate() {
        let segments: Vec<String> = spline
            .segments
            .iter()
            .map(|it| format!("{{{}, {{{}}}}}", number(it.from), it.coefficients.map(number).join(", ")))
            .collect();
        let (count, last) = (segments.len(), "{0, {0, 0, 0, 0}}");
        let (origin, period) = (number(spline.origin), number(spline.period));
        let declaration = format!("static const struct {prefix}_segment {prefix}_segments_{at}");
        text += &table(&declaration, "", segments, last);
        let _ = write!(
            text,
            "{}static const struct {prefix}_spline {prefix}_spline_{at} = {{\n    \
             {origin}, {period}, {count}, {prefix}_segments_{at},\n}};\n\n",
            comment(&spline.name, "")
        );
    }
    text
}

/// Those of the small functions that the code calls.
fn helpers(target: &Target<'_>, code: &str) -> String {
    let sin_cos = match target.scalar {
        Scalar::Double => include_str!("text/sin_cos_double.c"),
        Scalar::Float => include_str!("text/sin_cos_float.c"),
    };
    let helpers = format!("{sin_cos}\n{}", include_str!("text/helpers.c"));
    let helpers = target.fill(&helpers);
    let helpers: Vec<&str> = helpers.split_inclusive("\n}\n").map(str::trim).collect();
    let mut needed: Vec<&str> = Vec::new();
    // a function stands behind those that it calls
    for helper in helpers.into_iter().rev().filter(|helper| !helper.is_empty()) {
        let head = helper.lines().find(|line| line.starts_with("static")).unwrap_or(helper);
        let name = head.split('(').next().and_then(|head| head.split(' ').next_back()).unwrap_or(head);
        let call = format!("{name}(");
        if code.contains(&call) || needed.iter().any(|other| other.contains(&call)) {
            needed.push(helper);
        }
    }
    needed.into_iter().rev().map(|helper| format!("{helper}\n\n")).collect()
}

/// Declared parameters, their conditions, and what codes mean.
fn construction(target: &Target<'_>) -> String {
    let (compiled, prefix) = (target.compiled, &target.names.prefix);
    let errors = errors().map(|(_, words)| quoted(words)).collect();
    let words = |condition: &Condition| quoted(&format!("{}: {}", condition.name, condition.requirement));
    let conditions = compiled.conditions.iter().map(words).collect();
    let mut text = table(&format!("static const char *const {prefix}_error_words"), "", errors, "0");
    text += &table(&format!("static const char *const {prefix}_condition_words"), "", conditions, "0");
    let values: Vec<String> = compiled.parameters.iter().map(|it| target.scalar.literal(it.value)).collect();
    text += &table(&format!("static const real {prefix}_declared"), "", values, "0");
    let judged = |condition: &Condition| {
        let (sign, is_strict) = match condition.comparison {
            Comparison::Less => (-1, 1),
            Comparison::LessOrEqual => (-1, 0),
            Comparison::Greater => (1, 1),
            Comparison::GreaterOrEqual => (1, 0),
        };
        format!("{{{}, {sign}, {is_strict}}}", condition.difference)
    };
    let judged = compiled.conditions.iter().map(judged).collect();
    text += "/* What is judged, its sign, and whether it must not be 0. */\n";
    text += &table(&format!("static const int {prefix}_conditions"), "[3]", judged, "{0, 0, 0}");
    text
}

/// A program that runs the mechanism as it is declared.
pub fn example(target: &Target<'_>) -> String {
    let choices = &target.compiled.choices;
    let step = choices.step.unwrap_or(1e-4);
    let feedback = choices.feedback.as_ref().map_or_else(String::new, |feedback| {
        let [alpha, beta] = [feedback.alpha, feedback.beta].map(|gain| Scalar::Double.literal(gain));
        let is_held = u8::from(feedback.is_held);
        format!(
            "    if (code == CAPS_OK) {{\n        code = NAME_set_feedback(&run, {alpha}, {beta}, {is_held});\n    }}\n"
        )
    });
    let text = include_str!("text/main.c");
    let text = text.replace("STEP", &Scalar::Double.literal(step)).replace("FEEDBACK\n", &feedback);
    target.fill(&text)
}
