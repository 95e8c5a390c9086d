//! The block `mechanism! { … }` in a Rust file.

use std::ops::Range;

use mbs_codegen::Diagnostic;
use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};

/// The tokens inside the only block of a file, or inside the one that declares `name`. Blocks are
/// found by their tokens, so that comments and strings have none.
///
/// # Errors
/// No block, or several.
pub fn block(tokens: TokenStream, name: Option<&str>) -> Result<TokenStream, Diagnostic> {
    only(tokens, name).map(|block| block.tokens)
}

/// Where in the text of `tokens` that block is, without its braces.
///
/// # Errors
/// As [`block`].
pub fn inside(tokens: TokenStream, name: Option<&str>) -> Result<Range<usize>, Diagnostic> {
    let Block { braces: [open, close], .. } = only(tokens, name)?;
    Ok(open.byte_range().end..close.byte_range().start)
}

fn only(tokens: TokenStream, name: Option<&str>) -> Result<Block, Diagnostic> {
    let mut blocks = blocks(tokens);
    let names: Vec<String> = blocks.iter().map(Block::shown).collect();
    if let Some(name) = name {
        blocks.retain(|block| block.name.as_ref().is_some_and(|declared| declared == name));
    }
    let nowhere = |message: String| Diagnostic::new(Span::call_site(), message);
    match (&blocks[..], name) {
        ([_], _) => Ok(blocks.remove(0)),
        ([], Some(name)) if !names.is_empty() => {
            let message = format!("this file declares no mechanism `{name}`");
            Err(nowhere(message).help(format!("it declares {}", names.join(", "))))
        }
        ([], _) => {
            let help = "the inside of such a block alone belongs in a file whose name does not end in `.rs`";
            Err(nowhere("this file has no `mechanism! { … }`".to_owned()).help(help))
        }
        (several, _) => {
            let (count, place) = (several.len(), several[1].place);
            let message =
                format!("this is one of {count} `mechanism! {{ … }}` of the file, and none was named");
            Err(Diagnostic::new(place, message).help(format!("ask for one of {}", names.join(", "))))
        }
    }
}

/// A block, and the name that it declares, if it comes so far.
struct Block {
    name: Option<Ident>,
    place: Span,
    braces: [Span; 2],
    tokens: TokenStream,
}

impl Block {
    fn shown(&self) -> String {
        self.name.as_ref().map_or_else(|| "one without a name".to_owned(), |name| format!("`{name}`"))
    }
}

/// All blocks, in their order. Groups wait in a list: a file may nest them deeply.
fn blocks(tokens: TokenStream) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut waiting = vec![tokens.into_iter()];
    let mut before = [None, None];
    while let Some(tokens) = waiting.last_mut() {
        let Some(token) = tokens.next() else {
            waiting.pop();
            continue;
        };
        if let TokenTree::Group(group) = &token {
            if is_mechanism(&before) {
                let name = name(group.stream());
                let place = name.as_ref().map_or(group.span(), Ident::span);
                let braces = [group.span_open(), group.span_close()];
                blocks.push(Block { name, place, braces, tokens: group.stream() });
            } else {
                waiting.push(group.stream().into_iter());
            }
        }
        let [_, last] = before;
        before = [last, Some(token)];
    }
    blocks
}

/// True if `mechanism!` stands there.
fn is_mechanism(before: &[Option<TokenTree>; 2]) -> bool {
    matches!(before, [Some(TokenTree::Ident(word)), Some(TokenTree::Punct(mark))]
        if word == "mechanism" && mark.as_char() == '!')
}

/// The last word before the braces.
fn name(tokens: TokenStream) -> Option<Ident> {
    let mut name = None;
    for token in tokens {
        match token {
            TokenTree::Ident(word) => name = Some(word),
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => return name,
            _ => {}
        }
    }
    None
}
