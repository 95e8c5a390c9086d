//! The header: types, codes, names and functions.

use std::fmt::Write;

use mbs_interface::Explicit;

use super::docs::comment;
use super::kernels::Kernel;
use super::names::Struct;
use super::target::Target;
use crate::compiled::{Results, Sampling};
use crate::targets::words::errors;

pub fn header(target: &Target<'_>, kernels: &[Kernel]) -> String {
    let structs = &target.names.structs;
    let scheme = target.compiled.choices.scheme;
    let (at_first, default_inputs) = match target.compiled.has_declared_inputs() {
        true => ("as they are declared", DEFAULT_INPUTS),
        false => ("0", ""),
    };
    let clocks = if target.compiled.sampling.clocks > 0 { include_str!("text/clocks.h") } else { "" };
    let stops = if target.compiled.contacts() == 0 { "" } else { include_str!("text/stops.h") };
    let rubs = target.compiled.rubbing().next().is_some();
    let rubbing = if rubs { include_str!("text/rubbing.h") } else { "" };
    let parts = [
        comment(&format!("{}\n\n{HEAD}", target.compiled.doc), ""),
        target.fill(include_str!("text/header_head.h")),
        counts(target),
        codes(target),
        structs.iter().map(|it| structure(target, it)).collect(),
        target.fill(
            &include_str!("text/header.h")
                .replace("AT_FIRST", at_first)
                .replace("DEFAULT_INPUTS", default_inputs)
                .replace("CLOCKED", &format!("{clocks}{stops}{rubbing}"))
                .replace("HELD", &deadbeat(Explicit::held(scheme)))
                .replace("STAGED", &deadbeat(Explicit::per_stage(scheme))),
        ),
        kernels.iter().map(Kernel::declaration).collect(),
        "#ifdef __cplusplus\n}\n#endif\n\n#endif\n".to_owned(),
    ];
    parts.concat()
}

const HEAD: &str =
    "Printed from its declaration; changes here are lost. All numbers are in SI units, angles in rad.";

const DEFAULT_INPUTS: &str = "/** The declared inputs, with which a run begins. */
void NAME_default_inputs(struct NAME_inputs *inputs);

";

/// The gains that remove a violation fastest, for a step h.
fn deadbeat(method: Explicit) -> String {
    let [alpha, beta] = method.deadbeat(1.0);
    format!("{alpha}/h and {beta}/h")
}

/// How many there are of what.
fn counts(target: &Target<'_>) -> String {
    let (compiled, capitals) = (target.compiled, &target.names.capitals);
    let mut text = String::from("/** How many there are. */\nenum {\n");
    for Struct { name, members, .. } in &target.names.structs {
        let _ = writeln!(text, "    {capitals}_{} = {},", name.to_uppercase(), members.len());
    }
    let others = [
        ("LINES", compiled.line_count),
        ("REDUNDANT", compiled.redundant.len()),
        ("EVENTS", compiled.events.len()),
        ("POINTS", compiled.sketch.points.len()),
        ("JACOBIAN", compiled.jacobian.len()),
        ("MASSES", compiled.masses.len()),
        ("PIVOTS", compiled.pivots.len()),
        ("START_PIVOTS", compiled.start_pivots.len()),
        ("CONDITIONS", compiled.conditions.len()),
        ("CONDITION_VALUES", compiled.length(Results::Conditions)),
        ("HOISTED", compiled.length(Results::Hoisted)),
        ("STAGES", compiled.choices.scheme.stage_count()),
    ];
    let Sampling { memories, clocks, samples } = &compiled.sampling;
    let of_clocks = [("CLOCKS", *clocks), ("MEMORIES", *memories), ("SAMPLES", samples.len())];
    let of_stops = [
        ("STOPS", compiled.stops.len()),
        ("OWN_ROWS", compiled.contacts() - compiled.locks.len()),
        ("ROWS", compiled.contacts()),
        ("NOTED", compiled.noted().count()),
        ("CONTACTS", compiled.length(Results::Contacts)),
    ];
    let of_transitions = [("TRANSITIONS", compiled.transitions.len())];
    let of_rubbing = Some(("RUBBING", compiled.rubbing().count())).filter(|(_, count)| *count > 0);
    let of_clocks = of_clocks.into_iter().filter(|_| !samples.is_empty());
    let of_transitions = of_transitions.into_iter().filter(|_| !compiled.transitions.is_empty());
    let of_stops = of_stops.into_iter().filter(|_| compiled.contacts() > 0);
    let of_contacts = of_stops.into_iter().chain(of_rubbing);
    for (name, count) in others.into_iter().chain(of_clocks).chain(of_transitions).chain(of_contacts) {
        let _ = writeln!(text, "    {capitals}_{name} = {count},");
    }
    text + "};\n\n"
}

/// The codes of all errors.
fn codes(target: &Target<'_>) -> String {
    let mut text = String::from("/** What functions return that may fail. */\nenum {\n");
    for (name, words) in errors() {
        let _ = writeln!(text, "    /** {words} */\n    CAPS_{name},");
    }
    text += "    /** a parameter is not finite; with its position added */\n    CAPS_BAD_PARAMETER,\n";
    text += "    /** a condition does not hold; with its position added */\n";
    text += "    CAPS_BAD_CONDITION = CAPS_BAD_PARAMETER + CAPS_PARAMETERS\n};\n\n";
    target.fill(&text)
}

/// A struct of numbers. C has no empty ones.
fn structure(target: &Target<'_>, Struct { name, doc, members }: &Struct) -> String {
    let prefix = &target.names.prefix;
    let mut text = format!("{}struct {prefix}_{name} {{\n", comment(doc, ""));
    for member in members {
        let _ = writeln!(text, "{}    {prefix}_real {};", comment(&member.doc, "    "), member.name);
    }
    if members.is_empty() {
        let _ = writeln!(text, "    /* there are none */\n    {prefix}_real none;");
    }
    text + "};\n\n"
}
