//! Declarations that nobody would write, for a compiler that has to answer
//! whatever it is given: mutations of valid ones, and statements made up from a
//! grammar.
//!
//! An input is a text. Groups without delimiters, which a `macro_rules!` around
//! `mechanism!` hands over, are written `invisible!(…)` in it.

pub mod grammar;
pub mod mutation;
pub mod reduction;
pub mod seeds;
pub mod verdict;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use crate::random::Random;
use seeds::Seed;

/// Input number `index` of the run that began with `seed`: the same at every call.
pub fn input(seeds: &[Seed], seed: u64, index: u64) -> String {
    // The generator scrambles its counter, so neighbouring seeds are far apart.
    let mut random = Random::new(seed.wrapping_mul(0x2545_f491_4f6c_dd1d).wrapping_add(index << 20));
    match random.below(10) {
        0 => grammar::declaration(&mut random),
        1 => grammar::noise(&mut random),
        2 => {
            let made_up = grammar::declaration(&mut random);
            match tokens(&made_up) {
                Some(stream) => text(mutation::mutated(stream, seeds, &mut random)),
                None => made_up,
            }
        }
        3 => text(mutation::crossed(seeds, &mut random)),
        _ => {
            let seed = random.of(seeds).tokens.clone();
            text(mutation::mutated(seed, seeds, &mut random))
        }
    }
}

/// The tokens of an input, if its text is made of such.
pub fn tokens(text: &str) -> Option<TokenStream> {
    text.parse().ok().map(uncovered)
}

/// `invisible!(…)` becomes the group without delimiters that it stands for.
fn uncovered(stream: TokenStream) -> TokenStream {
    let mut plain: Vec<TokenTree> = Vec::new();
    for token in stream {
        let TokenTree::Group(group) = token else {
            plain.push(token);
            continue;
        };
        let marks = |word: &TokenTree, mark: &TokenTree| {
            matches!(word, TokenTree::Ident(word) if word == "invisible")
                && matches!(mark, TokenTree::Punct(mark) if mark.as_char() == '!')
        };
        let mut delimiter = group.delimiter();
        if let [.., word, mark] = &plain[..]
            && marks(word, mark)
        {
            plain.truncate(plain.len() - 2);
            delimiter = Delimiter::None;
        }
        let mut inner = Group::new(delimiter, uncovered(group.stream()));
        if delimiter != Delimiter::None {
            inner.set_span(group.span());
        }
        plain.push(inner.into());
    }
    plain.into_iter().collect()
}

/// The text of tokens.
pub fn text(stream: TokenStream) -> String {
    covered(stream).to_string()
}

/// The opposite of [`uncovered`].
fn covered(stream: TokenStream) -> TokenStream {
    let cover = |token| match token {
        TokenTree::Group(group) => {
            let inner = covered(group.stream());
            match group.delimiter() {
                Delimiter::None => {
                    let mark = proc_macro2::Punct::new('!', proc_macro2::Spacing::Alone);
                    let word = proc_macro2::Ident::new("invisible", group.span());
                    let inner = Group::new(Delimiter::Parenthesis, inner);
                    vec![word.into(), mark.into(), inner.into()]
                }
                delimiter => vec![Group::new(delimiter, inner).into()],
            }
        }
        token => vec![token],
    };
    stream.into_iter().flat_map(cover).collect()
}
