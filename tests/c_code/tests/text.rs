//! The C text of a pendulum, kept whole, so that a change of what is printed is seen in review:
//! `BLESS=1 cargo test -p c_code --test text` accepts it.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::path::Path;

use mbs_codegen::analyse;
use mbs_codegen::target::{Scalar, c};

const PENDULUM: &str = "/// A bob on a rod.
Pendulum {
    dof = 1;
    param length = 1 [m];
    input wind [N];
    gravity = (0, -9.81) [m/s^2];
    body bob (x, y) { mass = 2 [kg]; }
    force gust on bob = (wind, 0 [N]);
    constraint rod: x^2 + y^2 = length^2;
    start { x = length; guess y = 0; }
    output height [m] = y;
}";

#[test]
fn header_and_source_are_the_expected_ones() {
    let compiled = analyse(PENDULUM.parse().expect("tokens")).unwrap_or_else(|error| panic!("{error}"));
    let sources = c(&compiled, Scalar::Double).unwrap_or_else(|error| panic!("{error}"));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/expected");
    for file in [&sources.header, &sources.source] {
        let path = folder.join(&file.name);
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(&path, &file.text).expect("it is written");
        }
        let expected = std::fs::read_to_string(&path).unwrap_or_default();
        let mut lines = expected.lines().zip(file.text.lines()).enumerate();
        let difference = lines.find(|(_, (expected, found))| expected != found);
        let path = path.display();
        if let Some((at, (expected, found))) = difference {
            panic!("BLESS=1 accepts a change of {path}, line {}:\n- {expected}\n+ {found}", at + 1);
        }
        assert!(expected == file.text, "BLESS=1 accepts a change of {path} at its end");
    }
}
