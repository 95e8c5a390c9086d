//! A `#![no_std]` static library with mechanisms in it links without a
//! standard library and without an allocator, although its panic handler calls
//! a function that does not exist: no panic is reachable. The same library with
//! one unchecked index does not link.
#![cfg(target_os = "linux")]
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

/// Parts of symbols that no firmware wants to find: allocators, panics and their messages.
const UNWANTED: [&str; 6] = ["alloc", "malloc", "panic", "fmt", "unwind", "format"];

/// A copy of `tests/no_std` among the build outputs, so that neither its
/// `Cargo.lock` nor anything else is written into the sources. The lock file
/// is the workspace's: what is built here has been fetched for the tests.
fn copied_crate() -> PathBuf {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("`tests` is in the workspace");
    let source = workspace.join("tests/no_std");
    let copy = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no_std");
    fs::create_dir_all(copy.join("src")).expect("a writable target directory");
    let manifest = fs::read_to_string(source.join("Cargo.toml")).expect("the manifest");
    let runtime = workspace.join("mbs-runtime");
    let absolute = manifest.replace("../../mbs-runtime", &runtime.display().to_string());
    assert_ne!(absolute, manifest, "the manifest has the path of the runtime");
    fs::write(copy.join("Cargo.toml"), absolute).expect("a writable target directory");
    fs::copy(source.join("src/lib.rs"), copy.join("src/lib.rs")).expect("a writable target directory");
    fs::copy(workspace.join("Cargo.lock"), copy.join("Cargo.lock")).expect("a writable target directory");
    copy
}

fn build(copy: &Path, features: &[&str]) -> PathBuf {
    // where the firmware is built too, with the same compiler of mechanisms
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("firmware");
    let output = Command::new(env!("CARGO"))
        .args(["build", "--release", "--offline", "--quiet", "--target-dir"])
        .arg(&target)
        .args(features)
        .current_dir(copy)
        // flags of the outer build (coverage, sanitizers) need a standard library
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env_remove("CARGO_BUILD_TARGET")
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    target.join("release/libno_std.a")
}

/// Links, never to be run: the four block operations that every target's
/// compiler runtime brings stand for themselves.
fn link(library: &Path, program: &Path) -> Output {
    Command::new("cc")
        .args(["-nostdlib", "-nostartfiles", "-static", "-Wl,-e,entry", "-Wl,--gc-sections"])
        .args(["memcpy", "memmove", "memset", "memcmp"].map(|name| format!("-Wl,--defsym={name}=0")))
        .arg("-o")
        .arg(program)
        .arg("-Wl,-u,entry")
        .arg(library)
        .output()
        .expect("the C compiler that Rust links with")
}

#[test]
#[ignore = "builds the compiler of mechanisms anew, for a minute or two; `.ci/run` asks for it"]
fn mechanism_without_std_has_no_reachable_panic_and_no_allocator() {
    let copy = copied_crate();
    let program = copy.join("program");
    let linked = link(&build(&copy, &[]), &program);
    assert!(linked.status.success(), "{}", String::from_utf8_lossy(&linked.stderr));

    let symbols =
        Command::new("nm").arg("--defined-only").arg(&program).output().expect("nm comes with the linker");
    let symbols = String::from_utf8(symbols.stdout).expect("symbol names");
    assert!(symbols.contains("entry"), "{symbols}");
    for unwanted in UNWANTED {
        let found: Vec<_> = symbols.lines().filter(|line| line.contains(unwanted)).collect();
        assert!(found.is_empty(), "{found:?}");
    }
    println!("{} bytes, symbols:\n{symbols}", fs::metadata(&program).expect("just linked").len());

    // one unchecked index, and the proof fails as it should
    let refused = link(&build(&copy, &["--features", "reachable-panic"]), &program);
    assert!(!refused.status.success());
    let message = String::from_utf8_lossy(&refused.stderr);
    assert!(message.contains("a_panic_is_reachable"), "{message}");
}
