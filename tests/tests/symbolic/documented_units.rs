//! The units that the language is documented to have are those that it has.

#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

use std::collections::BTreeSet;
use std::fs;

use mbs_symbolic::units;

#[test]
fn the_documented_units_are_those_of_the_table() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../mbs-runtime/src/language.md");
    let page = fs::read_to_string(page).unwrap();
    let (_, section) = page.split_once("\n# Units\n").unwrap();
    let list = section.split("\n\n").find(|paragraph| paragraph.contains(" · ")).unwrap();
    let documented: BTreeSet<&str> = list.split_whitespace().filter(|word| *word != "·").collect();
    assert_eq!(documented, units::known().collect());
}
