//! Mechanisms from files.

use std::fs;

use super::{mbs, text};

const SWING: &str = "/// A weight on a massless rod.
Pendulum {
    dof = 1;
    step = 1 [ms];
    feedback = held(900 [1/s], 900 [1/s]);
    param length = 1 [m];
    gravity = (0, -9.81) [m/s^2];
    body bob (x, y) { mass = 2 [kg]; }
    constraint rod: x^2 + y^2 = length^2;
    start { x = length; guess y = 0; }
    output height [mm] = y + length;
}
";

#[test]
fn a_file_is_taken_wherever_a_name_is() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("swing.mbs"), SWING).unwrap();
    let rust = format!("//! Two.\nmechanism! {{ {SWING} }}\nmechanism! {{ Other {{ dof = 0; }} }}");
    fs::write(folder.path().join("lib.rs"), rust).unwrap();
    let goes = |arguments: &str| {
        let output = mbs(folder.path(), arguments);
        assert!(output.status.success(), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
        text(output.stdout)
    };
    let run = goes("simulate swing.mbs --end 0.2s --out swing.csv --report swing.html");
    assert!(run.starts_with("swing\n") && run.contains("200"), "steps of the declaration:\n{run}");
    let same = goes("simulate lib.rs:Pendulum --end 0.2s --out same.csv");
    assert!(same.starts_with("Pendulum\n"), "{same}");
    let read = |file: &str| fs::read_to_string(folder.path().join(file)).unwrap();
    assert_eq!(read("swing.csv"), read("same.csv"));
    goes("simulate swing.mbs --end 0.2s --alpha 900 --beta 900 --out given.csv");
    assert_eq!(read("swing.csv"), read("given.csv"), "gains of the declaration");
    goes("simulate swing.mbs --end 0.2s --alpha 800 --out other.csv");
    assert_ne!(read("swing.csv"), read("other.csv"));
    assert!(goes("explain swing.mbs").starts_with("Pendulum\n  A weight on a massless rod."));
    let sweep = "sweep swing.mbs --param length=0.5m..2m:70 --output height --end 0.5s --out sweep.csv";
    goes(sweep);
    assert_eq!(read("sweep.csv").lines().count(), 71);
    assert!(
        goes("check swing.mbs").starts_with("swing.mbs: Pendulum, 2 coordinates, 1 constraint, 1 degree of")
    );
}

#[test]
fn errors_are_shown_with_their_source() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("good.mbs"), SWING).unwrap();
    fs::write(folder.path().join("bad.mbs"), SWING.replace("y + length", "y + mass")).unwrap();
    let unstable = SWING.replace("900 [1/s], 900", "9000 [1/s], 900");
    fs::write(folder.path().join("unstable.mbs"), unstable).unwrap();
    for command in ["simulate", "explain", "check"] {
        let output = mbs(folder.path(), &format!("{command} bad.mbs"));
        assert_eq!(output.status.code(), Some(1));
        let shown = text(output.stderr);
        for part in ["`mass`", "bad.mbs:11:", "output height [mm] = y + mass;"] {
            assert!(shown.contains(part), "{shown}");
        }
    }
    let unstable = text(mbs(folder.path(), "check unstable.mbs").stderr);
    assert!(unstable.contains("are unstable with held feedback") && unstable.contains("unstable.mbs:5:"));
    let output = mbs(folder.path(), "check good.mbs bad.mbs");
    assert_eq!(output.status.code(), Some(1));
    assert!(text(output.stderr).ends_with("error: 1 of 2 declarations cannot be compiled\n"));
    assert!(text(output.stdout).starts_with("good.mbs: "));
    let found: serde_json::Value =
        serde_json::from_slice(&mbs(folder.path(), "check --json good.mbs bad.mbs").stdout).unwrap();
    assert_eq!(found[0]["problems"], serde_json::json!([]));
    assert_eq!(found[1]["problems"][0]["place"]["line"], 11);
}

#[test]
fn a_declaration_to_begin_with() {
    let folder = tempfile::tempdir().unwrap();
    assert!(mbs(folder.path(), "new --file my.mbs").status.success());
    assert!(mbs(folder.path(), "check my.mbs").status.success());
    assert!(!mbs(folder.path(), "new --file my.mbs").status.success(), "it is there already");
}
