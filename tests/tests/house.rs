//! Imports run one way: along the order of rooms that ARCHITECTURE.md draws, and no other.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The rooms of the compiler in the order of the line that begins so; what stands between
/// commas are neighbours, which do not see each other.
fn order() -> Vec<Vec<String>> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("it is there");
    let line = text.lines().find(|line| line.trim_start().starts_with("mechanics, diagnostics, quantity ←"));
    let line = line.expect("the order of rooms is drawn");
    let rooms = |step: &str| step.split(',').map(|room| room.trim().to_owned()).collect();
    line.split('←').map(rooms).collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// The rooms that a file names, apart from comments, documentation and tests of its own.
fn named(text: &str) -> Vec<String> {
    let text = text.split("#[cfg(test)]\nmod ").next().unwrap_or(text);
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let code: String = code.collect::<Vec<_>>().join("\n");
    let ends = |c: char| !(c.is_alphanumeric() || c == '_');
    code.split("crate::").skip(1).filter_map(|rest| rest.split(ends).next()).map(str::to_owned).collect()
}

#[test]
fn rooms_of_the_compiler_see_those_before_them_alone() {
    let order = order();
    let place = |room: &str| order.iter().position(|rooms| rooms.iter().any(|known| known == room));
    let source = root().join("mbs-macro/codegen/src");
    let mut found = Vec::new();
    files(&source, &mut found);
    let mut imports = 0;
    for path in found {
        let inside = path.strip_prefix(&source).expect("a file of the compiler");
        let first = inside.components().next().expect("a name").as_os_str().to_string_lossy();
        let room = first.trim_end_matches(".rs").to_owned();
        if room == "lib" {
            continue;
        }
        let here = place(&room).unwrap_or_else(|| panic!("`{room}` is not drawn"));
        for other in named(&fs::read_to_string(&path).expect("a text")) {
            // what lib.rs hands on, such as `crate::Compiled`
            let Some(there) = place(&other) else { continue };
            let is_before = there < here || other == room;
            assert!(is_before, "{}: `{room}` must not see `{other}`", path.display());
            imports += 1;
        }
    }
    assert!(imports > 100, "{imports}");
}

/// A target knows a mechanism by `Compiled` alone.
#[test]
fn targets_see_the_waist_alone() {
    let mut found = Vec::new();
    files(&root().join("mbs-macro/codegen/src/targets"), &mut found);
    for path in found {
        for other in named(&fs::read_to_string(&path).expect("a text")) {
            let is_allowed =
                ["compiled", "targets", "diagnostics", "Compiled", "FunctionId"].contains(&&*other);
            assert!(is_allowed, "{}: a target must not see `{other}`", path.display());
        }
    }
}

/// Mechanics are formulas and facts: no names of a declaration, no spans, no tokens.
#[test]
fn mechanics_know_no_tokens() {
    let mut found = Vec::new();
    files(&root().join("mbs-macro/codegen/src/mechanics"), &mut found);
    assert!(found.len() > 5, "{}", found.len());
    for path in found {
        let text = fs::read_to_string(&path).expect("a text");
        for library in ["proc_macro", "syn::", "quote"] {
            assert!(!text.contains(library), "{}: no `{library}` here", path.display());
        }
    }
}
