//! Whole runs at stops in the script of pages, where Node is installed: they have the bits of live ones.

use std::fs;
use std::process::Command;

use mbs_live::{RUN_SCRIPTS, Run, Text};
use mbs_runtime::System;
use paths::STRIDE;
use tests::{between_stops, rough, thrown};

const STEP: f64 = 1e-3;
const STEPS: usize = 1000;

/// Lines of bits of t, q, v and inputs; zeros are alike.
fn live(text: &Text) -> Vec<String> {
    let live = text.compile().unwrap_or_else(|error| panic!("{error}"));
    let info = live.declared_info();
    let count = info.coordinates.len();
    let mut run = Run::builder(&live, STEP).build().unwrap();
    let mut lines = Vec::new();
    for taken in 0..=STEPS {
        let (mut q, mut v) = (vec![0.0; count], vec![0.0; count]);
        let mut inputs = vec![0.0; info.inputs.len()];
        run.state(&mut q, &mut v);
        run.inputs(&mut inputs);
        let numbers = [vec![run.time()], q, v, inputs].concat();
        let bits: Vec<String> = numbers.iter().map(|x| format!("{:x}", (x + 0.0).to_bits())).collect();
        lines.push(bits.join(" "));
        if taken < STEPS {
            run.step().unwrap();
        }
    }
    lines
}

/// The same of the script of pages.
fn of_page(text: &Text, script: &str) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let wasm = text.wasm().unwrap_or_else(|error| panic!("{error}"));
    fs::write(folder.path().join("module.wasm"), &wasm.module).unwrap();
    fs::write(folder.path().join("tables.json"), &wasm.tables).unwrap();
    let program = folder.path().join("runs.js");
    fs::write(&program, format!("{script}\n{}", include_str!("runs.js"))).unwrap();
    let mut command = Command::new("node");
    command.arg(&program).arg(folder.path()).args([STEP.to_string(), STEPS.to_string()]);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().lines().map(str::to_owned).collect()
}

#[test]
fn runs_at_stops_have_the_bits_of_live_ones() {
    if Command::new("node").arg("--version").output().is_err() {
        eprintln!("skipped: `node` is not on this machine");
        return;
    }
    let [_, smooth, rubbing] = RUN_SCRIPTS;
    let modes = |number| between_stops::switching(number, &between_stops::rubbing(number));
    let forces =
        |number| between_stops::bearing(&between_stops::letting_go(number, &between_stops::rubbing(number)));
    let forces = (0..4).map(|number| (format!("forces {number}"), forces(number), smooth));
    let smooth = (0..4).map(|number| (format!("modes {number}"), modes(number), smooth)).chain(forces);
    let thrown = |number| match (thrown::random(number), number % 2) {
        ((text, _), 0) => text,
        ((text, _), _) => between_stops::bearing(&text),
    };
    let thrown = (0..8).map(|number| (format!("thrown {number}"), thrown(number), rubbing));
    let rough = rough::rough().map(|(name, text)| (name.to_owned(), text, rubbing));
    for (name, text, script) in smooth.chain(thrown).chain(rough).step_by(STRIDE) {
        let text = Text::declaration(name.clone(), text);
        let (found, expected) = (of_page(&text, script), live(&text));
        for (at, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(found, expected, "{name}, line {at}");
        }
        assert_eq!(found.len(), expected.len(), "{name}");
    }
}
