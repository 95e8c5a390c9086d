//! Requests of the editor's page to the compiler of mechanisms, and the answers.
//!
//! # How it works
//!
//! The compiler is the workbench without its feature `desk`, for the target wasm32-wasip1. It is a program
//! that reads a request and writes the page of a mechanism or the problems of its declaration.
//!
//! * `page/worker.js` is the little of WASI that it needs. It starts the program anew for every request, so
//!   that no memory is left of an earlier one. `page/compiler.js` asks it one thing at a time.
//! * `page/text.js` is the text field over its coloured copy. Its words come from the compiler's table of
//!   keywords.
//! * `page/editor.js` shows the answers. Each page stands in a frame without rights. By
//!   `interactive/framed.js` of the workbench it tells how the next one goes on.
//! * `main.rs` puts the editor together.

use mbs_live::{Location, Problem, Text};
use mbs_workbench::{Error, RunOptions, model};
use serde_json::{Value, json};

/// The answer to a request, both in JSON.
///
/// A request has the `text` of a declaration, and `step` and `end` of its runs as texts such as `0.5 ms`, which
/// may be empty. The answer has `name`, the `page` of the mechanism and `warnings` of a run of it; or else
/// the `problems` of the declaration, with their places; or else an `error` about something else.
///
/// # Example
/// ```
/// let request = r#"{ "text": "Slider { dof = 1; body block (x) { mass = 1 [kg]; } start { y = 1 [m]; } }" }"#;
/// let answer: serde_json::Value = serde_json::from_str(&mbs_editor::answer(request))?;
/// assert_eq!(answer["problems"][0]["location"]["column"], 61);
/// # Ok::<(), serde_json::Error>(())
/// ```
pub fn answer(request: &str) -> String {
    let answer = match serde_json::from_str::<Value>(request) {
        Ok(request) => page(&request).unwrap_or_else(|error| refusal(&error)),
        Err(error) => json!({ "error": format!("this is no request: {error}") }),
    };
    answer.to_string()
}

fn page(request: &Value) -> Result<Value, Error> {
    let asked = |name: &str| request.get(name).and_then(Value::as_str).unwrap_or_default();
    let model = model::as_declared(&Text::declaration("declaration", asked("text")))?;
    let mut options = RunOptions::default();
    for name in ["step", "end"] {
        if !asked(name).trim().is_empty() {
            options.set(name, asked(name))?;
        }
    }
    let settings = options.settings(&*model)?;
    let recording = model.simulate(&settings, &mut |_, _| ())?;
    let ended = recording.ended.iter().map(|cause| format!("the run ends early: {cause}"));
    let warnings: Vec<String> = ended.chain(recording.doubts.iter().map(ToString::to_string)).collect();
    let name = model.info().name;
    let page = model.interactive_page(&name.to_lowercase(), &settings)?;
    Ok(json!({ "name": name, "page": page, "warnings": warnings }))
}

fn refusal(error: &Error) -> Value {
    match error {
        Error::Declaration(error) => {
            json!({ "problems": error.problems().iter().map(problem).collect::<Vec<_>>() })
        }
        error => json!({ "error": error.to_string() }),
    }
}

fn problem(problem: &Problem) -> Value {
    let notes = problem
        .notes
        .iter()
        .map(|note| json!({ "message": note.message, "location": note.location.as_ref().map(location) }));
    json!({
        "message": problem.message,
        "location": problem.location.as_ref().map(location),
        "help": problem.help,
        "notes": notes.collect::<Vec<_>>(),
    })
}

/// A place; its column and its length count characters, of which JavaScript's strings may have two each.
fn location(location: &Location) -> Value {
    json!({ "line": location.line, "column": location.column, "length": location.length })
}
