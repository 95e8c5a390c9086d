//! The book shows what happens.
//!
//! The chapters are read one after the other, as SUMMARY.md has them, in one folder, as a reader would:
//! `book` in cargo's folder for files of tests, from where the pictures go into the book. A block below the
//! name of a file is written to that file. Each command of a `console` block is run there, and its output is
//! compared with what stands below it; `...` and `[..]` stand for what may differ. Blocks of `python` are run
//! where `BOOK_PYTHON` is an interpreter that has the package `mbs`. Blocks of `rust` are compiled and run by
//! the crate `book`. `BLESS=1` writes into the chapters what was printed.

mod chapter;
mod run;

use std::fs;
use std::path::{Path, PathBuf};

use chapter::blocks;
use run::Reading;

/// Where the chapters are.
fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../book/src")
}

/// Commands that are not run, by how they begin, and why.
const NOT_RUN: &[(&str, &str)] = &[
    ("rustup ", "installs a compiler"),
    ("git clone ", "needs the network"),
    ("cargo install ", "installs the command on this machine"),
    ("pip install ", "installs a package on this machine"),
    ("cargo run ", "compiles for minutes; another step of CI does the same"),
    ("sbatch ", "needs a cluster"),
    ("parallel ", "needs a program that few have"),
];

/// The chapters that are written by hand, in the order in which they are read.
fn chapters() -> Vec<(String, String)> {
    let summary = fs::read_to_string(source().join("SUMMARY.md")).unwrap();
    let named = summary.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let found: Vec<_> = named
        .filter_map(|file| Some((file.to_owned(), fs::read_to_string(source().join(file)).ok()?)))
        .collect();
    let files = fs::read_dir(source()).unwrap().count();
    assert_eq!(found.len() + 1, files, "SUMMARY.md has all files, and there are no others");
    found
}

#[test]
fn commands_print_what_the_chapters_show() {
    let (path, mut wrong) = (run::emptied(), Vec::new());
    for (file, text) in chapters() {
        let reading = Reading { chapter: &file, path: &path };
        let printed = reading.read(&blocks(&text), &mut wrong);
        if std::env::var_os("BLESS").is_some() {
            let mut blessed = text.clone();
            for (range, shown) in printed.into_iter().rev() {
                blessed.replace_range(range, &shown);
            }
            if blessed != text {
                fs::write(source().join(&file), blessed).unwrap();
            }
        }
    }
    assert!(wrong.is_empty(), "{}\n\nlook at it; if it is right, accept it with BLESS=1", wrong.join("\n\n"));
}

#[test]
fn everything_in_the_chapters_is_run() {
    let crate_of_rust = fs::read_to_string(source().join("../lib.rs")).unwrap();
    for (file, text) in chapters() {
        let all = blocks(&text);
        for (block, before) in all.iter().zip(std::iter::once(None).chain(all.iter().map(Some))) {
            let is_run = match block.language {
                "console" | "console,interrupted" | "python" => true,
                "rust" => crate_of_rust.contains(&format!("\"src/{file}\"")),
                "text" => before.is_some_and(|before| before.language == "python"),
                "sh" => commands_of(block.text)
                    .all(|line| NOT_RUN.iter().any(|(begin, _)| line.starts_with(begin))),
                // a file, which commands that follow take
                _ => block.file.is_some_and(|name| {
                    let rest = all.iter().filter(|other| other.range.start > block.range.start);
                    rest.into_iter().any(|other| other.text.contains(name))
                }),
            };
            assert!(is_run, "{file}: nothing runs this block of `{}`:\n{}", block.language, block.text);
        }
    }
}

/// The lines that begin a command.
fn commands_of(block: &str) -> impl Iterator<Item = &str> {
    let is_first = |line: &&str| !line.is_empty() && !line.starts_with(' ') && !line.starts_with('#');
    block.lines().filter(is_first)
}
