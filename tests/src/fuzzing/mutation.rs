//! Valid declarations with a few tokens or statements deleted, doubled,
//! exchanged or replaced by those of other declarations.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use super::grammar;
use super::seeds::Seed;
use crate::random::Random;

/// A declaration with up to four changes.
pub fn mutated(declaration: TokenStream, seeds: &[Seed], random: &mut Random) -> TokenStream {
    let own = flat(&declaration);
    let mut mutated = declaration;
    // Other values say something that most often compiles.
    if random.once_in(2) {
        let literals = own.iter().filter(|token| matches!(token, TokenTree::Literal(_))).count();
        for _ in 0..=random.below(3) {
            mutated = revalued(mutated, &mut random.below(literals), random);
        }
        if random.once_in(2) {
            return mutated;
        }
    }
    // one change half of the time, so that something compiles
    for _ in 0..=random.below(6).saturating_sub(2) {
        let replacement = match random.below(4) {
            0 => grammar::fragment(random),
            1 => {
                let all = &random.of(seeds).all;
                random.of(all).clone().into()
            }
            _ if own.is_empty() => TokenStream::new(),
            _ => random.of(&own).clone().into(),
        };
        mutated = mutate(mutated, &replacement, random);
    }
    mutated
}

/// One change to one token, at any depth.
fn mutate(stream: TokenStream, replacement: &TokenStream, random: &mut Random) -> TokenStream {
    let mut tokens: Vec<TokenTree> = stream.into_iter().collect();
    if tokens.is_empty() {
        return replacement.clone();
    }
    // Groups are most of a declaration: descend into one where there is any.
    let groups: Vec<usize> =
        (0..tokens.len()).filter(|&at| matches!(tokens[at], TokenTree::Group(_))).collect();
    let at = match groups.as_slice() {
        [_, ..] if random.once_in(2) => *random.of(&groups),
        _ => random.below(tokens.len()),
    };
    if let TokenTree::Group(group) = &tokens[at]
        && !random.once_in(8)
    {
        let inner = mutate(group.stream(), replacement, random);
        tokens[at] = Group::new(group.delimiter(), inner).into();
        return tokens.into_iter().collect();
    }
    match random.below(6) {
        0 => drop(tokens.remove(at)),
        1 => tokens.insert(at, tokens[at].clone()),
        2 => {
            let next = (at + 1) % tokens.len();
            tokens.swap(at, next);
        }
        3 => {
            let wrapped = std::iter::once(tokens[at].clone()).collect();
            let delimiter = *random.of(&[
                Delimiter::None,
                Delimiter::None,
                Delimiter::Parenthesis,
                Delimiter::Bracket,
                Delimiter::Brace,
            ]);
            tokens[at] = Group::new(delimiter, wrapped).into();
        }
        _ => drop(tokens.splice(at..=at, replacement.clone())),
    }
    tokens.into_iter().collect()
}

/// Another number in place of literal `place`, counted through all depths.
fn revalued(stream: TokenStream, place: &mut usize, random: &mut Random) -> TokenStream {
    let mut tokens = TokenStream::new();
    for token in stream {
        match token {
            TokenTree::Literal(literal) => {
                let is_here = *place == 0;
                *place = place.wrapping_sub(1);
                tokens.extend(if is_here {
                    grammar::plain_number(random)
                } else {
                    TokenTree::from(literal).into()
                });
            }
            TokenTree::Group(group) => {
                let inner = revalued(group.stream(), place, random);
                tokens.extend([TokenTree::from(Group::new(group.delimiter(), inner))]);
            }
            token => tokens.extend([token]),
        }
    }
    tokens
}

/// The statements of two declarations, most of the first and in another order,
/// and some of the second.
pub fn crossed(seeds: &[Seed], random: &mut Random) -> TokenStream {
    let (first, second) = (random.of(seeds).tokens.clone(), random.of(seeds).tokens.clone());
    let Some((mut head, own)) = parts(first) else { return TokenStream::new() };
    let (_, others) = parts(second).unwrap_or_default();
    let mut statements = own;
    if random.once_in(2) && !statements.is_empty() {
        statements.remove(random.below(statements.len()));
    }
    for at in (1..statements.len()).rev() {
        statements.swap(at, random.below(at + 1));
    }
    for _ in 0..random.below(3) {
        if !others.is_empty() {
            let at = random.below(statements.len() + 1);
            statements.insert(at, random.of(&others).clone());
        }
    }
    let body = Group::new(Delimiter::Brace, statements.into_iter().collect());
    head.extend([TokenTree::from(body)]);
    head
}

/// The tokens before the braces, and the statements in them.
fn parts(declaration: TokenStream) -> Option<(TokenStream, Vec<TokenStream>)> {
    let mut head: Vec<TokenTree> = declaration.into_iter().collect();
    match head.pop() {
        Some(TokenTree::Group(group)) => Some((head.into_iter().collect(), statements(group.stream()))),
        _ => None,
    }
}

/// A block cut behind each `;` and each `{ … }`.
fn statements(block: TokenStream) -> Vec<TokenStream> {
    let mut statements = Vec::new();
    let mut statement = Vec::new();
    for token in block {
        let is_end = match &token {
            TokenTree::Punct(punct) => punct.as_char() == ';',
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            _ => false,
        };
        statement.push(token);
        if is_end {
            statements.push(statement.drain(..).collect());
        }
    }
    if !statement.is_empty() {
        statements.push(statement.into_iter().collect());
    }
    statements
}

/// All tokens, at every depth.
pub fn flat(stream: &TokenStream) -> Vec<TokenTree> {
    let mut all = Vec::new();
    for token in stream.clone() {
        if let TokenTree::Group(group) = &token {
            all.extend(flat(&group.stream()));
        }
        all.push(token);
    }
    all
}
