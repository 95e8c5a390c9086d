//! Every mechanism of the library compiles from its text, which is read and not built.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

use std::fs;
use std::path::{Path, PathBuf};

use mbs_live::Text;
use mbs_runtime::equations::Equations;
use paths::STRIDE;

fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src")
}

/// The mechanisms that a file declares by itself, and their names.
#[test]
fn mechanisms_of_the_library() {
    let mut names = Vec::new();
    for entry in fs::read_dir(models()).unwrap() {
        let path = entry.unwrap().path();
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        // chains are made by a macro
        let is_chain = path.file_stem().is_some_and(|stem| stem.to_string_lossy().starts_with("n_"));
        if !is_rust || is_chain || !fs::read_to_string(&path).unwrap().contains("\nmechanism! {") {
            continue;
        }
        let (live, warnings) = Text::read(&path).unwrap().check().unwrap_or_else(|error| panic!("{error}"));
        assert!(warnings.problems().is_empty(), "{warnings}");
        names.push(live.info().name);
    }
    assert!(names.len() > 25 && names.contains(&"SliderCrankFree"), "{names:?}");
}

#[test]
fn chains_of_the_library() {
    for file in ["n_pendulum.rs", "n_four_bar.rs"] {
        let text = fs::read_to_string(models().join(file)).unwrap();
        let text = text.replace("$(#[$($attribute)*])*", "").replace("$Name", "Chain").replace("$n", "12");
        let live = Text::rust(file, text).compile().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(live.info().dof, if file == "n_pendulum.rs" { 12 } else { 1 });
    }
}

#[test]
fn one_of_several_is_asked_for_by_its_name() {
    let pendulum = fs::read_to_string(models().join("pendulum.rs")).unwrap();
    let drift = fs::read_to_string(models().join("spring_mass_damper.rs")).unwrap();
    let both = pendulum + &drift;
    let error = Text::rust("both.rs", both.as_str()).compile().unwrap_err();
    assert!(error.to_string().contains("`Pendulum`"), "{error}");
    for name in ["Pendulum", "SpringMassDamper"] {
        let live = Text::rust("both.rs", both.as_str()).named(name).compile().unwrap();
        assert_eq!(live.info().name, name);
    }
    let error = Text::rust("both.rs", both).named("Pendulums").compile().unwrap_err();
    assert_eq!(error.problems()[0].message, "this file declares no mechanism `Pendulums`");
    let error = Text::rust("none.rs", "// mechanism! { }\nfn main() {}").compile().unwrap_err();
    assert_eq!(error.problems()[0].message, "this file has no `mechanism! { … }`");
}

/// Declarations that use every statement of the language, and what once was too much for
/// the compiler.
#[test]
fn declarations_of_the_corpus() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let mut compiled = 0;
    let mut paths: Vec<_> = fs::read_dir(corpus).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for (number, path) in paths.into_iter().enumerate() {
        let is_valid = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("valid_"));
        // what is refused is refused before a target is asked for; `corpus.rs` has all of it
        if !is_valid && number % STRIDE != 0 {
            continue;
        }
        match Text::declaration("corpus", fs::read_to_string(&path).unwrap()).compile() {
            Ok(_) => compiled += 1,
            Err(error) => {
                assert!(
                    !is_valid && !error.to_string().contains("internal inconsistency"),
                    "{}:\n{error}",
                    path.display()
                );
            }
        }
    }
    assert!(compiled > 10, "{compiled}");
}
