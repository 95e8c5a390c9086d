//! The source: tables, kernels, and what a run does with them.

use std::fmt::Write;

use mbs_symbolic::units::Dimension;

use super::docs::comment;
use super::header::ERRORS;
use super::kernels::Kernel;
use super::{Scalar, Target};
use crate::compiled::{Comparison, Compiled, GROWTH_LIMIT, Pivot, Vector};

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
        construction(target),
        target.fill(include_str!("text/start.c")),
        target.fill(include_str!("text/step.c")),
        fused.iter().map(Kernel::text).collect(),
        target.fill(&include_str!("text/results.c").replace("STEP", step)),
    ];
    let code = code.concat();
    format!("{}{}{}{code}", head(target), tables(target), helpers(target, &code))
}

/// What stands before everything else.
fn head(target: &Target<'_>) -> String {
    let [limit, epsilon] = match target.scalar {
        Scalar::Double => [GROWTH_LIMIT, f64::EPSILON],
        Scalar::Float => [1.0 / (1024.0 * f64::from(f32::EPSILON)), f32::EPSILON.into()],
    };
    let compiled = target.compiled;
    let mut text = target
        .fill(include_str!("text/head.c"))
        .replace("EPSILON", &target.scalar.literal(epsilon))
        .replace("LIMIT", &target.scalar.literal(limit));
    let sizes = [
        ("parameters", compiled.parameters.len()),
        ("inputs", compiled.inputs.len()),
        ("coordinates", compiled.coordinates.len()),
        ("constraints", compiled.constraints.len()),
        ("outputs", compiled.outputs.len()),
    ];
    let prefix = &target.names.prefix;
    for (name, count) in sizes {
        let count = count.max(1);
        let _ = writeln!(
            text,
            "typedef char {prefix}_{name}_are_an_array[sizeof(struct {prefix}_{name}) == {count} * sizeof(real) ? 1 : -1];"
        );
    }
    text.push('\n');
    text
}

/// Names, places, dimensions and splines.
fn tables(target: &Target<'_>) -> String {
    let (compiled, prefix) = (target.compiled, &target.names.prefix);
    let name = |quantity: &crate::compiled::Quantity| quantity.name.clone();
    let pivot = |pivot: &Pivot| match (pivot.constraint.as_str(), pivot.coordinate.as_str()) {
        (name, "") | ("", name) => name.to_owned(),
        (constraint, coordinate) => format!("{constraint} of {coordinate}"),
    };
    let mut text = String::new();
    let lists: [(&str, &str, Vec<String>); 8] = [
        ("", "parameter_names", compiled.parameters.iter().map(|it| name(&it.quantity)).collect()),
        ("", "input_names", compiled.inputs.iter().map(name).collect()),
        ("", "coordinate_names", compiled.coordinates.iter().map(name).collect()),
        ("", "constraint_names", compiled.constraints.iter().map(|it| it.name.clone()).collect()),
        ("", "output_names", compiled.outputs.iter().map(name).collect()),
        ("", "point_names", compiled.sketch.points.clone()),
        ("static ", "pivot_names", compiled.pivots.iter().map(pivot).collect()),
        ("static ", "start_pivot_names", compiled.start_pivots.iter().map(pivot).collect()),
    ];
    for (storage, list, names) in lists {
        text += &strings(&format!("{storage}const char *const {prefix}_{list}"), &names);
    }
    let places = compiled.jacobian.iter().map(|(row, column)| format!("{{{row}, {column}}}"));
    text += &table(&format!("const int {prefix}_phi_q_places"), "[2]", places.collect(), "{0, 0}");
    let redundant = compiled.redundant.iter().map(ToString::to_string).collect();
    text += &table(&format!("static const int {prefix}_redundant"), "", redundant, "0");
    let lengths = |dimensions: Vec<Dimension>| {
        // a dimension with fractions is none of a constraint or a coordinate
        let length = |dimension: Dimension| dimension.exponents().map_or(0, |[_, length, _]| length);
        dimensions.into_iter().map(|dimension| length(dimension).to_string()).collect::<Vec<_>>()
    };
    let coordinates = lengths(compiled.coordinates.iter().map(|it| it.dimension).collect());
    let constraints = lengths(compiled.constraints.iter().map(|it| it.dimension).collect());
    text += "/* The power of a length in the dimension of each. */\n";
    text += &table(&format!("static const int {prefix}_coordinate_length"), "", coordinates, "0");
    text += &table(&format!("static const int {prefix}_constraint_length"), "", constraints, "0");
    text.push('\n');
    text + &splines(target)
}

/// A table of numbers, with one more at its end, because C has no arrays without elements.
fn table(declaration: &str, columns: &str, mut elements: Vec<String>, last: &str) -> String {
    elements.push(last.to_owned());
    let lines: Vec<String> =
        elements.chunks(12).map(|chunk| format!("    {},\n", chunk.join(", "))).collect();
    format!("{declaration}[{}]{columns} = {{\n{}}};\n", elements.len(), lines.concat())
}

/// A table of strings, and a null pointer.
fn strings(declaration: &str, strings: &[String]) -> String {
    let lines: Vec<String> = strings.iter().map(|string| format!("    {},\n", quoted(string))).collect();
    format!("{declaration}[{}] = {{\n{}    0,\n}};\n\n", strings.len() + 1, lines.concat())
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
        let count = spline.segments.len();
        let _ = writeln!(text, "static const struct {prefix}_segment {prefix}_segments_{at}[{count}] = {{");
        for segment in &spline.segments {
            let coefficients = segment.coefficients.map(number).join(", ");
            let _ = writeln!(text, "    {{{}, {{{coefficients}}}}},", number(segment.from));
        }
        let (origin, period) = (number(spline.origin), number(spline.period));
        let _ = write!(
            text,
            "}};\n\n{}static const struct {prefix}_spline {prefix}_spline_{at} = {{\n    \
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
    let members = target.names.members(Vector::Parameters);
    let mut text = target.fill("\nvoid NAME_default_parameters(struct NAME_parameters *parameters)\n{\n");
    for (parameter, member) in compiled.parameters.iter().zip(members) {
        let _ = writeln!(text, "    parameters->{member} = {};", target.scalar.literal(parameter.value));
    }
    if members.is_empty() {
        text += "    parameters->none = 0;\n";
    }
    text += &target.fill(include_str!("text/init.c"));
    for (at, condition) in compiled.conditions.iter().enumerate() {
        let comparison = match condition.comparison {
            Comparison::Less => "<",
            Comparison::LessOrEqual => "<=",
            Comparison::Greater => ">",
            Comparison::GreaterOrEqual => ">=",
        };
        let (value, capitals) = (condition.difference, &target.names.capitals);
        let _ = writeln!(
            text,
            "    if (!(values[{value}] {comparison} 0)) {{\n        return {capitals}_BAD_CONDITION + {at};\n    }}"
        );
    }
    text += &target.fill("    NAME_compute_hoisted(m, m->hoisted);\n    return CAPS_OK;\n}\n\n");
    let errors: Vec<String> = ERRORS.iter().map(|(_, words)| (*words).to_owned()).collect();
    text += &strings(&format!("static const char *const {prefix}_error_words"), &errors);
    text +=
        &strings(&format!("static const char *const {prefix}_condition_words"), &condition_words(compiled));
    text + &target.fill(include_str!("text/words.c"))
}

fn condition_words(compiled: &Compiled) -> Vec<String> {
    let conditions = compiled.conditions.iter();
    conditions.map(|condition| format!("{}: {}", condition.name, condition.requirement)).collect()
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
