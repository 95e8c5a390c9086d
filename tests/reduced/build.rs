//! Writes the mechanisms of the library with `states = reduced;`, as one file of modules.
#![allow(clippy::expect_used, reason = "a build says by panicking what is wrong")]

use std::fmt::Write;
use std::fs;
use std::path::Path;

fn main() {
    let library = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    println!("cargo::rerun-if-changed={}", library.display());
    let root = fs::read_to_string(library.join("lib.rs")).expect("the library is there");
    let mut code = String::new();
    for line in root.lines() {
        match line.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(';')) {
            Some(name) => {
                let path = library.join(name).with_extension("rs");
                let text = fs::read_to_string(path).expect("a mechanism");
                // where there are stops all coordinates are integrated
                let states = if text.contains("    stop ") { "all" } else { "reduced" };
                let reduced = text.replace(" dof = ", &format!(" states = {states}; dof = "));
                assert_ne!(reduced, text, "{name} has no degrees of freedom");
                let _ = writeln!(code, "pub mod {name} {{\n{reduced}\n}}");
            }
            // the page is about the mechanisms as they are declared
            None if line.starts_with("//!") => {}
            None => code += &format!("{line}\n"),
        }
    }
    let out = std::env::var("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&out).join("library.rs"), code).expect("a place to write to");
}
