//! Functional mock-up units as C: without a warning, with the bits of the program's own runs, refusing what
//! is wrong, and clean under sanitizers and valgrind over ten thousand instances. Tests with importers are in
//! `tests/fmi`, in Python.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::path::Path;
use std::process::Command;

use c_code::{compilers, is_there};
use mbs_live::{Experiment, Run, Text};
use mbs_runtime::System;
use paths::some_of;
use tempfile::TempDir;

/// With drives and without, tables, redundant constraints, own states and loops of long programs, clocks.
const MECHANISMS: [&str; 8] = [
    "slider-crank",
    "slider-crank-free",
    "cam-follower",
    "double-pendulum",
    "tipper",
    "dc-motor",
    "n-pendulum-40",
    "path-follower",
];

/// Of which nothing is integrated, and without constraints and parameters; C has no arrays without elements. And one
/// whose input begins at a declared value. And a block that rubs on a stop, which co-simulation alone has.
const SPARSE: [&str; 4] = [
    "Mechanism { dof = 0; states = reduced; body block (x) { mass = 1 [kg]; }
        drive motor: x = 0.1 [m]*sin(3 [rad/s]*t); start { guess x = 0; } output force [N] = effort(motor); }",
    "Free { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 0; der(x) = 1 [m/s]; } }",
    "Pushed { dof = 1; input push [N] = 3; body block (x) { mass = 1 [kg]; } force f on x = push; start { x = 0; } }",
    "Rough { dof = 2; gravity = (1, -9.81) [m/s^2]; body block (x, y) { mass = 1 [kg]; }
        stop floor: y >= 0 [m] { restitution = 0.2; friction = 0.3; along = x; }
        start { y = 2e-4 [m]; der(x) = 2e-3 [m/s]; der(y) = -0.5 [m/s]; } }",
];

const STEP: f64 = 1e-4;

fn text(name: &str) -> Text {
    mbs::library().iter().find(|entry| entry.name == name).unwrap().text()
}

fn texts() -> impl Iterator<Item = (&'static str, Text)> {
    let sparse =
        SPARSE.into_iter().map(|declaration| (declaration, Text::declaration("sparse.mbs", declaration)));
    MECHANISMS.into_iter().map(|name| (name, text(name))).chain(sparse).step_by(paths::STRIDE)
}

/// The sources of a unit in a folder, with a program around them that makes so many instances four times.
fn exported(text: &Text, instances: usize) -> TempDir {
    let fmu = text.fmu(Experiment { step: STEP, end: 1.0 }).unwrap();
    let folder = TempDir::new().unwrap();
    for file in &fmu.sources {
        std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
    }
    let exchanges = fmu.descriptions.iter().any(|(_, description)| description.contains("<ModelExchange"));
    let kinds = if exchanges { "" } else { "#define CO_SIMULATION_ALONE\n" };
    let main = kinds.to_owned()
        + &include_str!("fmi.c").replace("NAME", &fmu.identifier).replace("TURNS", &instances.to_string());
    std::fs::write(folder.path().join("main.c"), main).unwrap();
    std::fs::write(folder.path().join("solver.c"), format!("#include \"{}.c\"\n", fmu.identifier)).unwrap();
    folder
}

/// Runs a command, which has to succeed, and returns what it prints.
fn run(folder: &Path, line: &str) -> String {
    let output = Command::new("sh").args(["-c", line]).current_dir(folder).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "`{line}` says\n{said}{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stdout).unwrap()
}

/// Positions and velocities after twenty steps, as the program prints their bits.
fn native(text: &Text) -> String {
    let live = text.compile().unwrap();
    let mut run = Run::builder(&live, STEP).build().unwrap();
    for _ in 0..20 {
        run.step().unwrap();
    }
    let count = live.declared_info().coordinates.len();
    let (mut q, mut v) = (vec![0.0; count], vec![0.0; count]);
    run.state(&mut q, &mut v);
    q.iter().chain(&v).map(|x: &f64| format!("{:016x} ", x.to_bits())).collect()
}

#[test]
fn both_versions_have_the_bits_of_a_run_without_a_warning() {
    for compiler in compilers() {
        for (name, text) in texts() {
            let folder = exported(&text, 1);
            let warnings = "-Wall -Wextra -Wconversion -Wdouble-promotion -Werror -pedantic";
            let flags = format!("-std=c99 -O2 -ffp-contract=off {warnings}");
            run(folder.path(), &format!("{compiler} {flags} solver.c main.c -lm -o unit"));
            let expected = native(&text);
            let printed = run(folder.path(), "./unit");
            assert_eq!(printed, format!("{expected}\n{expected}\n"), "{name}");
        }
    }
}

#[test]
fn sanitizers_find_nothing() {
    // those of clang where it is there, else of gcc: both are the same library
    if let Some(compiler) = compilers().pop() {
        for (_, text) in texts() {
            let folder = exported(&text, 3);
            let flags = "-std=c99 -g -O1 -fsanitize=address,undefined -fno-sanitize-recover=all";
            run(folder.path(), &format!("{compiler} {flags} solver.c main.c -lm -o checked"));
            run(folder.path(), "./checked");
        }
    }
}

#[test]
fn a_program_for_windows_has_the_same_bits() {
    if !["x86_64-w64-mingw32-gcc", "wine"].iter().all(|tool| is_there(tool)) {
        return;
    }
    let folder = exported(&text("slider-crank-free"), 1);
    run(
        folder.path(),
        "x86_64-w64-mingw32-gcc -std=c99 -O2 -ffp-contract=off solver.c main.c -lm -o unit.exe",
    );
    let printed = run(folder.path(), "WINEDEBUG=-all wine unit.exe").replace('\r', "");
    let expected = native(&text("slider-crank-free"));
    assert_eq!(printed, format!("{expected}\n{expected}\n"));
}

/// Four instances a turn: forty thousand are made and freed, and every byte of them.
#[test]
fn ten_thousand_instances_leave_nothing_behind() {
    if !["valgrind", "gcc"].iter().all(|tool| is_there(tool)) {
        return;
    }
    let folder = exported(&text("slider-crank-free"), some_of(10_000) as usize);
    run(folder.path(), "gcc -std=c99 -g -O2 solver.c main.c -lm -o plain");
    run(folder.path(), "valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=all ./plain");
}
