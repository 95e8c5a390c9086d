//! Runs and equilibria of modes that hold from the start.

use std::fs;

use super::{mbs, text};

/// A slide on a spring of 50 N/m, and a hook, at 0.2 m. Its start is 0.5 m off the hook.
const SLIDE: &str = "Slide {
    dof = 1;
    body slide (x) { mass = 1 [kg]; }
    potential own = 50 [N/m]*x^2/2;
    mode caught { constraint hook: x = 0.2 [m]; }
    when x > 0.2 [m] { enter caught; }
    output pull = lambda(hook);
    start { x = -0.3 [m]; }
}
";

fn told(declaration: &str, arguments: &str) -> Result<serde_json::Value, String> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("slide.mbs"), declaration).unwrap();
    let output = mbs(folder.path(), arguments);
    if output.status.success() {
        Ok(serde_json::from_slice(&output.stdout).unwrap())
    } else {
        Err(text(output.stderr))
    }
}

/// Regressions: the declared start was judged where `--from` gives another one, and where an equilibrium is looked for.
#[test]
fn the_declared_start_may_be_off_what_holds() {
    let declared = SLIDE.replace("mode caught", "mode caught = 1");
    let from = "simulate slide.mbs --from x=0.2 --end 0.1 --json";
    for (declaration, arguments) in [(SLIDE, format!("{from} --input caught=1")), (&declared, from.into())] {
        let run = told(declaration, &arguments).unwrap();
        let pull = run["final"]["pull"]["value"].as_f64().unwrap();
        assert!((pull.abs() - 10.0).abs() < 1e-9, "{run}");
    }
    let off = told(SLIDE, "simulate slide.mbs --input caught=1 --json").unwrap_err();
    assert!(off.contains("`hook` is off by -0.5"), "{off}");
    for (arguments, expected) in [("", 0.2), ("--input caught=0", 0.0)] {
        let rest = told(&declared, &format!("equilibrium slide.mbs --json {arguments}")).unwrap();
        let x = rest["coordinates"]["x"]["value"].as_f64().unwrap();
        assert!((x - expected).abs() < 1e-9, "{rest}");
    }
}

/// Messages do not call a mode a memory that a clock sets.
#[test]
fn messages_say_what_is_set() {
    for (value, part) in [("yes", "takes 1 where it holds"), ("0.5", "cannot be 0.5")] {
        let message = told(SLIDE, &format!("simulate slide.mbs --input caught={value} --json")).unwrap_err();
        assert!(message.contains("`caught`") && message.contains(part), "{message}");
    }
}

/// Regression: implicit constant steps were doubted where a mode is entered, by the whole speed of the drum.
#[test]
fn what_enters_is_no_error_of_a_step() {
    let brake = "Brake {
        dof = 1;
        gravity = (0, -10) [m/s^2];
        body drum (phi) { inertia = 0.2 [kg*m^2]; }
        body load (y) { mass = 3 [kg]; }
        constraint rope: y = 0.1 [m]*phi;
        mode brake { rate shoe: der(phi) = 0 [rad/s]; }
        when y < -0.5 [m] { enter brake; }
        when t > 2 [s] { leave brake; }
    }";
    for method in ["heun", "trbdf2"] {
        let run = told(brake, &format!("simulate slide.mbs --method {method} --step 1ms --end 1.5s --json"))
            .unwrap();
        assert!(run["warnings"].as_array().unwrap().is_empty(), "{run}");
        assert_eq!(run["final"]["brake"]["value"], 1.0);
    }
}

/// Regression: what jumps to a limit was beyond it, `held > 1`, and what jumps from it was not, `held > 0`.
#[test]
fn memories_end_a_run_where_they_pass_a_limit() {
    let counting = "Counting {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        memory n [1] = 0;
        every 0.2 [s] offset 0.1 [s] { set n = n + 1; }
        mode held { rate brake: der(x) = 0; }
        when t > 0.35 [s] { enter held; }
        when t > 0.55 [s] { leave held; }
        start { der(x) = 1 [m/s]; }
    }";
    for (condition, end) in [
        ("n>0", 0.1),
        ("n>1", 0.3),
        ("n>=2", 0.3),
        ("held>0", 0.35),
        ("held>=1", 0.35),
        ("held<1", 0.55),
        ("held<=0", 0.55),
        ("held>1", 1.0),
        ("held<0", 1.0),
        ("n>9", 1.0),
    ] {
        let run =
            told(counting, &format!("simulate slide.mbs --rtol 1e-6 --end 1 --until {condition} --json"));
        let run = run.unwrap();
        assert!((run["final"]["t"]["value"].as_f64().unwrap() - end).abs() < 1e-9, "{condition}: {run}");
        assert_eq!(run["unmet"].is_null(), end < 1.0, "{run}");
    }
}
