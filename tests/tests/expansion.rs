//! The expansion of `mechanism!`, of a pendulum, as a person reviews it: items, signatures and documentation,
//! with the bodies of functions left out. These are counted (`operation_counts`) and run (everywhere else).
//!
//! A change of what is generated shows here as a difference to review;
//! `BLESS=1 cargo test --release --workspace --test expansion` accepts it.
#![allow(clippy::expect_used, reason = "helpers of tests")]

mod declarations;

use std::path::Path;

fn expand(declaration: proc_macro2::TokenStream) -> proc_macro2::TokenStream {
    mbs_codegen::expand(declaration, &mut |_| Err("no file".into()))
}

#[test]
fn the_expansion_of_a_pendulum_is_the_expected_one() {
    let all = declarations::of_models();
    let (name, declaration) = all.into_iter().find(|(name, _)| *name == "pendulum").expect("a pendulum");
    let difference = compared(name, &outline(expand(declaration)));
    assert!(difference.is_empty(), "BLESS=1 accepts this expansion:\n{difference}");
}

/// How an expansion differs from what is kept under this name, which `BLESS` replaces.
fn compared(name: &str, found: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/expected/{name}.rs"));
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, found).expect("a place to write to");
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    if found == expected {
        return String::new();
    }
    format!("\n{}\n{}", path.display(), difference(&expected, found))
}

#[test]
fn expansion_is_deterministic() {
    for (name, declaration) in declarations::of_models() {
        let first = expand(declaration.clone()).to_string();
        let second = expand(declaration).to_string();
        assert!(first == second, "{name} expands differently the second time");
    }
}

/// The items with their documentation and signatures; constants without their values.
fn outline(tokens: proc_macro2::TokenStream) -> String {
    let mut file: syn::File = syn::parse2(tokens).expect("an expansion is Rust");
    for item in &mut file.items {
        let syn::Item::Impl(item) = item else { continue };
        for member in &mut item.items {
            match member {
                syn::ImplItem::Fn(function) => function.block.stmts.clear(),
                syn::ImplItem::Const(constant) => constant.expr = syn::parse_quote!(..),
                _ => {}
            }
        }
    }
    prettyplease::unparse(&file)
}

/// The lines between the first and the last that differ.
fn difference(expected: &str, found: &str) -> String {
    let (expected, found): (Vec<_>, Vec<_>) = (expected.lines().collect(), found.lines().collect());
    let same = |(a, b): &(&&str, &&str)| a == b;
    let first = expected.iter().zip(&found).take_while(same).count();
    let shorter = expected.len().min(found.len());
    let last = expected.iter().rev().zip(found.iter().rev()).take_while(same).count().min(shorter - first);
    let mut text = format!("from line {}:\n", first + 1);
    for (sign, lines) in [('-', &expected), ('+', &found)] {
        let changed = &lines[first..lines.len() - last];
        for line in changed.iter().take(40) {
            text.push_str(&format!("{sign} {line}\n"));
        }
        if changed.len() > 40 {
            text.push_str(&format!("{sign} … and {} more lines\n", changed.len() - 40));
        }
    }
    text
}
