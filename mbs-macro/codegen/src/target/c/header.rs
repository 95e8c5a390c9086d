//! The header: types, codes, names and functions.

use std::fmt::Write;

use super::Target;
use super::docs::{comment, constraint};
use super::kernels::Kernel;
use crate::compiled::{FunctionId, Results, Vector};
use crate::target::words::quantity;

/// The errors that functions return, and what they mean. Those of parameters and of
/// conditions follow, one for each.
pub const ERRORS: [(&str, &str); 11] = [
    ("OK", "no error"),
    ("SINGULAR", "the position is singular: constraints depend on each other there, or friction jams"),
    ("SINGULAR_START", "constraints depend on each other at the start"),
    ("NOT_FINITE", "a position or a velocity is no longer finite"),
    (
        "NOT_ASSEMBLED",
        "the mechanism cannot be assembled: check the dimensions, or start from a closer guess",
    ),
    ("OUT_OF_REACH", "a constraint cannot be met any more: check the dimensions and how far the drives go"),
    ("UNDEFINED_MULTIPLIER", "a multiplier is not finite, though the motion is"),
    ("UNDEFINED_OUTPUT", "an output is not finite"),
    ("BAD_INPUT", "an input is not finite"),
    ("BAD_STEP", "the step has to be positive, finite, and more than the rounding of time"),
    ("BAD_GAINS", "gains must not be negative, and violations must not grow with them from step to step"),
];

pub fn header(target: &Target<'_>, kernels: &[Kernel]) -> String {
    let (compiled, names) = (target.compiled, target.names);
    let mut text = comment(&format!("{}\n\n{HEAD}", compiled.doc), "");
    text += &target.fill(
        "#ifndef CAPS_H\n#define CAPS_H\n\n#include <stdint.h>\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n",
    );
    let _ = writeln!(text, "typedef {} {}_real;\n", target.scalar.name(), names.prefix);
    text += &counts(target);
    text += &errors(target);
    let parameters = compiled.parameters.iter();
    let parameters: Vec<_> =
        parameters.map(|parameter| quantity(&parameter.quantity, Some(parameter.value))).collect();
    let quantities = |list: &[_]| list.iter().map(|it| quantity(it, None)).collect::<Vec<String>>();
    let constraints: Vec<_> = compiled.constraints.iter().map(constraint).collect();
    text += &structure(target, "parameters", PARAMETERS, names.members(Vector::Parameters), &parameters);
    let inputs = quantities(&compiled.inputs);
    text += &structure(target, "inputs", INPUTS, names.members(Vector::Inputs), &inputs);
    let coordinates = quantities(&compiled.coordinates);
    text += &structure(target, "coordinates", COORDINATES, names.members(Vector::Positions), &coordinates);
    text += &structure(target, "constraints", CONSTRAINTS, names.members(Vector::Multipliers), &constraints);
    text += &structure(target, "outputs", OUTPUTS, &names.outputs, &quantities(&compiled.outputs));
    text += &target.fill(include_str!("text/header.h"));
    text += "/* The equations. Results must not lie where arguments do. */\n\n";
    for Kernel { doc, head, .. } in kernels.iter().filter(|kernel| kernel.is_public) {
        let _ = write!(text, "{}{head};\n\n", comment(doc, ""));
    }
    text += "#ifdef __cplusplus\n}\n#endif\n\n#endif\n";
    text
}

const HEAD: &str =
    "Printed from its declaration; changes here are lost. All numbers are in SI units, angles in rad.";
const PARAMETERS: &str = "Numbers that are set once.";
const INPUTS: &str = "Numbers that may change from step to step.";
const COORDINATES: &str = "The coordinates, or their rates per second.";
const CONSTRAINTS: &str =
    "One number per constraint: its violation, its multiplier, or an amount added to its right-hand side.";
const OUTPUTS: &str = "What the declaration measures.";

/// How many there are of what.
fn counts(target: &Target<'_>) -> String {
    let (compiled, capitals) = (target.compiled, &target.names.capitals);
    let counts = [
        ("PARAMETERS", compiled.parameters.len()),
        ("INPUTS", compiled.inputs.len()),
        ("COORDINATES", compiled.coordinates.len()),
        ("CONSTRAINTS", compiled.constraints.len()),
        ("REDUNDANT", compiled.redundant.len()),
        ("OUTPUTS", compiled.outputs.len()),
        ("POINTS", compiled.sketch.points.len()),
        ("JACOBIAN", compiled.jacobian.len()),
        ("PIVOTS", compiled.pivots.len()),
        ("START_PIVOTS", compiled.start_pivots.len()),
        ("CONDITIONS", compiled.conditions.len()),
        ("CONDITION_VALUES", compiled.program(FunctionId::Conditions).outputs.len()),
        ("HOISTED", compiled.length(Results::Hoisted)),
    ];
    let lines = counts.map(|(name, count)| format!("    {capitals}_{name} = {count},\n"));
    format!("/* How many there are. */\nenum {{\n{}}};\n\n", lines.concat())
}

fn errors(target: &Target<'_>) -> String {
    let capitals = &target.names.capitals;
    let mut text = String::from("/* What functions return that may fail. */\nenum {\n");
    for (at, (name, words)) in ERRORS.iter().enumerate() {
        let _ = writeln!(text, "    /* {words} */\n    {capitals}_{name} = {at},");
    }
    let _ = write!(
        text,
        "    /* a parameter is not finite; with its position added */\n    {capitals}_BAD_PARAMETER = {},\n    \
         /* a condition does not hold; with its position added */\n    \
         {capitals}_BAD_CONDITION = {capitals}_BAD_PARAMETER + {capitals}_PARAMETERS\n}};\n\n",
        ERRORS.len()
    );
    text
}

/// A struct of numbers. C has no empty ones.
fn structure(target: &Target<'_>, name: &str, doc: &str, members: &[String], docs: &[String]) -> String {
    let prefix = &target.names.prefix;
    let mut text = format!("{}struct {prefix}_{name} {{\n", comment(doc, ""));
    for (member, doc) in members.iter().zip(docs) {
        let _ = writeln!(text, "{}    {prefix}_real {member};", comment(doc, "    "));
    }
    if members.is_empty() {
        let _ = writeln!(text, "    /* there are none */\n    {prefix}_real none;");
    }
    text + "};\n\n"
}
