//! Writes mechanisms of the library with `gradients = reverse;`, as one file of modules.
#![allow(clippy::expect_used, reason = "a build says by panicking what is wrong")]

use std::fmt::Write;
use std::fs;
use std::path::Path;

/// Of each kind of what is transposed: friction that depends on reactions, a spline, loops of long programs, a
/// drive, a spring and a damper, own states, outputs of all kinds.
const PLAIN: [&str; 9] = [
    "block_on_incline",
    "cam_follower",
    "dc_motor",
    "four_bar_free",
    "n_four_bar",
    "slider_crank",
    "slider_crank_free",
    "spring_mass_damper",
    "tipper",
];

/// With reduced states.
const REDUCED: [&str; 2] = ["four_bar_free", "slider_crank_free"];

fn main() {
    let library = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    println!("cargo::rerun-if-changed={}", library.display());
    let mut code = String::new();
    let mut module = |file: &str, name: &str, statements: &str| {
        let text = fs::read_to_string(library.join(file).with_extension("rs")).expect("a mechanism");
        let changed = text.replace(" dof = ", &format!(" {statements} dof = "));
        assert_ne!(changed, text, "{file} has no degrees of freedom");
        let _ = writeln!(code, "pub mod {name} {{\n{changed}\n}}");
    };
    PLAIN.iter().for_each(|name| module(name, name, "gradients = reverse;"));
    for name in REDUCED {
        module(name, &format!("reduced_{name}"), "states = reduced; gradients = reverse;");
    }
    let out = std::env::var("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&out).join("library.rs"), code).expect("a place to write to");
}
