//! Writes random mechanisms as Rust, as many as `MECHANISMS` says.
#![allow(clippy::expect_used, clippy::panic, reason = "a build says by panicking what is wrong")]

use std::fmt::Write;
use std::path::Path;

#[path = "../src/linkages.rs"]
mod linkages;
#[path = "../src/random.rs"]
mod random;

/// A handful, because rustc takes about a second for each.
const MECHANISMS: u64 = 8;

fn main() {
    println!("cargo::rerun-if-env-changed=MECHANISMS");
    println!("cargo::rerun-if-changed=../src/linkages.rs");
    println!("cargo::rerun-if-changed=../src/random.rs");
    let count = std::env::var("MECHANISMS").map_or(MECHANISMS, |text| text.parse().expect("a number"));
    // not every random declaration is one of a mechanism that can be assembled
    let compiles = |number: &u64| {
        let tokens = linkages::declaration(*number).parse().expect("tokens");
        mbs_codegen::analyse(tokens).is_ok()
    };
    let mut code = String::new();
    let mut calls = String::new();
    for number in (0..).filter(compiles).take(count as usize) {
        let text = linkages::declaration(number);
        let _ = writeln!(code, "mod random_{number} {{\nmbs_runtime::mechanism! {{\n{text}}}\n}}");
        let _ = writeln!(calls, "    visit.visit::<random_{number}::Random{number}>({text:?});");
    }
    let _ = writeln!(code, "/// Visits every mechanism.\npub fn all(visit: &mut impl Visit) {{\n{calls}}}");
    let folder = std::env::var("OUT_DIR").expect("cargo says where");
    std::fs::write(Path::new(&folder).join("mechanisms.rs"), code).expect("the folder is there");
}
