//! Errors are those of the macro, with their places.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::time::Duration;

use mbs_live::{LONGEST, Problem, Scalar, Text};

/// The lines that rustc shows of a problem, without those of the source.
fn as_rustc_shows(problem: &Problem) -> Vec<String> {
    let mut lines = vec![format!("error: {}", problem.message)];
    lines.extend(problem.help.iter().map(|help| format!("help: {help}")));
    for note in &problem.notes {
        let line = note.location.as_ref().unwrap().line;
        lines.push(format!("note: {}", note.message.replace("here", &format!("in line {line}"))));
    }
    let place = problem.location.as_ref().unwrap();
    lines.push(format!("--> ui/places.rs:{}:{}", place.line, place.column));
    lines
}

/// A file with several mechanisms, and what rustc shows of it.
#[test]
fn messages_and_places_are_those_of_the_macro() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("compile_fail/ui");
    let text = fs::read_to_string(cases.join("places.rs")).unwrap();
    let mut found = Vec::new();
    for name in text.lines().filter_map(|line| line.trim().strip_prefix("pub ")?.split(' ').next()) {
        let error = Text::rust("places.rs", text.clone()).named(name).compile().expect_err("refused");
        found.extend(error.problems().iter().flat_map(as_rustc_shows));
    }
    let shown = fs::read_to_string(cases.join("places.stderr")).unwrap();
    let is_of_the_source =
        |line: &str| line.is_empty() || line.starts_with(|first: char| first == '|' || first.is_numeric());
    let shown: Vec<_> = shown.lines().map(str::trim).filter(|line| !is_of_the_source(line)).collect();
    assert_eq!(found, shown);
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

/// Regression: of an error in a text of one long line the whole line was shown.
#[test]
fn of_a_long_line_what_is_around_the_error_is_shown() {
    let names: String = (0..2000).map(|at| format!("param p{at} = {at}; ")).collect();
    let text = format!("A {{ dof = 1; {names} body b (x) {{ mass = 1 [kgg]; }} {names} }}");
    let error = Text::declaration("a.mbs", text).compile().unwrap_err();
    let column = error.problems()[0].location.as_ref().unwrap().column;
    let shown = error.to_string();
    assert!(shown.len() < 2500 && shown.contains(&format!("a.mbs:1:{column} ")), "{shown}");
    assert!(
        shown.contains("…m p1998 = 1998; param p1999 = 1999;  body b (x) { mass = 1 [kgg]; } param p0"),
        "{shown}"
    );
}

/// Regression: nothing was said of a cam whose dwell is none. The largest way from 20 mm between 90° and 180° of
/// the natural cubic through these points was computed with SciPy's `CubicSpline(…, bc_type="periodic")`.
#[test]
fn a_profile_that_leaves_its_dwell_is_told() {
    let warnings = |points: &str| {
        let text = format!(
            "Cam {{
    dof = 0;
    body follower (y) {{ mass = 1 [kg]; }}
    profile lift = spline({points}) period 360 [deg];
    drive cam: y = lift(10 [rad/s]*t);
    start {{ guess y = 20 [mm]; }}
}}"
        );
        let (_, warnings) =
            Text::declaration("cam.mbs", text).check().unwrap_or_else(|error| panic!("{error}"));
        warnings.to_string()
    };
    let cam = "(-90 [deg], 20 [mm]), (-40 [deg], 21 [mm]), (0 [deg], 29 [mm]), (40 [deg], 21 [mm]), \
               (90 [deg], 20 [mm]), (180 [deg], 20 [mm])";
    let told = warnings(cam);
    assert!(told.contains("goes away from its value by 6.2 % of its range"), "{told}");
    assert!(told.contains("`cycloidal`"), "{told}");
    // a sine through 36 points, the two highest of which are equal, is smooth
    let sine = |at: i32| {
        let angle = f64::from(10 * at + 5);
        format!("({angle} [deg], {} [mm])", (angle.to_radians().cos() * 1e9).round() / 1e9)
    };
    assert_eq!(warnings(&(0..36).map(sine).collect::<Vec<_>>().join(", ")), "");
}

/// A cubic table that leaves its dwell is told of, with the kind that does not; a monotone one does not leave it.
#[test]
fn a_table_that_overshoots_is_told() {
    let warnings = |way: &str, outside: &str| {
        let text = format!(
            "Damper {{
    dof = 1;
    body mass (x) {{ mass = 1 [kg]; }}
    table push(x) = [(0 [m], 0 [N]), (1 [m], 10 [N]), (2 [m], 10 [N]), (3 [m], 0 [N])] {way} outside {outside};
    force push on x = push(x);
    start {{ x = 0; }}
}}"
        );
        let (_, warnings) =
            Text::declaration("damper.mbs", text).check().unwrap_or_else(|error| panic!("{error}"));
        warnings.to_string()
    };
    for outside in ["hold", "extend", "periodic", "refuse"] {
        let told = warnings("cubic", outside);
        assert!(told.contains("`push` goes away from its value by"), "{outside}: {told}");
        assert!(told.contains("damper.mbs:4:39") && told.contains("`monotone`"), "{outside}: {told}");
        assert_eq!(warnings("monotone", outside), "");
    }
}

/// Regression: nothing was said of what is declared and never used.
#[test]
fn what_nothing_uses_is_told() {
    let text = "Cart {
    dof = 2;
    param m = 1 [kg] where m > 0;
    param idle = 1 [kg] where idle > 0;
    param rest = 0 [m];
    param level = 2 [m];
    param k = 3 [N/m];
    param only = 4 [m];
    const N = 2;
    const none = 7;
    input pull [N];
    input ignored [N];
    let twice = 2*k;
    let lost = 2*only;
    profile hump = spline((0, 0 [m]), (1, 1 [m]), (2, 0 [m])) period 3;
    assembly Part {
        param mass = 1 [kg];
        param spare = 1 [kg];
        body block (x) { mass = mass; }
    }
    instance a: Part { mass = m; spare = m; }
    instance b: Part { }
    force push on a.block = (pull - twice*a.x, 0);
    start { a.x = rest; }
    output above = b.x - level;
}";
    let checked = Text::declaration("cart.mbs", text).check();
    let (_, warnings) = checked.unwrap_or_else(|error| panic!("{error}"));
    let told = |problem: &Problem| {
        let place = problem.location.as_ref().unwrap();
        (text[place.bytes.clone()].to_owned(), problem.message.clone())
    };
    let told: Vec<_> = warnings.problems().iter().map(told).collect();
    let expected = [
        ("idle", "parameter"),
        ("ignored", "input"),
        ("lost", "definition"),
        ("hump", "profile"),
        ("spare", "parameter"),
    ];
    let expected = expected.map(|(name, what)| (name.to_owned(), format!("this {what} is never used")));
    assert_eq!(told, expected);
    // Regression: the table of the profile was a constant that C code does not use.
    let c = Text::declaration("cart.mbs", text).c(Scalar::Double).unwrap();
    assert!(!c.source.text.contains("cart_splines"));
    assert!(warnings.to_string().starts_with("Warning: this parameter is never used"), "{warnings}");
}

/// Two pads of one brake let go one after the other, with less than the sum of what each holds.
#[test]
fn frictions_that_hold_one_motion_are_warned_of() {
    let warnings = |second: &str| {
        let text = format!(
            "Brake {{ dof = 2; body disc (phi) {{ inertia = 1 [kg*m^2]; }} body other (psi) {{ inertia = 1 [kg*m^2]; }}
                torsion_friction inner (disc, ground) {{ law = coulomb; torque = 3 [N*m]; breakaway = 6 [N*m]; }}
                torsion_friction outer {second} }}"
        );
        let (_, warnings) =
            Text::declaration("brake.mbs", text).check().unwrap_or_else(|error| panic!("{error}"));
        warnings.to_string()
    };
    let told = warnings("(disc, ground) { law = coulomb; torque = 3 [N*m]; breakaway = 6 [N*m]; }");
    assert!(told.contains("`outer` holds the same motion as `inner`"), "{told}");
    assert_eq!(warnings("(other, ground) { law = coulomb; torque = 3 [N*m]; breakaway = 6 [N*m]; }"), "");
}

/// A floor that jumps over time takes what is on it along; one that bends hits it.
#[test]
fn stops_that_jump_over_time_are_warned_of() {
    let warnings = |floor: &str| {
        let text = format!(
            "Floor {{ dof = 1; body b (y) {{ mass = 1 [kg]; }}
                table road(s) = [(0 [s], 0 [m]), (1 [s], 0 [m]), (2 [s], 1 [m])] linear outside hold;
                stop floor: y >= {floor} {{ restitution = 0; }} start {{ y = 2 [m]; }} }}"
        );
        let (_, warnings) =
            Text::declaration("floor.mbs", text).check().unwrap_or_else(|error| panic!("{error}"));
        warnings.to_string()
    };
    for floor in ["if t < 1 [s] { 0 } else { 1 [m] }", "1 [m]*step(t - 1 [s])"] {
        let told = warnings(&format!("{floor} + road(t)"));
        assert!(told.contains("the gap of `floor` chooses by time"), "{floor}: {told}");
    }
    assert_eq!(warnings("road(t)"), "");
}
