//! Runs that start with other values than the declared ones.

use std::fs;

use super::{mbs, text};

/// A double pendulum of massless rods. Its start gives x1 and x2, and guesses the rest.
const DOUBLE: &str = "Double {
    dof = 2;
    gravity = (0, -9.81) [m/s^2];
    body a (x1, y1) { mass = 1 [kg]; }
    body b (x2, y2) { mass = 1 [kg]; }
    constraint upper: x1^2 + y1^2 = 1 [m^2];
    constraint lower: (x2 - x1)^2 + (y2 - y1)^2 = 1 [m^2];
    start { x1 = 0; x2 = 1 [m]; guess y1 = -1 [m]; guess y2 = -1 [m]; }
}
";

/// The first row of a run with these arguments, without its time.
fn first(arguments: &str) -> Vec<f64> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("double.mbs"), DOUBLE).unwrap();
    let all = "--columns x1,y1,x2,y2,der(x1),der(y1),der(x2),der(y2) --out run.csv";
    let output = mbs(folder.path(), &format!("simulate double.mbs --end 1ms {all} {arguments}"));
    assert!(output.status.success(), "{arguments}: {}", text(output.stderr));
    let table = fs::read_to_string(folder.path().join("run.csv")).unwrap();
    table.lines().nth(1).unwrap().split(',').skip(1).map(|number| number.parse().unwrap()).collect()
}

fn near(found: &[f64], expected: &[f64]) {
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?} {expected:?}");
}

/// 0.6² + 0.8² = 1, so that all of these are exact to rounding.
#[test]
fn given_values_stay_and_others_follow() {
    near(&first(""), &[0.0, -1.0, 1.0, -1.0]);
    // in place of a declared value, beside the others that are declared
    near(&first("--from x1=600mm --from x2=1.2m"), &[0.6, -0.8, 1.2, -1.6]);
    // in place of a guess, with which x1 = 0 does not go
    let guessed = first("--from y1=-0.8 --from x1=0.6 --from y2=-0.8 --from x2=1.6");
    near(&guessed, &[0.6, -0.8, 1.6, -0.8]);
    // a rate, in its own unit
    near(&first("--from der(x1)=50cm/s --from der(x2)=0.5")[4..], &[0.5, 0.0, 0.5, 0.0]);
}

/// A start that is given is told beside parameters and inputs that are.
#[test]
fn what_was_given_is_told() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("double.mbs"), DOUBLE).unwrap();
    let run = |more: &str| {
        let line = format!("simulate double.mbs --end 1ms --from x1=600mm --from der(x1)=50cm/s {more}");
        text(mbs(folder.path(), &line).stdout)
    };
    let table = run("");
    assert!(table.contains("x1, as set") && table.contains("der(x1), as set"), "{table}");
    let told: serde_json::Value = serde_json::from_str(&run("--json")).unwrap();
    assert_eq!(told["given"]["x1"]["value"], 0.6);
    assert_eq!(told["given"]["der(x1)"]["unit"], "m/s");
}

const PIN: &str = "Pin {
    dof = 1;
    param l = 0.5 [m];
    param x0 = 0.125 [m];
    gravity = (0, -9.81) [m/s^2];
    body rod (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg]*l^2/12; }
    point top on rod = (0, l/2);
    revolute pin (rod.top, ground);
    start { phi = 30 [deg]; x = x0; guess y = -l/2; }
}
";

/// A parameter that contradicts other values of the start is told; the constraints move what was declared last.
#[test]
fn a_start_value_that_does_not_hold_is_noted() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("pin.mbs"), PIN).unwrap();
    let said = |line: &str| text(mbs(folder.path(), line).stderr);
    let note = "`x` does not start at 0.2 m with these parameters: the constraints make it 0.125 m";
    assert!(said("simulate pin.mbs --end 1ms --set x0=0.2").contains(note));
    assert!(!said("simulate pin.mbs --end 1ms --set l=0.5").contains("does not start"));
    let swept = said("sweep pin.mbs --end 1ms --param x0=0.125..0.2:2 --output phi");
    assert!(swept.contains(&format!("with the largest values of what is swept, {note}")), "{swept}");
}

#[test]
fn what_cannot_be_a_start_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |arguments: &str| {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("double.mbs"), DOUBLE).unwrap();
        let output = mbs(folder.path(), &format!("simulate double.mbs {arguments}"));
        assert!(!output.status.success(), "{arguments}");
        text(output.stderr)
    };
    assert!(refused("--from x1=2").contains("upper"));
    // Regression: values that contradict each other led an angle to 1e36 rad, where everything is rounding.
    fs::write(folder.path().join("pin.mbs"), PIN).unwrap();
    for states in ["", "states = reduced;"] {
        fs::write(folder.path().join("pin.mbs"), PIN.replace("dof = 1;", &format!("dof = 1; {states}")))
            .unwrap();
        for values in
            ["--from x=0.2 --from y=-0.2", "--from x=0.1 --from y=0.1", "--from x=0.2 --from phi=0.3"]
        {
            let output = mbs(folder.path(), &format!("simulate pin.mbs --end 1ms {values}"));
            assert_eq!(output.status.code(), Some(1), "{states} {values}: {}", text(output.stdout));
        }
        // of a length of 0.25, rounded to four digits
        let output = mbs(folder.path(), "simulate pin.mbs --end 1ms --from x=0.1768 --from y=-0.1768");
        assert_eq!(output.status.code(), Some(0), "{states}: {}", text(output.stderr));
    }
    assert!(refused("--from x3=2").contains("did you mean `x"));
    assert!(refused("--from der(x3)=2").contains("did you mean `der(x"));
    assert!(refused("--from x1=2kg").contains("length"));
    assert!(refused("--from x1=1 --from x1=0.5").contains("set twice"));
    // Regression: a coordinate was told to be no parameter, and not what sets it.
    assert!(refused("--set x1=0.5").contains("it is a coordinate, and no parameter; give `--from x1=0.5`"));
}
