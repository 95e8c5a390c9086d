//! Errors are those of the macro, with their places.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::time::Duration;

use mbs_live::{LONGEST, Problem, Text};

/// What rustc shows of a problem, without its frame; see `tests/compile_fail`.
fn as_rustc_shows(problem: &Problem) -> String {
    let mut text = format!("error: {}\n", problem.message);
    if let Some(help) = &problem.help {
        text += &format!("\n       help: {help}\n");
    }
    text
}

/// Lines and columns of the errors that rustc showed.
fn places(stderr: &str) -> Vec<(usize, usize)> {
    let places = stderr.lines().filter_map(|line| line.trim_start().strip_prefix("--> "));
    let place = |place: &str| {
        let mut parts = place.rsplit(':').map(|part| part.parse().unwrap());
        let (column, line) = (parts.next().unwrap(), parts.next().unwrap());
        (line, column)
    };
    places.map(place).collect()
}

/// Whole files of the cases that the macro is tested with; what rustc shows of them is
/// recorded there.
#[test]
fn messages_and_places_are_those_of_the_macro() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/compile_fail/ui");
    let mut compared = 0;
    for kind in fs::read_dir(cases).unwrap() {
        for case in fs::read_dir(kind.unwrap().path()).unwrap() {
            let path = case.unwrap().path();
            let source = path.extension().filter(|extension| *extension == "rs");
            // several mechanisms in one file are tested one by one elsewhere
            let Some(text) = source.and_then(|_| fs::read_to_string(&path).ok()) else { continue };
            if text.matches("mechanism! {").count() != 1 || text.contains("macro_rules!") {
                continue;
            }
            let expected = fs::read_to_string(path.with_extension("stderr")).unwrap();
            // what rustc finds in the code that it is given: stack, gains of a step, a trait that is missing
            if expected.starts_with("error[E0") {
                continue;
            }
            let error = Text::rust("case.rs", text).compile().expect_err("refused");
            let mut found = Vec::new();
            for problem in error.problems() {
                let shown = as_rustc_shows(problem);
                assert!(expected.contains(&shown), "{}:\n{shown}", path.display());
                found.extend(problem.location.as_ref().map(|place| (place.line, place.column)));
            }
            let mut places = places(&expected);
            places.sort_unstable();
            places.dedup();
            found.sort_unstable();
            found.dedup();
            assert_eq!(found, places, "{}", path.display());
            compared += 1;
        }
    }
    assert!(compared >= 60, "{compared}");
}

#[test]
fn an_error_is_shown_with_its_source() {
    let text = "Crank {\n    dof = 1;\n    param l = 1 [m];\n    param l = 2 [kg];\n}";
    let error = Text::declaration("crank.mbs", text).compile().unwrap_err();
    let shown = error.to_string();
    for part in [
        "`l` is declared twice",
        "crank.mbs:4:11",
        "param l = 2 [kg];",
        "is first declared",
        "param l = 1 [m];",
    ] {
        assert!(shown.contains(part), "{part}:\n{shown}");
    }
    assert!(!shown.contains('\u{1b}') && error.colored().to_string().contains('\u{1b}'), "{shown}");
}

#[test]
fn what_is_shown_commands_no_terminal() {
    let error = Text::declaration("a.mbs", "A { /* \u{1b}[31m \u{9b} */ x; }").compile().unwrap_err();
    let shown = error.to_string();
    assert!(shown.contains("/* ?[31m ¿ */ x;") && shown.contains("a.mbs:1:19"), "{shown}");
}

/// The first problem of a text that cannot be read, and the line and column of it.
fn unreadable(text: &str) -> (String, (usize, usize)) {
    let error = Text::declaration("a.mbs", text).compile().unwrap_err();
    let Problem { message, location, .. } = &error.problems()[0];
    let place = location.as_ref().unwrap();
    (message.clone(), (place.line, place.column))
}

#[test]
fn what_is_no_token_has_a_place() {
    assert_eq!(unreadable("A {\n  (\n"), ("this bracket is never closed".to_owned(), (2, 3)));
    assert_eq!(
        unreadable("A {\n  )\n"),
        ("this bracket does not close the one that is open".to_owned(), (2, 3))
    );
    assert_eq!(unreadable("Ä }"), ("this bracket does not close the one that is open".to_owned(), (1, 3)));
    assert_eq!(unreadable("A { § }"), ("this character has no meaning here".to_owned(), (1, 5)));
    assert_eq!(unreadable("A { /* }"), ("this comment never ends".to_owned(), (1, 5)));
    assert_eq!(
        unreadable("A { \" }"),
        ("this string never ends, or has an unknown escape".to_owned(), (1, 5))
    );
}

#[test]
fn texts_of_strangers_end_in_an_error() {
    let refused = |text: String| Text::declaration("a.mbs", text).compile().unwrap_err().to_string();
    assert!(refused(" ".repeat(LONGEST + 1)).contains("bytes"));
    // each on its own tests a recursion
    for (open, close) in [('(', ')'), ('{', '}'), ('[', ']')] {
        let nested = |depth: usize| {
            let (open, close) = (open.to_string().repeat(depth), close.to_string().repeat(depth));
            format!("A {{ constraint c: {open} 1 {close} = 0; }}")
        };
        assert!(!refused(nested(100_000)).is_empty());
    }
    assert!(refused(format!("A {{ constraint c: x = {}1; }}", "-".repeat(200_000))).contains("nest"));
    assert!(refused(format!("A {{ param x = 1{}; }}", "0".repeat(1_000_000))).contains("1000 characters"));
    assert!(refused("A { for i in 0..1000000000 { param p[i] = 1; } }".to_owned()).contains("100000"));
}

#[test]
fn of_many_problems_the_first_are_shown() {
    let error = Text::declaration("a.mbs", format!("A {{ {} }}", "x;\n".repeat(5000))).compile().unwrap_err();
    assert_eq!(error.problems().len(), 5000);
    assert!(error.problems()[4999].location.as_ref().is_some_and(|place| place.line == 5000));
    let shown = error.to_string();
    assert!(shown.contains("a.mbs:100:") && !shown.contains("a.mbs:101:"));
    assert!(shown.ends_with("… and 4900 more\n"));
    let in_one_line = format!("A {{ {} }}", "x; ".repeat(50_000));
    assert!(Text::declaration("a.mbs", in_one_line).compile().unwrap_err().to_string().len() < 1_000_000);
}

#[test]
fn compiling_ends_in_time() {
    let chain = "Chain {
        dof = 300;
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=300 {
            body rod[i] (x[i], y[i], theta[i]) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
            point base on rod[i] = (-1 [m], 0);
            point tip on rod[i] = (1 [m], 0);
            if i == 1 { revolute pin[i] (rod[i].base, ground); }
            if i > 1 { revolute pin[i] (rod[i-1].tip, rod[i].base); }
        }
    }";
    let error = Text::declaration("a.mbs", chain).within(Duration::from_millis(1)).compile().unwrap_err();
    assert!(error.problems()[0].message.contains("0.001 s"), "{error}");
}
