//! Refusals of the printed C code: the checks stand in `refusals.c`.

use std::path::Path;

use c_code::{build_around, compilers, declarations};
use mbs_codegen::analyse;
use mbs_codegen::targets::{Scalar, c};

#[test]
fn c_refuses_what_is_wrong_and_keeps_the_last_good_state() {
    let Some(&compiler) = compilers().first() else { return };
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    let all = declarations(&models).expect("the library is there");
    let (_, tokens) =
        all.into_iter().find(|(path, _)| path.ends_with("slider_crank_free.rs")).expect("a slider-crank");
    let sources = c(&analyse(tokens).expect("it compiles"), Scalar::Double).expect("it is printed");
    let built = build_around(&sources, include_str!("refusals.c"), compiler, crate::OPTIMIZATION)
        .unwrap_or_else(|fault| panic!("{fault}"));
    built.output().unwrap_or_else(|fault| panic!("{fault}"));
}
