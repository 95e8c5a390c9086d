//! The statements of a block, one after the other: loops are unrolled and
//! conditions decided here, so that what follows sees plain statements.
//!
//! The copies that a loop makes of a statement share its position in the source. Their errors are reported
//! once. Statements are read after indices are resolved, so nothing behind this stage knows of loops.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::discouraged::Speculative;
use syn::parse::{ParseBuffer, ParseStream, Parser};
use syn::{Error, Result, Token, braced, token};

use super::indices::{Indices, regrouped};
use super::items::item;
use super::words::{block, doc, helped_further, name};
use super::{Item, ItemKind};
use crate::diagnostics::Diagnostics;

/// More statements than this are not a mechanism but a slip in a range.
const MOST_STATEMENTS: usize = 100_000;

/// Blocks within blocks may nest this deep: each level is read anew.
const DEEPEST: usize = 64;

/// Reads statements; after an error it goes on behind the next `;` or `{ … }`,
/// so that all errors of a declaration are shown at once.
pub(super) struct Reader<'a> {
    pub errors: &'a mut Diagnostics,
    /// Statements so far, as they stand in the source: the copies that a loop
    /// makes of one share its number.
    pub(super) position: usize,
    /// Statements so far, copies and rounds of loops included.
    count: usize,
    /// Blocks around the statement.
    depth: usize,
}

impl<'a> Reader<'a> {
    pub fn new(errors: &'a mut Diagnostics) -> Self {
        Self { errors, position: 0, count: 0, depth: 0 }
    }

    /// The statements of a block.
    pub fn statements(&mut self, content: ParseStream<'_>, indices: &Indices) -> Vec<Item> {
        let mut items = Vec::new();
        while !content.is_empty() {
            let behind = content.fork();
            let tokens = take_statement(&behind);
            let ahead = content.fork();
            let result = match keyword(&ahead).as_deref() {
                Some("for") => {
                    content.advance_to(&ahead);
                    self.repeat(content, indices, &mut items)
                }
                Some("if") => {
                    content.advance_to(&ahead);
                    self.choose(content, indices, &mut items)
                }
                Some("assembly") => self.assembly(content, indices, &mut items),
                Some("every") => self.every(content, indices, &mut items),
                Some("when") => self.when(content, indices, &mut items),
                Some("mode") => self.mode(content, indices, &mut items),
                _ => self.plain(content, tokens, indices, &mut items),
            };
            if let Err(error) = result {
                self.errors.push(error);
                content.advance_to(&behind);
            }
        }
        items
    }

    fn plain(
        &mut self,
        content: ParseStream<'_>,
        tokens: TokenStream,
        indices: &Indices,
        items: &mut Vec<Item>,
    ) -> Result<()> {
        self.position += 1;
        self.count_one(content.span())?;
        let (doc, kinds) = match indices.resolve(tokens.clone()) {
            Some(resolved) => {
                let item = (|input: ParseStream<'_>| {
                    let item = item(input)?;
                    input.parse::<Option<Token![;]>>()?;
                    Ok(item)
                })
                .parse2(resolved)?;
                take(content, tokens)?;
                item
            }
            None => {
                // A fork, so that what a wrong statement leaves unread is no second error.
                let statement = content.fork();
                let item = item(&statement)?;
                content.advance_to(&statement);
                content.parse::<Option<Token![;]>>()?;
                item
            }
        };
        let position = self.position;
        items.extend(kinds.into_iter().map(|kind| Item { doc: doc.clone(), position, kind }));
        Ok(())
    }

    /// Counts a statement, or a round of a loop.
    fn count_one(&mut self, at: Span) -> Result<()> {
        self.count += 1;
        if self.count > MOST_STATEMENTS {
            return Err(Error::new(at, format!("loops make more than {MOST_STATEMENTS} statements here")));
        }
        Ok(())
    }

    /// `for i in 1..=N { … }`
    fn repeat(&mut self, content: ParseStream<'_>, indices: &Indices, items: &mut Vec<Item>) -> Result<()> {
        const EXAMPLE: &str = "for i in 1..=N { … }";
        content.parse::<Token![for]>()?;
        let variable = name(content)?;
        content.parse::<Token![in]>().map_err(|error| expected(error, "`in`", EXAMPLE))?;
        let first = whole(content, indices, EXAMPLE)?;
        let is_closed = content.peek(Token![..=]);
        if is_closed {
            content.parse::<Token![..=]>()?;
        } else {
            content.parse::<Token![..]>().map_err(|error| expected(error, "`..=`", EXAMPLE))?;
        }
        let last = whole(content, indices, EXAMPLE)?;
        block(content, EXAMPLE)?;
        let body: Group = content.parse()?;
        let start = self.position;
        let errors_before = self.errors.len();
        for value in first..if is_closed { last.saturating_add(1) } else { last } {
            self.position = start;
            // a round without statements counts too, or it would have no end
            self.count_one(variable.span())?;
            self.inner(&body, &indices.with(&variable, value)?, items)?;
            // the copies would have the same errors, and a runaway loop no end
            if self.errors.len() > errors_before {
                break;
            }
        }
        self.position = start + count_statements(body.stream());
        Ok(())
    }

    /// `if i > 1 { … } else { … }`
    fn choose(&mut self, content: ParseStream<'_>, indices: &Indices, items: &mut Vec<Item>) -> Result<()> {
        const EXAMPLE: &str = "if i > 1 { … }";
        const VALUES: &str =
            "; a value by a condition stands in its formula: `set u = if x > 0 [m] { … } else { … };`";
        let mut is_decided = false;
        loop {
            content.parse::<Token![if]>()?;
            let holds =
                condition(content, indices, EXAMPLE).map_err(|error| helped_further(error, VALUES))?;
            is_decided |= self.branch(content, holds && !is_decided, indices, items)?;
            if content.parse::<Option<Token![else]>>()?.is_none() {
                return Ok(());
            }
            if !content.peek(Token![if]) {
                self.branch(content, !is_decided, indices, items)?;
                return Ok(());
            }
        }
    }

    /// A block that is read if `holds`, and passed over otherwise.
    fn branch(
        &mut self,
        content: ParseStream<'_>,
        holds: bool,
        indices: &Indices,
        items: &mut Vec<Item>,
    ) -> Result<bool> {
        block(content, "if i > 1 { … } else { … }")?;
        let body: Group = content.parse()?;
        let start = self.position;
        if holds {
            self.inner(&body, indices, items)?;
        }
        self.position = start + count_statements(body.stream());
        Ok(holds)
    }

    /// `assembly Leg { … }`
    fn assembly(&mut self, content: ParseStream<'_>, indices: &Indices, items: &mut Vec<Item>) -> Result<()> {
        let doc = doc(content)?;
        content.call(Ident::parse_any)?;
        self.position += 1;
        let position = self.position;
        let name = name(content)?;
        block(content, "assembly Leg { body … }")?;
        let body: Group = content.parse()?;
        let mut inner = Vec::new();
        self.inner(&body, indices, &mut inner)?;
        items.push(Item { doc, position, kind: ItemKind::Assembly { name, items: inner } });
        Ok(())
    }

    pub(super) fn inner(&mut self, body: &Group, indices: &Indices, items: &mut Vec<Item>) -> Result<()> {
        if self.depth >= DEEPEST {
            let message = format!("blocks are nested more than {DEEPEST} deep here");
            return Err(Error::new(body.span_open(), message));
        }
        self.depth += 1;
        let tokens = TokenStream::from(TokenTree::from(regrouped(body, body.stream())));
        let parser = |input: ParseStream<'_>| {
            let content;
            braced!(content in input);
            items.extend(self.statements(&content, indices));
            Ok(())
        };
        let result = parser.parse2(tokens);
        self.depth -= 1;
        result
    }
}

/// The word that begins a statement; moves `input` to it.
fn keyword(input: ParseStream<'_>) -> Option<String> {
    doc(input).ok()?;
    input.fork().call(Ident::parse_any).ok().map(|word| word.to_string())
}

fn expected(error: Error, what: &str, example: &str) -> Error {
    Error::new(error.span(), format!("{what} is expected here, as in `{example}`"))
}

/// A whole number up to `..`, a comparison or a block.
fn whole(input: ParseStream<'_>, indices: &Indices, example: &str) -> Result<i64> {
    let mut tokens = TokenStream::new();
    let at = input.span();
    while !(input.is_empty()
        || input.peek(Token![..])
        || input.peek(token::Brace)
        || input.peek(Token![=])
        || COMPARISONS.iter().any(|(_, peek, _)| peek(input)))
    {
        tokens.extend([input.parse::<TokenTree>()?]);
    }
    if tokens.is_empty() {
        return Err(Error::new(at, format!("a whole number is expected here, as in `{example}`")));
    }
    indices.evaluate(tokens)
}

/// A comparison: how it is written, whether it comes next, what it says.
type Comparison = (&'static str, fn(ParseStream<'_>) -> bool, fn(&i64, &i64) -> bool);

/// Longer ones first, so that `<=` is not read as `<`.
const COMPARISONS: &[Comparison] = &[
    ("<=", |input| input.peek(Token![<=]), i64::le),
    (">=", |input| input.peek(Token![>=]), i64::ge),
    ("==", |input| input.peek(Token![==]), i64::eq),
    ("!=", |input| input.peek(Token![!=]), i64::ne),
    ("<", |input| input.peek(Token![<]), i64::lt),
    (">", |input| input.peek(Token![>]), i64::gt),
];

fn condition(input: ParseStream<'_>, indices: &Indices, example: &str) -> Result<bool> {
    let left = whole(input, indices, example)?;
    let Some((text, _, compare)) = COMPARISONS.iter().find(|(_, peek, _)| peek(input)) else {
        return Err(input.error(format!("a comparison is expected here, as in `{example}`")));
    };
    for _ in text.chars() {
        input.parse::<TokenTree>()?;
    }
    Ok(compare(&left, &whole(input, indices, example)?))
}

/// Moves behind the next `;`, or behind a `{ … }` that ends a statement with its
/// `else`, and gives what stands before. Behind an `if` in a formula only a `;` ends it.
fn take_statement(input: ParseStream<'_>) -> TokenStream {
    let mut tokens = TokenStream::new();
    let (mut is_behind_sign, mut has_choice) = (false, false);
    while let Ok(token) = input.parse::<TokenTree>() {
        has_choice |= is_behind_sign && matches!(&token, TokenTree::Ident(word) if word == "if");
        is_behind_sign = matches!(&token, TokenTree::Punct(punct) if punct.as_char() != ';');
        let mut is_end = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == ';');
        let is_block = matches!(&token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
        tokens.extend([token]);
        if is_block && input.peek(Token![;]) {
            tokens.extend(input.parse::<TokenTree>());
            is_end = true;
        }
        if is_end || (is_block && !has_choice && !input.peek(Token![else])) {
            break;
        }
    }
    tokens
}

/// The tokens up to a `{ … }`.
pub(super) fn before_block(input: ParseBuffer<'_>) -> TokenStream {
    let mut tokens = TokenStream::new();
    while !input.peek(token::Brace)
        && let Ok(token) = input.parse::<TokenTree>()
    {
        tokens.extend([token]);
    }
    tokens
}

/// Moves over `tokens`.
pub(super) fn take(input: ParseStream<'_>, tokens: TokenStream) -> Result<()> {
    for _ in tokens {
        input.parse::<TokenTree>()?;
    }
    Ok(())
}

/// At least as many as there are statements in the source of a block, those in
/// its blocks included.
fn count_statements(block: TokenStream) -> usize {
    let of = |token| match token {
        TokenTree::Punct(punct) => usize::from(punct.as_char() == ';'),
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
            1 + count_statements(group.stream())
        }
        _ => 0,
    };
    block.into_iter().map(of).sum()
}
