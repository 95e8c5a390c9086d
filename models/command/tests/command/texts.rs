//! Mechanisms from files.

use std::fs;
use std::process::Command;

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

/// A parameter that nothing uses gives a warning and no error.
#[test]
fn what_nothing_uses_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let declaration =
        "A {\n    dof = 1;\n    param k = 2 [N/m];\n    body block (x) { mass = 1 [slug]; }\n}\n";
    fs::write(folder.path().join("a.mbs"), declaration).unwrap();
    let output = mbs(folder.path(), "check a.mbs");
    assert!(output.status.success() && text(output.stdout).starts_with("a.mbs: A, 1 coordinate"));
    let message = text(output.stderr);
    for part in ["Warning: this parameter is never used", "a.mbs:3:11", "param k = 2 [N/m];", "remove it"] {
        assert!(message.contains(part), "{message}");
    }
    let found: serde_json::Value =
        serde_json::from_slice(&mbs(folder.path(), "check --json a.mbs").stdout).unwrap();
    assert_eq!(found[0]["problems"][0]["severity"], "warning");
}

#[test]
fn a_declaration_to_begin_with() {
    let folder = tempfile::tempdir().unwrap();
    assert!(mbs(folder.path(), "new --file my.mbs").status.success());
    assert!(mbs(folder.path(), "check my.mbs").status.success());
    assert!(!mbs(folder.path(), "new --file my.mbs").status.success(), "it is there already");
}

/// By the compiler of the machine, if there is one, with the warnings that firmware has.
#[test]
fn a_mechanism_as_c_runs() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "export c four-bar --out c");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for file in ["four_bar.h", "four_bar.c", "main.c", "README.md"] {
        assert!(folder.path().join("c").join(file).is_file(), "{file}");
    }
    let flags = "-std=c99 -Wall -Wextra -Wconversion -Werror -pedantic -O2 -ffp-contract=off -o run";
    let compiled = Command::new("gcc")
        .args(flags.split(' '))
        .args(["c/four_bar.c", "c/main.c", "-lm"])
        .current_dir(folder.path())
        .output();
    let Ok(compiled) = compiled else {
        eprintln!("skipped: there is no gcc");
        return;
    };
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let table = Command::new(folder.path().join("run")).output().unwrap();
    assert!(table.status.success());
    let table = text(table.stdout);
    assert!(table.lines().count() > 100, "{table}");
    assert!(mbs(folder.path(), "export c four-bar --out c").status.success(), "its own files are renewed");
    let output = mbs(folder.path(), "export c pendulum --out c");
    assert!(
        text(output.stderr)
            .contains("main.c` cannot be used: it is there already, and not of this mechanism")
    );
    assert!(!folder.path().join("c/pendulum.c").exists());
    super::refuses("export c four-bar", &["--out"]);
}
