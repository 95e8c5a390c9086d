//! The `mbs` command as people use it, and what it says when they slip.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

mod answers;
#[cfg(unix)]
mod book;
mod drawings;
mod ends;
mod files;
mod fits;
mod held;
mod imports;
mod inputs;
mod linear;
mod linkages;
mod own_states;
mod pages;
mod paper;
mod pieces;
mod pmks;
mod pmks_refused;
mod prescribed;
mod robots;
mod robots_left_out;
mod robots_placed;
mod robots_refused;
mod robots_refused_sdf;
mod runs;
mod shards;
mod starts;
mod sweeps;
mod texts;
mod trust;
mod units;
mod words;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn mbs(folder: &Path, arguments: &str) -> Output {
    let arguments = arguments.split_whitespace();
    Command::new(env!("CARGO_BIN_EXE_mbs")).args(arguments).current_dir(folder).output().unwrap()
}

/// The message of a command that has to fail.
fn refusal(arguments: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), arguments);
    assert!(!output.status.success(), "`mbs {arguments}` went through");
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.starts_with("error: "), "{message}");
    assert!(!message.contains("panicked"), "{message}");
    message
}

#[track_caller]
fn refuses(arguments: &str, parts: &[&str]) {
    let message = refusal(arguments);
    for part in parts {
        assert!(message.contains(part), "`mbs {arguments}` says\n{message}without `{part}`");
    }
}

/// Files that are not finished.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|ending| ending == "part")).collect()
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap()
}
