//! The functions of the standard around the C code of a mechanism.

use std::fmt::Write;

use mbs_interface::Explicit;

use super::Experiment;
use super::structure::tunable;
use super::variables::References;
use crate::compiled::{Compiled, Feedback, GROWTH_LIMIT};
use crate::targets::c::beginning;

/// The parts, in the order in which they stand in the file.
const PARTS: [&str; 8] = [
    include_str!("text/instance.c"),
    include_str!("text/values.c"),
    include_str!("text/modes.c"),
    include_str!("text/along.c"),
    include_str!("text/saved.c"),
    include_str!("text/fmi2.c"),
    include_str!("text/fmi3.c"),
    include_str!("text/fmi3_absent.c"),
];

/// A model exchange lets the constraint violation vanish over so many steps of co-simulation: a
/// solver of its own may take longer steps than the mechanism would.
const SLOWER: f64 = 10.0;

/// The file, in which the token stands as `TOKEN` until it is known.
pub fn source(compiled: &Compiled, prefix: &str, references: &References, experiment: Experiment) -> String {
    let states = if compiled.has_reduced_states() { "states" } else { "coordinates" };
    let capitals = prefix.to_uppercase();
    let text = [
        include_str!("text/head.c"),
        include_str!("text/types.c"),
        &numbers(compiled, references, experiment),
    ]
    .into_iter()
    .chain(PARTS)
    .collect::<String>();
    let clocks = compiled.sampling.clocks;
    let clocked = if clocks > 0 { include_str!("text/clocks.c") } else { include_str!("text/no_clocks.c") };
    let text =
        beginning(compiled, &text).replace("CLOCKED", clocked).replace("CLOCK_COUNT", &clocks.to_string());
    let unsampled = |text: String, name: &str| match clocks > 0 {
        true => text.replace(&format!("NAME_{name}("), &format!("NAME_{name}_unsampled(")),
        false => text,
    };
    ["start", "step"]
        .into_iter()
        .fold(text, unsampled)
        .replace("NAME_STATES", &format!("{prefix}_{states}"))
        .replace("STATE_COUNT", &format!("{capitals}_{}", states.to_uppercase()))
        .replace("NAME", prefix)
        .replace("CAPS", &capitals)
        // last, because it may be any word
        .replace("{mechanism}", &compiled.name)
}

/// The constants that differ from mechanism to mechanism.
fn numbers(compiled: &Compiled, references: &References, experiment: Experiment) -> String {
    let mut text = String::from(
        "/* This mechanism. */\n\n/* Where the value references of each kind begin. */\nenum {\n",
    );
    for (name, start) in references.starts {
        let _ = writeln!(text, "    AT_{name} = {start},");
    }
    let end = references.starts[references.starts.len() - 1].1 + compiled.events.len();
    let _ = writeln!(text, "    AT_END = {end}\n}};\n");
    // one more at the end, because C has no arrays without elements
    let places: Vec<String> = compiled.states.iter().chain([&0]).map(ToString::to_string).collect();
    let _ = writeln!(
        text,
        "/* Which coordinates are integrated. */\nstatic const int STATE_PLACES[] = {{{}}};\n",
        places.join(", ")
    );
    let tunable = tunable(compiled).into_iter().chain([false]).map(|it| u8::from(it).to_string());
    let _ = writeln!(
        text,
        "/* Which parameters may change while a run goes on: no constraint knows of them. */\n\
         static const unsigned char IS_TUNABLE[] = {{{}}};\n",
        tunable.collect::<Vec<_>>().join(", ")
    );
    let step = experiment.step;
    let [alpha, beta] = Explicit::held(compiled.choices.scheme).deadbeat(step);
    let deadbeat = Feedback { is_held: true, alpha, beta };
    let simulation = compiled.choices.feedback.unwrap_or(deadbeat);
    let exchange = compiled.choices.feedback.unwrap_or(Feedback {
        is_held: false,
        alpha: 1.0 / (SLOWER * step),
        beta: 1.0 / (SLOWER * step),
    });
    let gains = |Feedback { is_held, alpha, beta }| format!("{{{alpha:?}, {beta:?}, {}}}", u8::from(is_held));
    let _ = write!(
        text,
        "/* The step in s, the feedback of the constraint violation in 1/s, and whether it is held over a step. */\n\
         static const double STEP = {step:?};\n\
         struct feedback {{\n    double alpha, beta;\n    int is_held;\n}};\n\
         static const struct feedback CO_SIMULATION = {};\n\
         static const struct feedback MODEL_EXCHANGE = {};\n\
         enum {{ HAS_DECLARED_GAINS = {}, HAS_STOPS = {} }};\n\n\
         /* The pivot growth from which on a position is singular. */\n\
         static const double GROWTH_LIMIT = {GROWTH_LIMIT:?};\n\n\
         static const char TOKEN[] = \"{TOKEN}\";\n\n",
        gains(simulation),
        gains(Feedback { is_held: false, ..exchange }),
        u8::from(compiled.choices.feedback.is_some()),
        u8::from(compiled.jumps()),
    );
    text
}

/// The placeholder of the token in the text.
pub const TOKEN: &str = "{instantiation token}";
