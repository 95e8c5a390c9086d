//! Every file of `corpus/` compiles or is answered with errors: seeds that use
//! each kind of statement, and what once made the compiler panic or run away.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::collections::BTreeSet;
use std::fs;
use std::time::Duration;

use mbs_codegen::KeywordKind;
use rayon::prelude::*;
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
    corpus().into_par_iter().for_each(|(path, text)| {
        let verdict = judge(&text, LIMIT);
        assert!(!verdict.is_failure(), "{path}: {verdict:?}");
        // seeds are valid by name
        if path.contains("valid_") {
            assert_eq!(verdict, Verdict::Compiled, "{path}");
        }
    });
}

/// Each keyword of the language occurs in a file that compiles.
#[test]
fn seeds_use_every_statement() {
    let valid = corpus().into_iter().filter(|(path, _)| path.contains("valid_"));
    let words: BTreeSet<String> = valid
        .flat_map(|(_, text)| {
            let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_owned);
            words.collect::<Vec<_>>()
        })
        .collect();
    let keywords = mbs_codegen::keywords().into_iter().map(|keyword| keyword.word);
    let missing: Vec<_> = keywords.filter(|word| !words.contains(*word)).collect();
    assert!(missing.is_empty(), "no seed uses {missing:?}");
}

/// Each keyword of the language stands on the language page, as code.
#[test]
fn language_page_names_every_keyword() {
    let page = fs::read_to_string("../mbs-runtime/src/language.md").expect("the page is there");
    let code: BTreeSet<&str> = page
        .split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '`'))
        .filter_map(|word| word.strip_prefix('`'))
        .map(|word| word.trim_end_matches('`'))
        .collect();
    let keywords = mbs_codegen::keywords().into_iter().map(|keyword| keyword.word);
    let missing: Vec<_> = keywords.filter(|word| !code.contains(word)).collect();
    assert!(missing.is_empty(), "the page does not explain {missing:?}");
}

/// Every form of the table of keywords is one that the parser reads.
#[test]
fn forms_of_keywords_are_read() {
    for keyword in mbs_codegen::keywords() {
        let form = match keyword.kind {
            KeywordKind::Statement | KeywordKind::Block => keyword.form.to_owned(),
            KeywordKind::Joint => format!("{} name {};", keyword.word, keyword.form),
            KeywordKind::Element => format!("{} name {}", keyword.word, keyword.form),
        };
        let form = form.replace(", …)", ", (180 [deg], 30 [mm]), (270 [deg], 20 [mm]))").replace('…', "");
        let tokens = format!("Form {{ dof = 1; {form} }}").parse().expect("tokens");
        let errors = mbs_codegen::compile(tokens).err().into_iter();
        let texts: Vec<String> =
            errors.flat_map(|errors| errors.iter().map(|e| e.text()).collect::<Vec<_>>()).collect();
        // names are missing, shapes are right
        let shapes = ["expected", "begin a statement", "clause", "takes no", "needs"];
        let wrong = texts.iter().find(|text| shapes.iter().any(|shape| text.contains(shape)));
        assert!(wrong.is_none(), "{form}: {wrong:?}");
        assert!(!keyword.meaning.is_empty());
    }
}
