//! Valid declarations: those of the models, of the tests, and some that use the
//! statements which these leave out.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::mutation::flat;

/// A valid declaration to start from.
pub struct Seed {
    /// The declaration.
    pub tokens: TokenStream,
    /// Its tokens, those in groups too.
    pub all: Vec<TokenTree>,
}

/// All of them.
pub fn all() -> Vec<Seed> {
    let of_files = SOURCES.iter().flat_map(|source| of_source(source));
    let written = WRITTEN.iter().filter_map(|text| text.parse::<TokenStream>().ok());
    of_files.chain(written).map(|tokens| Seed { all: flat(&tokens), tokens }).collect()
}

const SOURCES: &[&str] = &[
    include_str!("../../../models/src/slider_crank.rs"),
    include_str!("../../../models/src/slider_crank_free.rs"),
    include_str!("../../../models/src/pendulum.rs"),
    include_str!("../../tests/statements/composition.rs"),
    include_str!("../../tests/statements/couplings.rs"),
    include_str!("../../tests/hygiene.rs"),
    include_str!("../../tests/statements/joints.rs"),
    include_str!("../../tests/statements/profiles.rs"),
    include_str!("../../long/tests/references/double_fourbar_a02.rs"),
    include_str!("../../long/tests/references/slotted_pendulum_modelica.rs"),
];

/// The declarations in every `mechanism! { … }` of a file.
fn of_source(source: &str) -> Vec<TokenStream> {
    source.parse().map(declarations).unwrap_or_default()
}

fn declarations(stream: TokenStream) -> Vec<TokenStream> {
    let tokens: Vec<TokenTree> = stream.into_iter().collect();
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let is_declaration = group.delimiter() == Delimiter::Brace
            && at >= 2
            && matches!(&tokens[at - 2], TokenTree::Ident(word) if word == "mechanism")
            && matches!(&tokens[at - 1], TokenTree::Punct(mark) if mark.as_char() == '!');
        match is_declaration {
            true => found.push(group.stream()),
            false => found.extend(declarations(group.stream())),
        }
    }
    found
}

/// Statements that the mechanisms of the files use rarely or never.
const WRITTEN: &[&str] = &[
    include_str!("../../corpus/valid_beam.txt"),
    include_str!("../../corpus/valid_chain.txt"),
    include_str!("../../corpus/valid_clocks.txt"),
    include_str!("../../corpus/valid_particles.txt"),
    include_str!("../../corpus/valid_cylinder.txt"),
    include_str!("../../corpus/valid_joints.txt"),
    include_str!("../../corpus/valid_press.txt"),
    include_str!("../../corpus/valid_rod_pendulum.txt"),
    include_str!("../../corpus/valid_stops.txt"),
    include_str!("../../corpus/valid_sticking.txt"),
    include_str!("../../corpus/valid_contact.txt"),
    include_str!("../../corpus/valid_modes.txt"),
    include_str!("../../corpus/valid_swing.txt"),
    include_str!("../../corpus/valid_transmissions.txt"),
    include_str!("../../corpus/valid_valve_drive.txt"),
    include_str!("../../corpus/valid_weights.txt"),
    include_str!("../../corpus/valid_winch.txt"),
];
