//! The source: tables, kernels, and what a run does with them.

use std::fmt::Write;

use mbs_interface::{Explicit, Row};
use mbs_symbolic::units::Dimension;

use super::docs::comment;
use super::kernels::Kernel;
use super::loops::lines;
use super::names::Struct;
use super::target::{Scalar, Target};
use crate::compiled::{Comparison, Compiled, Condition, Feedback, GROWTH_LIMIT, Pivot, Transition};
use crate::targets::words;

/// The text from the functions of the programs, and from a step that is one program.
pub fn source(target: &Target<'_>, kernels: &[Kernel], fused: &[Kernel]) -> String {
    let step = if fused.is_empty() {
        "NAME_step_again(run, t_next)"
    } else {
        "run->is_held ? NAME_step_held(run, t_next) : NAME_step_per_stage(run, t_next)"
    };
    let [contacts, jumps] = [contacts(target.compiled), jumps(target.compiled)];
    let code = [
        kernels.iter().map(Kernel::text).collect(),
        target.fill(include_str!("text/vectors.c")),
        target.fill(include_str!("text/init.c")),
        target.fill(default_inputs(target)),
        target.fill(states(target)),
        target.fill(&within(target.compiled, &beginning(target.compiled, include_str!("text/start.c")))),
        target.fill(include_str!("text/step.c")),
        fused.iter().map(Kernel::text).collect(),
        target.fill(&contacts),
        target.fill(&within(target.compiled, &results(target.compiled)).replace("STEP", step)),
        target.fill(&unsampled(target.compiled, &jumps)),
        target.fill(if target.compiled.sampling.clocks > 0 { include_str!("text/clocks.c") } else { "" }),
    ];
    let code = code.concat();
    let tables = tables(target) + &splines(target, &code);
    format!("{}{tables}{}{}{code}", head(target), scheme(target), helpers(target, &code))
}

/// The way from all coordinates to those that are integrated, and back.
fn states(target: &Target<'_>) -> &'static str {
    match target.compiled.has_reduced_states() {
        true => include_str!("text/states_reduced.c"),
        false => include_str!("text/states_all.c"),
    }
}

/// The function that gives inputs their declared values; nothing where these are 0.
fn default_inputs(target: &Target<'_>) -> &'static str {
    if target.compiled.has_declared_inputs() { include_str!("text/inputs.c") } else { "" }
}

const ROUNDING: &str = include_str!("text/rounding.c");

/// Contacts, with frictions that stick and modes that hold; nothing without one.
fn contacts(compiled: &Compiled) -> String {
    match compiled.contacts() {
        0 => String::new(),
        _ => {
            let rubs = compiled.rubbing().next().is_some();
            let [bounds, rubbing]: [&[&str]; 2] = if rubs { [&[BOUNDS], &RUBBING] } else { [&[], &[]] };
            let contacts = [bounds, &[include_str!("text/contacts.c")], rubbing, &STICKING].concat();
            ROUNDING.to_owned() + &at_stops(compiled, &contacts.concat())
        }
    }
}

const BOUNDS: &str = include_str!("text/bounds.c");
const RUBBING: [&str; 2] = [include_str!("text/pivoting.c"), include_str!("text/rubbing.c")];
const STICKING: [&str; 2] = [include_str!("text/sticking.c"), include_str!("text/halting.c")];
/// Behind what finds out which conditions have begun to hold.
const STOPS: [&str; 3] =
    [include_str!("text/modes.c"), include_str!("text/striking.c"), include_str!("text/stops.c")];

/// A text with its lines behind `RUBS` where a stop rubs, and with those behind `SMOOTH` where none does; and likewise behind
/// `SEES` where conditions depend on forces, and behind `BLIND` where none does.
fn at_stops(compiled: &Compiled, text: &str) -> String {
    let rubs = compiled.rubbing().next().is_some();
    let words = [("RUBS", "SMOOTH", rubs), ("SEES", "BLIND", compiled.sees_forces())];
    let plain = |line: &str| {
        for (is, is_not, holds) in words {
            let [kept, left] = if holds { [is, is_not] } else { [is_not, is] };
            if let Some(rest) = line.strip_prefix(kept) {
                return Some(rest.strip_prefix(' ').unwrap_or(rest).to_owned());
            }
            if line.starts_with(left) {
                return None;
            }
        }
        Some(line.to_owned())
    };
    text.split_inclusive('\n').filter_map(plain).collect()
}

/// The functions of jumps at the end of a step: of velocities at stops and where modes are entered, of memories by transitions.
fn jumps(compiled: &Compiled) -> String {
    if !compiled.jumps() {
        let has_samples = !compiled.sampling.samples.is_empty();
        return if has_samples { include_str!("text/samples.c").to_owned() } else { String::new() };
    }
    let samples = if compiled.sampling.samples.is_empty() { "" } else { include_str!("text/samples.c") };
    let transitions = match compiled.transitions.is_empty() {
        true => include_str!("text/no_transitions.c"),
        false => include_str!("text/transitions.c"),
    };
    let due = if compiled.transitions.is_empty() { "" } else { include_str!("text/due.c") };
    let measure = if compiled.sees_forces() { include_str!("text/measure.c") } else { "" };
    let text = match compiled.contacts() {
        0 => [ROUNDING, samples, measure, transitions, include_str!("text/stepped_transitions.c")].concat(),
        _ => [samples, transitions, due].concat() + &STOPS.concat(),
    };
    at_stops(compiled, &text)
}

/// The functions that start and step a run. Clocks and stops have their own around them.
const STARTS_AND_STEPS: [&str; 3] = ["start", "start_from", "step"];

/// A text whose starts and steps are those within what stops, or else clocks, do.
fn within(compiled: &Compiled, text: &str) -> String {
    if !compiled.jumps() {
        return unsampled(compiled, text);
    }
    STARTS_AND_STEPS.into_iter().fold(text.to_owned(), |text, name| {
        text.replace(&format!("int NAME_{name}(struct"), &format!("static int NAME_{name}_free(struct"))
    })
}

/// A text whose starts and steps are those without samples, where there are clocks.
fn unsampled(compiled: &Compiled, text: &str) -> String {
    if compiled.sampling.clocks == 0 {
        return text.to_owned();
    }
    STARTS_AND_STEPS.into_iter().fold(text.to_owned(), |text, name| {
        text.replace(&format!("int NAME_{name}(struct"), &format!("int NAME_{name}_unsampled(struct"))
    })
}

/// The functions that a run is asked with. What stops and frictions do has a part in them where there are any.
fn results(compiled: &Compiled) -> String {
    let text = include_str!("text/results.c");
    let holds = compiled.holds();
    let lines = text.split_inclusive('\n').filter(|line| {
        (compiled.contacts() > 0 || !line.contains("NAME_press("))
            && (holds
                || !["inputs = run->inputs", "stick here", "NAME_hold(", "run->inputs = inputs"]
                    .iter()
                    .any(|it| line.contains(it)))
    });
    lines.collect()
}

/// A text in which inputs begin at their declared values; where these are 0, they are so already.
pub fn beginning(compiled: &Compiled, text: &str) -> String {
    let is_kept = |line: &&str| compiled.has_declared_inputs() || !line.contains("NAME_default_inputs(");
    text.split_inclusive('\n').filter(is_kept).collect()
}

/// The head of the source, before everything else.
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

/// The table of the scheme, with its rows for the stages and for the end of a step, and its gains.
fn scheme(target: &Target<'_>) -> String {
    let tableau = target.compiled.choices.scheme;
    let rows: Vec<&Row> = tableau.stages.iter().chain([&tableau.update]).collect();
    let numbers = |numbers: &mut dyn Iterator<Item = f64>| {
        let numbers: Vec<String> = numbers.map(|number| Scalar::Double.literal(number)).collect();
        format!("{{{}}}", numbers.join(", "))
    };
    let weights: Vec<String> = rows.iter().map(|row| numbers(&mut row.weights.iter().copied())).collect();
    let deadbeat = Explicit::held(tableau).deadbeat(1.0);
    let tables = [
        ("share[CAPS_STAGES]", numbers(&mut rows.iter().map(|row| row.share))),
        ("node[CAPS_STAGES]", numbers(&mut rows.iter().map(|row| row.node()))),
        ("weight[CAPS_STAGES][CAPS_STAGES]", format!("{{{}}}", weights.join(", "))),
        ("deadbeat[2]", numbers(&mut deadbeat.into_iter())),
    ];
    let tables = tables.map(|(name, values)| format!("static const double NAME_{name} = {values};\n"));
    target
        .fill(&format!("/* The table of SCHEME, and its gains for a step of 1 s. */\n{}\n", tables.concat()))
}

/// Names, places, dimensions, and what codes mean.
fn tables(target: &Target<'_>) -> String {
    let compiled = target.compiled;
    let mut text = String::new();
    let mut add = |declaration: &str, elements, last| text += &table(target, declaration, elements, last);
    for Struct { name, members, .. } in target.names.named() {
        let names = members.iter().map(|member| quoted(&member.declared)).collect();
        add(&format!("const char *const NAME_{}_names[]", name.trim_end_matches('s')), names, "0");
    }
    let points = compiled.sketch.points.iter().map(|name| quoted(name)).collect();
    add("const char *const NAME_point_names[]", points, "0");
    let pivots = |pivots: &[Pivot]| pivots.iter().map(|pivot| quoted(&words::pivot(pivot))).collect();
    add("static const char *const NAME_pivot_names[]", pivots(&compiled.pivots), "0");
    add("static const char *const NAME_start_pivot_names[]", pivots(&compiled.start_pivots), "0");
    let places = compiled.jacobian.iter().map(|(row, column)| format!("{{{row}, {column}}}")).collect();
    add("const int NAME_phi_q_places[][2]", places, "{0, 0}");
    let places = compiled.masses.iter().map(|(row, column)| format!("{{{row}, {column}}}")).collect();
    add("const int NAME_mass_places[][2]", places, "{0, 0}");
    if compiled.has_reduced_states() {
        let states = compiled.states.iter().map(ToString::to_string).collect();
        add("/* Which coordinates are integrated. */\nstatic const int NAME_state_places[]", states, "0");
    }
    let redundant = compiled.redundant.iter().map(ToString::to_string).collect();
    add("static const int NAME_redundant[]", redundant, "0");
    // a dimension with fractions is none of a constraint or a coordinate
    let length = |dimension: Dimension| dimension.exponents().map_or(0, |[_, length, ..]| length).to_string();
    if !compiled.sampling.samples.is_empty() {
        let samples = compiled.sampling.samples.iter();
        let places = samples.map(|[clock, memory]| format!("{{{clock}, {memory}}}")).collect();
        let declaration = "/* The clock, or behind them the transition, and the memory of every sample. */\nstatic const int NAME_sample_places[][2]";
        add(declaration, places, "{0, 0}");
    }
    if compiled.contacts() > 0 {
        let places = compiled.contact_memories().map(|memory| memory.to_string()).collect();
        let declaration = "/* The first memory of every stop, behind them of every friction that sticks, and those of the \
                           modes of constraints. */\nstatic const int NAME_memories[]";
        add(declaration, places, "0");
        let noted = compiled.noted().map(|[row, memory]| format!("{{{row}, {memory}}}")).collect();
        let declaration = "/* The rows of stops and of constraints of modes whose force has a memory, and its place. */\n\
                           static const int NAME_noted[][2]";
        add(declaration, noted, "{0, 0}");
        let of_rates = compiled.locks.iter().map(|lock| u8::from(lock.is_rate).to_string()).collect();
        let declaration =
            "/* 1 for the constraints of modes that are of rates. */\nstatic const int NAME_of_rates[]";
        add(declaration, of_rates, "0");
    }
    if compiled.rubbing().next().is_some() {
        let places = compiled.rubbing_rows().map(|[row, stop]| format!("{{{row}, {stop}}}"));
        let declaration =
            "/* The rows of the frictions of stops, and these. */\nstatic const int NAME_rubbing[][2]";
        add(declaration, places.collect(), "{0, 0}");
    }
    if !compiled.transitions.is_empty() {
        let sign = |is_positive| if is_positive { 1 } else { -1 };
        let side = |it: &Transition| {
            let [holds_near, sees_forces] = [it.holds_near, it.sees_forces].map(u8::from);
            format!(
                "{{{}, {}, {}, {holds_near}, {sees_forces}}}",
                it.memory,
                sign(it.is_rising),
                sign(it.is_rising != it.is_strict)
            )
        };
        let sides = compiled.transitions.iter().map(side).collect();
        let declaration = "/* The memory of every transition, the sign with which it holds, that of 0 at the start, and whether \
                           it holds within rounding of 0, and whether it sees forces. */\n\
                           static const int NAME_sides[][5]";
        add(declaration, sides, "{0, 0, 0, 0, 0}");
    }
    let lengths = compiled.coordinates.iter().map(|it| length(it.dimension)).collect();
    add(
        "/* The power of a length in the dimension. */\nstatic const int NAME_coordinate_length[]",
        lengths,
        "0",
    );
    let lengths = compiled.constraints.iter().map(|it| length(it.dimension)).collect();
    add("static const int NAME_constraint_length[]", lengths, "0");
    let values = compiled.parameters.iter().map(|it| target.scalar.literal(it.value)).collect();
    add("static const real NAME_declared[]", values, "0");
    if compiled.has_declared_inputs() {
        let values = compiled.inputs.iter().map(|it| target.scalar.literal(it.value)).collect();
        add("static const real NAME_declared_inputs[]", values, "0");
    }
    let judged = compiled.conditions.iter().map(judged).collect();
    let declaration = "/* What is judged, its sign, and whether it must not be 0. */\nstatic const int";
    add(&format!("{declaration} NAME_conditions[][3]"), judged, "{0, 0, 0}");
    let words = |it: &Condition| quoted(&format!("{}: {}", it.name, it.requirement));
    let conditions = compiled.conditions.iter().map(words).collect();
    add("static const char *const NAME_condition_words[]", conditions, "0");
    let errors = words::errors().map(|(_, words)| quoted(words)).collect();
    add("static const char *const NAME_error_words[]", errors, "0");
    text
}

fn judged(condition: &Condition) -> String {
    let (sign, is_strict) = match condition.comparison {
        Comparison::Less => (-1, 1),
        Comparison::LessOrEqual => (-1, 0),
        Comparison::Greater => (1, 1),
        Comparison::GreaterOrEqual => (1, 0),
    };
    format!("{{{}, {sign}, {is_strict}}}", condition.difference)
}

/// A table with one element more at its end, because C has no arrays without elements.
fn table(target: &Target<'_>, declaration: &str, mut elements: Vec<String>, last: &str) -> String {
    elements.push(last.to_owned());
    format!("{} = {{\n{}}};\n\n", target.fill(declaration), lines(&elements, "    "))
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

fn splines(target: &Target<'_>, code: &str) -> String {
    let splines = &target.compiled.splines;
    // a table that nothing uses would be an unused constant
    if !code.contains(&format!("{}_splines[", target.names.prefix)) {
        return String::new();
    }
    let mut text = target.fill(include_str!("text/spline.c"));
    // where an argument lies is decided in double precision
    let number = |value: f64| Scalar::Double.literal(value);
    let mut rows = Vec::new();
    for (at, spline) in splines.iter().enumerate() {
        let segment = |coefficients: [f64; 4]| format!("{{{}}}", coefficients.map(number).join(", "));
        let segments = spline.segments.iter();
        let segments = segments.map(|it| format!("{{{}, {}}}", number(it.from), segment(it.coefficients)));
        let declaration = format!("static const struct NAME_segment NAME_segments_{at}[]");
        text += &comment(&spline.name, "");
        text += &table(target, &declaration, segments.collect(), "{0, {0, 0, 0, 0}}");
        let (origin, period, count) =
            (number(spline.origin), number(spline.period.unwrap_or_default()), spline.segments.len());
        rows.push(format!("{{{origin}, {period}, {count}, {}_segments_{at}}}", target.names.prefix));
    }
    text + &table(target, "static const struct NAME_spline NAME_splines[]", rows, "{0, 0, 0, 0}")
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

/// A program that runs the mechanism as it is declared.
pub fn example(target: &Target<'_>) -> String {
    let choices = &target.compiled.choices;
    let step = choices.step.unwrap_or(1e-4);
    let [alpha, beta] = Explicit::held(choices.scheme).deadbeat(step);
    let deadbeat = Feedback { is_held: true, alpha, beta };
    let Feedback { is_held, alpha, beta } = choices.feedback.unwrap_or(deadbeat);
    let [step, alpha, beta] = [step, alpha, beta].map(|number| Scalar::Double.literal(number));
    let feedback = format!("{alpha}, {beta}, {}", u8::from(is_held));
    target.fill(&include_str!("text/main.c").replace("STEP", &step).replace("FEEDBACK", &feedback))
}
