//! Every mistake in a declaration is answered at its own token, in the words of the declaration, with a way to
//! mend it.
//!
//! The cases are in `mistakes/`, one folder for each kind of mistake. A case is a declaration with its answer
//! below it, in lines that begin with `//>`:
//!
//! ```text
//! // A length is given twice.
//! Slider {
//!     dof = 1;
//!     param l = 2 [m];
//!     param l = 3 [m];
//!     body block (x) { mass = 1 [kg]; }
//! }
//! //> error 5:11..12: `l` is declared twice
//! //>   help: rename one of them
//! //>   note 4:11..12: `l` is first declared here
//! ```
//!
//! A place is a line of the file, the first column and the one behind the last. A file may go on with another
//! declaration.
//!
//! To add a case, write the declaration with a line `//>` below it, and run
//! `BLESS=1 cargo test --release -p mbs-live --test mistakes`, which writes all answers. They are not edited by hand:
//! after a change of wording the difference is what to review.
//!
//! `designers` has mechanisms that are wrong as designers get them wrong. `tests/compile_fail` holds what rustc shows
//! of answers.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::{Path, PathBuf};

use mbs_live::{Location, Problem, Text};
use rayon::prelude::*;

/// The beginning of a line of an answer.
const ANSWER: &str = "//>";

#[test]
fn mistakes_are_answered() {
    let kinds = files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mistakes"));
    let cases: Vec<PathBuf> = kinds.iter().flat_map(|kind| files(kind)).collect();
    assert!(cases.len() > 100, "{} cases", cases.len());
    let wrong: Vec<String> = cases.par_iter().filter_map(|case| difference(case)).collect();
    assert!(wrong.is_empty(), "{}\nlook at it; if it is right, accept it with BLESS=1", wrong.join("\n"));
}

/// The entries of a folder, in the order of their names.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// The lines in which the answers of a file differ from those of the compiler. `BLESS` accepts them.
fn difference(case: &Path) -> Option<String> {
    let kept = fs::read_to_string(case).unwrap();
    let found = match answered(&kept) {
        Ok(found) if found == kept => return None,
        Ok(found) => found,
        Err(line) => return Some(format!("{}:{line}: this declaration has no mistake\n", case.display())),
    };
    if std::env::var_os("BLESS").is_some() {
        fs::write(case, found).unwrap();
        return None;
    }
    let (kept, found): (Vec<_>, Vec<_>) = (kept.lines().collect(), found.lines().collect());
    let same = |(a, b): &(&&str, &&str)| a == b;
    let first = kept.iter().zip(&found).take_while(same).count();
    let shorter = kept.len().min(found.len()) - first;
    let last = kept.iter().rev().zip(found.iter().rev()).take_while(same).take(shorter).count();
    let mut text = format!("{}:{}:\n", case.display(), first + 1);
    for (sign, lines) in [('-', &kept), ('+', &found)] {
        for line in &lines[first..lines.len() - last] {
            text += &format!("{sign} {line}\n");
        }
    }
    Some(text)
}

/// The declarations of a file, each with the answer that the compiler gives; or the line of one that it takes.
fn answered(file: &str) -> Result<String, usize> {
    let mut answered = String::new();
    for declaration in declarations(file) {
        // empty lines, so that places are those of the file
        let above = answered.lines().count();
        let text = "\n".repeat(above) + &declaration;
        let error = Text::declaration("case.mbs", text).compile().err().ok_or(above + 1)?;
        answered += &declaration;
        answered.extend(error.problems().iter().map(answer));
    }
    Ok(answered)
}

/// The text between the answers of a file.
fn declarations(file: &str) -> Vec<String> {
    let is_answer = |line: &&str| line.starts_with(ANSWER);
    let lines: Vec<&str> = file.lines().collect();
    let runs = lines.chunk_by(|line, next| is_answer(line) == is_answer(next));
    runs.filter(|run| !run.iter().any(is_answer)).map(|run| run.join("\n") + "\n").collect()
}

/// An error as it stands in a file.
fn answer(problem: &Problem) -> String {
    let mut answer = line("error", problem.location.as_ref(), &problem.message);
    if let Some(help) = &problem.help {
        answer += &line("  help", None, help);
    }
    for note in &problem.notes {
        answer += &line("  note", note.location.as_ref(), &note.message);
    }
    answer
}

fn line(head: &str, place: Option<&Location>, message: &str) -> String {
    let place = place.map_or(String::new(), |Location { line, column, length, .. }| {
        format!(" {line}:{column}..{}", column + length)
    });
    format!("{ANSWER} {head}{place}: {message}\n")
}
