//! Whatever is declared, the compiler answers: it never panics.

use std::time::Duration;

use paths::{STRIDE, some_of};
use rayon::prelude::*;
use tests::fuzzing::verdict::{Verdict, judge};
use tests::fuzzing::{input, seeds};

const INPUTS: u64 = 3_000;

/// A minute for what takes milliseconds: this is a test of answers, and machines
/// are busy at times. `cargo run --example fuzz` looks at times.
const LIMIT: Duration = Duration::from_secs(60);

/// The first inputs of the fuzzer: mutations of valid declarations and made-up ones.
#[test]
fn made_up_declarations_do_not_panic() {
    // tokens stay on their thread
    let compiles = |seeds: &mut Vec<_>, index: u64| {
        let text = input(seeds, 1, index);
        let verdict = judge(&text, LIMIT);
        assert!(!verdict.is_failure(), "{verdict:?} of\n{text}");
        verdict == Verdict::Compiled
    };
    let inputs = some_of(INPUTS);
    let compiled =
        (0..inputs).into_par_iter().map_init(seeds::all, compiles).filter(|compiled| *compiled).count()
            as u64;
    // so that what lies behind the first stages is reached
    assert!(compiled > inputs / 100, "{compiled} of {inputs} compile");
}

/// Every seed compiles, so that mutations start from what is valid.
#[test]
fn seeds_compile() {
    for seed in seeds::all().into_iter().step_by(STRIDE) {
        let text = tests::fuzzing::text(seed.tokens);
        assert_eq!(judge(&text, LIMIT), Verdict::Compiled, "{text}\n{:?}", errors(&text));
    }
}

/// The errors of the compiler.
fn errors(text: &str) -> Vec<String> {
    let answer = tests::fuzzing::tokens(text).map(mbs_codegen::compile);
    answer.and_then(Result::err).iter().flat_map(|errors| errors.iter()).map(|error| error.text()).collect()
}
