//! Runs end where they are asked to, with the accuracy that is asked for, or say that they do not.

use std::fs;

use super::{mbs, text};

/// Exit code, table and messages of a run of a text.
fn run(declaration: &str, options: &str) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("my.mbs"), declaration).unwrap();
    let output = mbs(folder.path(), &format!("simulate my.mbs {options}"));
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A quantity at the end of a run, in its unit.
fn last(declaration: &str, options: &str, name: &str) -> f64 {
    let (_, json, messages) = run(declaration, &format!("{options} --json"));
    let json: serde_json::Value = serde_json::from_str(&json).unwrap_or_else(|_| panic!("{messages}"));
    json["final"][name]["value"].as_f64().unwrap()
}

const BOB: &str = "Bob { dof = 1; gravity = (0, -9.81) [m/s^2]; body bob (x, y) { mass = 2.5 [kg]; }
    distance link (bob, ground) = 0.8 [m]; start { x = 0.8 [m]; } }";

/// ẏ after 2 s is 1.15120391167752 m/s, by 30 digits. The last sample was between two steps, in the middle of one
/// of 25 ms, by a polynomial of the fifth degree: 1.15120392627.
#[test]
fn the_last_sample_is_as_accurate_as_the_tolerance() {
    for step in ["2s", "0.7s", "1ms"] {
        let options = format!("--method dop853 --rtol 1e-12 --atol 1e-12 --end 2s --step {step}");
        let found = last(BOB, &options, "der(y)");
        assert!((found - 1.151_203_911_677_52).abs() < 1e-11, "{step}: {found}");
        assert_eq!(last(BOB, &options, "t"), 2.0);
    }
}

const WINDOW: &str = "Window { dof = 1; gravity = (0, -9.81) [m/s^2];
    body left (x1, y1, a1) { mass = 1 [kg]; inertia = (1/12) [kg*m^2]; }
    body top (x2, y2, a2) { mass = 1 [kg]; inertia = (1/12) [kg*m^2]; }
    body right (x3, y3, a3) { mass = 1 [kg]; inertia = (1/12) [kg*m^2]; }
    point a on left = (-0.5 [m], 0); point b on left = (0.5 [m], 0);
    point a on top = (-0.5 [m], 0); point b on top = (0.5 [m], 0);
    point a on right = (-0.5 [m], 0); point b on right = (0.5 [m], 0);
    point base on ground = (1 [m], 0);
    revolute p1 (left.a, ground); revolute p2 (left.b, top.a); revolute p3 (top.b, right.b);
    revolute p4 (right.a, ground.base);
    start { a1 = 90 [deg]; a2 = 0; guess a3 = 90 [deg]; der(a1) = 1 [rad/s]; } }";

/// It crept up to the position with 56,000 steps, and said then that the tolerance cannot be met.
#[test]
fn a_singular_position_is_named_with_its_time_and_its_pin() {
    let (code, _, messages) = run(WINDOW, "--method bs3 --rtol 1e-10 --end 20s");
    assert_eq!(code, Some(1));
    // at 0.7084 s; the last steps that meet the tolerance are a little before
    for part in ["singular position at t = 0.708", "`p3_x`"] {
        assert!(messages.contains(part), "{messages}");
    }
}

/// Two blocks on parallel rails, joined by a bar as long as the rails are apart: at every position the bar is
/// across them, and its force is that of a difference of roundings.
#[test]
fn forces_of_1e15_newtons_are_doubted() {
    let rungs = "Rungs { dof = 1; body left (y1) { mass = 1 [kg]; } body right (x2, y2) { mass = 1 [kg]; }
        constraint rail: x2 = 1 [m]; distance bar (left, right) = 1 [m];
        force push on right = (0, 2 [N]); start { guess x2 = 1 [m]; guess y2 = 0.1 [m]; } }";
    let (code, table, messages) = run(rungs, "--rtol 1e-8 --step 0.1s --columns lambda(bar)");
    // what is refused has no forces
    if code != Some(1) {
        assert_eq!(code, Some(3), "{table} {messages}");
        assert!(messages.contains("digits of `bar`"), "{messages}");
    }
}

const GRIPPER: &str = "Gripper {
    dof = 4; param width = 40 [mm]; param k = 2e4 [N/m]; param c = 60 [N*s/m]; input close [N];
    gravity = (0, -9.81) [m/s^2];
    body hand (yh) { mass = 1 [kg]; }
    body left (xl, yl) { mass = 0.1 [kg]; } body right (xr, yr) { mass = 0.1 [kg]; }
    body block (xb, yb) { mass = 0.5 [kg]; }
    constraint same: xl = -xr; constraint hl: yl = yh; constraint hr: yr = yh;
    let gl = k*max(0, width/2 - (xb - xl)); let gr = k*max(0, width/2 - (xr - xb));
    force cl on xl = -gl + close/2 - c*der(xl); force cr on xr = gr - close/2 - c*der(xr);
    force bl on xb = gl - gr - c*der(xb);
    friction fl (block, left) along (0, 1) { coefficient = 0.5; normal = gl; transition = 1e-3 [m/s]; }
    friction fr (block, right) along (0, 1) { coefficient = 0.5; normal = gr; transition = 1e-3 [m/s]; }
    spring arm (hand, ground) { stiffness = 5000 [N/m]; length = 0; damping = 100 [N*s/m]; }
    start { xl = -20 [mm]; yh = 0; yb = 0; xb = 0; }
    output slip [mm] = yb - yh; }";

/// A block of 0.5 kg held by friction of 20 N with a transition of 1 mm/s: 4 · 10⁴ 1/s. At the usual step of
/// 0.5 ms it slips by −5.29 mm, with half of it by −5.18 mm, and in truth by −0.501 mm.
#[test]
fn steps_that_are_unstable_for_a_stiff_friction_say_so() {
    let settings = "--input close=40 --end 2s --columns slip";
    for step in ["0.5ms", "0.25ms", "0.1ms"] {
        let (code, _, messages) = run(GRIPPER, &format!("{settings} --step {step}"));
        assert_eq!(code, Some(3), "{step}: {messages}");
        for part in ["`yb`", "--rtol 1e-6", "trbdf2"] {
            assert!(messages.contains(part), "{step}: {messages}");
        }
    }
    for method in ["--rtol 1e-7", "--method trbdf2", "--step 10us"] {
        let (code, _, messages) = run(GRIPPER, &format!("{settings} {method}"));
        assert_eq!(code, Some(0), "{method}: {messages}");
        let slip = last(GRIPPER, &format!("{settings} {method}"), "slip");
        assert!((slip + 0.501).abs() < 2e-3, "{method}: {slip}");
    }
}

/// A vibration of 1000 rad/s without damping: Heun's method adds to it, and Kutta's of fourth order resolves it.
#[test]
fn steps_that_are_too_long_for_a_vibration_say_so() {
    let rod = "Rod { dof = 1; body block (x) { mass = 1 [kg]; } force spring on x = -1e6 [N/m]*x;
        start { x = 1 [mm]; } }";
    for (options, expected) in [
        ("", Some(3)),
        ("--step 0.02ms", Some(0)),
        ("--method rk4 --step 1.5ms", Some(3)),
        ("--method rk4 --step 3ms", Some(3)),
        ("--method rk4 --step 0.2ms", Some(0)),
        ("--method dop853 --feedback projection --step 1ms", Some(0)),
        ("--method rattle --step 0.2ms", Some(0)),
        ("--method rattle --step 2.1ms", Some(3)),
        ("--rtol 1e-6", Some(0)),
    ] {
        let (code, _, messages) = run(rod, &format!("--end 0.2s {options}"));
        assert!(
            code == expected || (expected == Some(3) && code == Some(1)),
            "{options}: {code:?} {messages}"
        );
    }
}

const BALL: &str = "Ball { dof = 1; gravity = (0, -9.81) [m/s^2]; body ball (y) { mass = 1 [kg]; }
    event ground: y = 0 falling; start { y = 1 [m]; } }";

/// A method with a constant step runs as it is asked for, or declared, and says that it looks for no events; a
/// run to a tolerance says whom it takes in the place of a declared method that cannot.
#[test]
fn methods_with_a_constant_step_say_that_they_look_for_no_events() {
    let declared = BALL.replace("dof = 1;", "dof = 1; method = rk4;");
    let heun = BALL.replace("dof = 1;", "dof = 1; method = heun;");
    for (text, options, word) in [
        (BALL, "--method heun --step 1ms", "`heun`"),
        (BALL, "--method rattle", "`rattle`"),
        (BALL, "--method trbdf2", "`trbdf2`"),
        (&declared, "", "`rk4`"),
        (&heun, "", "`heun`"),
    ] {
        let (code, table, messages) = run(text, options);
        assert_eq!(code, Some(0), "{options}: {messages}");
        assert!(messages.contains("note: events such as `ground`") && messages.contains(word), "{messages}");
        assert!(table.starts_with("my") && table.contains("\nsteps  "), "{table}");
    }
    for (text, options, notes) in [
        (BALL, "", ""),
        (BALL, "--step 1ms", ""),
        (BALL, "--rtol 1e-8 --method bs3", ""),
        (&heun, "--rtol 1e-8", "note: the declared method `heun`"),
        (&declared, "--rtol 1e-8", "note: the declared method `rk4`"),
    ] {
        let (code, table, messages) = run(text, options);
        assert_eq!(code, Some(0), "{options}: {messages}");
        assert!(table.contains("\nground  "), "{options}: {table}");
        assert!(
            messages.starts_with(notes) && messages.is_empty() == notes.is_empty(),
            "{options}: {messages}"
        );
    }
    let (_, json, _) = run(&declared, "--json");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["notes"].as_array().map(Vec::len), Some(1));
}

/// It was refused, because events made it a run to a tolerance, which a page does not make.
#[test]
fn a_mechanism_with_an_event_becomes_a_page() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ball.mbs"), BALL).unwrap();
    let output = mbs(folder.path(), "export page ball.mbs --out ball.html");
    assert!(output.status.success() && folder.path().join("ball.html").exists());
    let messages = text(output.stderr);
    assert!(messages.contains("note: the page") && messages.contains("`ground`"), "{messages}");
    // nor are they looked for in the runs of a sweep and of a picture
    for command in ["sweep ball.mbs --end 0.2s --output y --out y.csv", "export svg ball.mbs --out ball.svg"]
    {
        let output = mbs(folder.path(), command);
        let words = text(output.stderr);
        assert!(output.status.success() || words.contains("--param"), "{command}: {words}");
    }
}

/// A stop without a potential takes the energy of a block, and a spring that is not stretched at the start has a force
/// that is rounding there. Both were doubted as if the position were singular.
#[test]
fn nothing_is_doubted_of_stops_and_of_springs_at_their_length() {
    let stop = "Buffer { dof = 1; body block (x) { mass = 1 [kg]; }
        force stop on x = -1e5 [N/m]*max(0, x - 0.1 [m]); start { der(x) = 1 [m/s]; } }";
    let pinned = "Pinned { dof = 0; body c (x, y, phi) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        point o on c = (-0.1, 0) [m]; point e on c = (0.1, 0) [m]; point h on ground = (0.7, 0) [m];
        revolute p (c.o, ground); drive d: phi = 0.2*sin(2*pi*t/(1 [s]));
        spring s (c.e, ground.h) { stiffness = 1e8 [N/m]; length = 0.5 [m]; } start { } }";
    for (text, options) in [(stop, "--until der(x)<0"), (stop, "--end 0.104s"), (pinned, "--end 0.25s")] {
        let (code, _, messages) = run(text, options);
        assert_eq!((code, messages.as_str()), (Some(0), ""), "{options}");
    }
}

/// A crank of 0.3 m turns a rod of 0.25 m as far as sin φ = 5/6, at 0.98511078 s. A run to a tolerance spoke of a jump
/// there, or of a time behind its end, and `trbdf2` went on to places of 1e148 m.
#[test]
fn a_rod_that_is_too_short_is_named_where_it_is() {
    let text = "Short { dof = 0; body c (phi) { inertia = 1 [kg*m^2]; } body s (x) { mass = 1 [kg]; }
        point p on c = (0.3, 0) [m]; distance rod (c.p, s) = 0.25 [m]; drive d: phi = 1 [rad/s]*t;
        spring k (s, ground) { stiffness = 1e7 [N/m]; length = 0; damping = 1e4 [N*s/m]; }
        start { guess x = 0.55 [m]; } }";
    for options in ["--method trbdf2", "--rtol 1e-6", "--method dop853 --rtol 1e-10", "--method esdirk4"] {
        let (code, _, messages) = run(text, &format!("{options} --end 1.1s"));
        assert_ne!(code, Some(0), "{options}");
        assert!(
            messages.contains("out of reach at t = 0.985") && messages.contains("`rod`"),
            "{options}: {messages}"
        );
    }
}
