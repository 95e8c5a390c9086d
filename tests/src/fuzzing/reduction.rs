//! The smallest part of an input that still fails.

use proc_macro2::{Group, TokenStream, TokenTree};

use super::{text, tokens};

/// Deletes tokens, and delimiters around tokens, as long as `fails` holds and
/// until it is told to stop.
pub fn smallest(input: &str, mut fails: impl FnMut(&str) -> bool, mut stop: impl FnMut() -> bool) -> String {
    let Some(mut stream) = tokens(input) else { return input.to_owned() };
    let mut run = 64;
    loop {
        let mut is_shorter = false;
        let mut at = 0;
        while at < count(&stream) {
            if stop() {
                return text(stream);
            }
            let shorter = [Change::Delete(run), Change::Unwrap].into_iter().find_map(|change| {
                let mut place = at;
                let shorter = changed(&stream, &mut place, change)?;
                fails(&text(shorter.clone())).then_some(shorter)
            });
            match shorter {
                Some(shorter) => (stream, is_shorter) = (shorter, true),
                None => at += 1,
            }
        }
        match (run, is_shorter) {
            (1, false) => return text(stream),
            (1, true) => {}
            _ => run /= 4,
        }
    }
}

/// A change at a token.
#[derive(Clone, Copy)]
enum Change {
    /// Deletes so many tokens of a group, from this one on.
    Delete(usize),
    /// Replaces a group by its content.
    Unwrap,
}

/// All tokens, at every depth.
fn count(stream: &TokenStream) -> usize {
    let of = |token| match token {
        TokenTree::Group(group) => 1 + count(&group.stream()),
        _ => 1,
    };
    stream.clone().into_iter().map(of).sum()
}

/// The change at token `place`, counted through all depths; what is left of
/// `place` if that lies behind `stream`.
fn changed(stream: &TokenStream, place: &mut usize, change: Change) -> Option<TokenStream> {
    let mut list: Vec<TokenTree> = stream.clone().into_iter().collect();
    for at in 0..list.len() {
        if *place == 0 {
            return match (change, &list[at]) {
                (Change::Delete(run), _) => {
                    list.drain(at..list.len().min(at + run));
                    Some(list.into_iter().collect())
                }
                (Change::Unwrap, TokenTree::Group(group)) => {
                    let content = group.stream();
                    list.splice(at..=at, content);
                    Some(list.into_iter().collect())
                }
                (Change::Unwrap, _) => None,
            };
        }
        *place -= 1;
        let TokenTree::Group(group) = &list[at] else { continue };
        let inside = count(&group.stream());
        if *place < inside {
            let inner = changed(&group.stream(), place, change)?;
            list[at] = Group::new(group.delimiter(), inner).into();
            return Some(list.into_iter().collect());
        }
        *place -= inside;
    }
    None
}
