//! Every mistake in a declaration is answered at its own token, in the words
//! of the declaration, with a way to mend it; the answers are in `ui/`, one
//! folder for each kind of mistake.
//!
//! The `.stderr` files are never edited: after a change of wording,
//! `TRYBUILD=overwrite cargo test --release -p compile_fail` writes them anew,
//! and the difference is what to review. How rustc frames a message depends on
//! its version; they are written with rustc 1.95.

#[test]
fn mistakes_are_answered() {
    let cases = trybuild::TestCases::new();
    let kinds = std::fs::read_dir("ui").expect("the folder of cases is here");
    for kind in kinds {
        let folder = kind.expect("a folder can be read").path();
        cases.compile_fail(folder.join("*.rs"));
    }
}
