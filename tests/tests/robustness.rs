//! Whatever is declared, the compiler answers: it never panics.

mod declarations;

use proc_macro2::{Group, TokenStream, TokenTree};

const MUTATIONS: usize = 20_000;

/// Valid declarations with a few random tokens deleted, doubled, exchanged
/// with a neighbour or replaced by another one of the declaration.
#[test]
fn mutated_declarations_do_not_panic() {
    let mut random = Random(1);
    let declarations = declarations::of_models();
    let mut compiled = 0;
    for round in 0..MUTATIONS {
        let (_, declaration) = &declarations[round % declarations.len()];
        let all = flat(declaration);
        let mut mutated = declaration.clone();
        for _ in 0..=random.below(3) {
            mutated = mutate(mutated, &all, &mut random);
        }
        let text = mutated.to_string();
        let answer = std::panic::catch_unwind(|| mbs_codegen::compile(mutated).is_ok());
        compiled += usize::from(answer.unwrap_or_else(|_| panic!("the compiler panicked on\n{text}")));
    }
    assert!(0 < compiled && compiled < MUTATIONS, "{compiled} of {MUTATIONS} mutations compile");
}

/// One change to one token, at any depth.
fn mutate(stream: TokenStream, all: &[TokenTree], random: &mut Random) -> TokenStream {
    let mut tokens: Vec<TokenTree> = stream.into_iter().collect();
    if tokens.is_empty() {
        return all[random.below(all.len())].clone().into();
    }
    // Groups are most of a declaration: descend into one where there is any.
    let groups: Vec<usize> =
        (0..tokens.len()).filter(|&at| matches!(tokens[at], TokenTree::Group(_))).collect();
    let at = match groups.as_slice() {
        [_, ..] if random.below(2) == 0 => groups[random.below(groups.len())],
        _ => random.below(tokens.len()),
    };
    if let TokenTree::Group(group) = &tokens[at]
        && random.below(8) != 0
    {
        let inner = mutate(group.stream(), all, random);
        tokens[at] = Group::new(group.delimiter(), inner).into();
        return tokens.into_iter().collect();
    }
    match random.below(4) {
        0 => drop(tokens.remove(at)),
        1 => tokens.insert(at, tokens[at].clone()),
        2 => {
            let next = (at + 1) % tokens.len();
            tokens.swap(at, next);
        }
        _ => tokens[at] = all[random.below(all.len())].clone(),
    }
    tokens.into_iter().collect()
}

/// All tokens, at every depth.
fn flat(stream: &TokenStream) -> Vec<TokenTree> {
    let mut all = Vec::new();
    for token in stream.clone() {
        if let TokenTree::Group(group) = &token {
            all.extend(flat(&group.stream()));
        }
        all.push(token);
    }
    all
}

/// A small fixed generator (SplitMix64, Steele et al. 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % limit as u64) as usize
    }
}
