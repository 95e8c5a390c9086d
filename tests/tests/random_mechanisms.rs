//! Random mechanisms as a person might declare them: each compiles, or is refused with
//! a reason in its own words.
//!
//! `MECHANISMS=2000 cargo test --release -p tests --test random_mechanisms` tries more.
#![allow(clippy::expect_used, reason = "a test")]

use std::time::Duration;

use paths::some_of;
use rayon::prelude::*;
use tests::fuzzing::verdict::{Verdict, judge};
use tests::linkages::declaration;

const MECHANISMS: u64 = 200;

/// The time after which a compilation counts as endless, on machines that are busy with something else too.
/// No mechanism is large: the longest takes seconds. How long a compilation takes is measured by
/// `benches/expansion`.
const LIMIT: Duration = Duration::from_secs(60);

#[test]
fn random_mechanisms_compile_or_are_refused_with_a_reason() {
    let count =
        std::env::var("MECHANISMS").map_or(some_of(MECHANISMS), |text| text.parse().expect("a number"));
    let compiles = |number: u64| {
        let text = declaration(number);
        let verdict = judge(&text, LIMIT);
        assert!(!verdict.is_failure() && verdict != Verdict::NoTokens, "{verdict:?} of\n{text}");
        verdict == Verdict::Compiled
    };
    let compiled = (0..count).into_par_iter().filter(|number| compiles(*number)).count() as u64;
    // Joints are placed at random, so that some repeat what others say.
    assert!(2 * compiled > count, "{compiled} of {count} compile");
}
