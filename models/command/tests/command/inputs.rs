//! Declared values of inputs, and inputs over time, at the command line.

use std::process::Command;

use super::{mbs, text};

/// A block on a spring that its input pushes, 0.1 m at 20 N.
const BLOCK: &str =
    "Block { dof = 1; param mass = 2 [kg]; input push [N] = 20; body block (x) { mass = mass; }
    force spring on x = push - 200 [N/m]*x; start { x = 0.1 [m]; } output acting [N] = push; }";

fn printed(arguments: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("block.mbs"), BLOCK).unwrap();
    let output = mbs(folder.path(), arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    text(output.stdout)
}

/// The last values of a run.
fn last(arguments: &str) -> [f64; 2] {
    let summary: serde_json::Value = serde_json::from_str(&printed(&format!("{arguments} --json"))).unwrap();
    ["x", "acting"].map(|name| summary["final"][name]["value"].as_f64().unwrap())
}

/// It rests where the declared input holds it, by every method; `--input` replaces the value.
#[test]
fn a_run_begins_with_the_declared_inputs() {
    for options in ["", "--rtol 1e-8", "--method rattle", "--method trbdf2"] {
        let [x, acting] = last(&format!("simulate block.mbs --end 0.3s {options}"));
        assert!((x - 0.1).abs() < 1e-12 && acting == 20.0, "{options}: {x} {acting}");
        let [x, acting] = last(&format!("simulate block.mbs --end 0.3s --input push=0N {options}"));
        assert!(x < 0.06 && acting == 0.0, "{options}: {x} {acting}");
    }
}

#[test]
fn every_question_begins_with_them() {
    let json = |arguments: &str| -> serde_json::Value { serde_json::from_str(&printed(arguments)).unwrap() };
    for (given, expected) in [("", 0.1), ("--input push=10", 0.05)] {
        let rest = json(&format!("equilibrium block.mbs --json {given}"));
        let x = rest["coordinates"]["x"]["value"].as_f64().unwrap();
        assert!((x - expected).abs() < 1e-12, "{given}: {rest}");
    }
    let explained = printed("explain block.mbs");
    assert!(explained.contains("Inputs, until they are set") && explained.contains("20 N"), "{explained}");
    // every member of a sweep rests, in lanes
    let swept = json("sweep block.mbs --param mass=1kg..3kg:9 --output acting --end 0.1s --json");
    assert!(swept.to_string().contains("20.0"), "{swept}");
}

/// The block on no spring: 500 N for a quarter of every second is 125 N in the mean.
const SLED: &str = "Sled { dof = 1; input push [N]; body sled (x) { mass = 1000 [kg]; } force f on x = push;
    start { x = 0; } output acting [N] = push; }";

fn sled(input: &str) -> std::process::Output {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sled.mbs"), SLED).unwrap();
    std::fs::write(folder.path().join("my pulses.csv"), "t,push\n0,500\n0.25,0\n1,500\n").unwrap();
    let options =
        ["simulate", "sled.mbs", "--end", "4s", "--step", "4s", "--rtol", "1e-6", "--json", "--input", input];
    Command::new(env!("CARGO_BIN_EXE_mbs")).args(options).current_dir(folder.path()).output().unwrap()
}

/// A jump is met on both sides of it, so that no step is rejected for one, whatever the file is called.
#[test]
fn an_input_over_time_is_led_by_words() {
    for name in ["", "push="] {
        let output = sled(&format!("{name}@my pulses.csv step outside periodic"));
        assert!(output.status.success(), "{}", text(output.stderr));
        let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let speed = summary["final"]["der(x)"]["value"].as_f64().unwrap();
        assert!((speed - 0.5).abs() < 1e-12, "{summary}");
    }
    // straight lines without words, held behind the last row: 250 N in the mean of a second
    let summary: serde_json::Value = serde_json::from_slice(&sled("@my pulses.csv").stdout).unwrap();
    let speed = summary["final"]["der(x)"]["value"].as_f64().unwrap();
    assert!((speed - (0.25 + 1.5)).abs() < 1e-9, "{summary}");
}

#[test]
fn words_that_lead_nowhere() {
    for (input, parts) in [
        ("@my pulses.csv cubc", "did you mean `cubic`?"),
        ("@my pulses.csv cubic outside", "as in `cubic outside hold`"),
        ("@my pulses.csv cubic outside halt", "no rule for what is outside `halt`"),
        ("@my pulses.csv cubic outside periodic", "a cubic one four"),
        ("@missing.csv cubic", "missing.csv:"),
        ("@my pulses.csv linear outside refuse", "x"),
    ] {
        let output = sled(input);
        let told = text(output.stderr) + &text(output.stdout);
        assert!(!output.status.success() && told.contains(parts), "{input}: {told}");
    }
}
