//! Every file of `corpus/` compiles or is answered with errors: seeds that use
//! each kind of statement, and what once made the compiler panic or run away.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::collections::BTreeSet;
use std::fs;
use std::time::Duration;

use tests::fuzzing::verdict::{Verdict, judge};

/// Far more than the milliseconds that these take, on any machine.
const LIMIT: Duration = Duration::from_secs(60);

fn corpus() -> Vec<(String, String)> {
    let files =
        fs::read_dir("corpus").expect("the folder is here").map(|file| file.expect("readable").path());
    let mut texts: Vec<_> =
        files.map(|path| (path.display().to_string(), fs::read_to_string(&path).expect("a text"))).collect();
    texts.sort();
    texts
}

#[test]
fn every_file_is_answered() {
    for (path, text) in corpus() {
        let verdict = judge(&text, LIMIT);
        assert!(!verdict.is_failure(), "{path}: {verdict:?}");
        // seeds are valid by name
        if path.contains("valid_") {
            assert_eq!(verdict, Verdict::Compiled, "{path}");
        }
    }
}

/// Each keyword of the language occurs in a file that compiles.
#[test]
fn seeds_use_every_statement() {
    const KEYWORDS: &str = "dof crate param const input let gravity body constraint drive coupler force torque \
        start output point profile spring torsion_spring require for if assembly instance revolute fixed \
        prismatic point_on_line pin_slot distance gear internal_gear belt crossed_belt rack rolling cam";
    let valid = corpus().into_iter().filter(|(path, _)| path.contains("valid_"));
    let words: BTreeSet<String> = valid
        .flat_map(|(_, text)| {
            let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_owned);
            words.collect::<Vec<_>>()
        })
        .collect();
    let missing: Vec<_> = KEYWORDS.split_whitespace().filter(|word| !words.contains(*word)).collect();
    assert!(missing.is_empty(), "no seed uses {missing:?}");
}
