//! Blocks of statements of one kind: what clocks and conditions do, what a mode has.

use proc_macro2::{Group, Ident, Span, TokenStream};
use syn::ext::IdentExt;
use syn::parse::{ParseStream, Parser};
use syn::{Error, Result};

use super::indices::Indices;
use super::keywords::keywords;
use super::statements::{Reader, before_block, take};
use super::words::{block, doc, helped};
use super::{Every, Item, ItemKind, Set, When, clocks, modes};

/// The statements of a block: the words that begin them, the message for another one, and its help.
type Statements<'a> = (fn(&Ident) -> bool, &'a str, &'a dyn Fn(&Ident) -> String);

impl Reader<'_> {
    /// `every 1 [ms] offset 0.2 [ms] { set u = …; }`
    pub(super) fn every(
        &mut self,
        content: ParseStream<'_>,
        indices: &Indices,
        items: &mut Vec<Item>,
    ) -> Result<()> {
        let (position, doc, keyword) = self.begin(content)?;
        let (period, offset) = head(content, indices, clocks::times)?;
        let sets = self.sets(content, indices, "every 1 [ms] { set u = …; }", "an `every`")?;
        items.push(Item { doc, position, kind: ItemKind::Every(Every { keyword, period, offset, sets }) });
        Ok(())
    }

    /// `when x < 0 [m] { enter engaged; }`
    pub(super) fn when(
        &mut self,
        content: ParseStream<'_>,
        indices: &Indices,
        items: &mut Vec<Item>,
    ) -> Result<()> {
        let (position, doc, keyword) = self.begin(content)?;
        let condition = head(content, indices, modes::moment)?;
        let sets = self.sets(content, indices, "when x < 0 [m] { enter latched; }", "a `when`")?;
        items.push(Item { doc, position, kind: ItemKind::When(When { keyword, condition, sets }) });
        Ok(())
    }

    /// `mode engaged { fixed lock (plate, wheel); }`
    pub(super) fn mode(
        &mut self,
        content: ParseStream<'_>,
        indices: &Indices,
        items: &mut Vec<Item>,
    ) -> Result<()> {
        let (position, doc, _) = self.begin(content)?;
        let (name, value) = head(content, indices, modes::head)?;
        let mut inner = Vec::new();
        let others = "in a mode stand joints and constraints";
        let help = |word: &Ident| {
            format!("declare `{word}` around it; a force of a mode has its name as a factor, which is 1 or 0")
        };
        let example = "mode engaged { fixed lock (plate, wheel); }";
        self.block_of((content, indices), example, (modes::is_row, others, &help), &mut inner)?;
        let rows: Vec<Ident> = inner.iter().filter_map(modes::row).collect();
        if rows.len() < inner.len() {
            let message = format!("`{name}` has a joint with play, which is no constraint");
            return Err(helped(
                name.span(),
                message,
                "declare it around the mode, or leave its `clearance` out",
            ));
        }
        items.extend(inner);
        items.push(Item { doc, position, kind: ItemKind::Mode { name, value, rows } });
        Ok(())
    }

    /// The doc comment and the keyword of a block.
    fn begin(&mut self, content: ParseStream<'_>) -> Result<(usize, String, Span)> {
        let doc = doc(content)?;
        let keyword = content.call(Ident::parse_any)?.span();
        self.position += 1;
        Ok((self.position, doc, keyword))
    }

    /// `{ set u = …; enter engaged; }`
    fn sets(
        &mut self,
        content: ParseStream<'_>,
        indices: &Indices,
        example: &str,
        what: &str,
    ) -> Result<Vec<Set>> {
        let mut inner = Vec::new();
        let others = format!("nothing but `set`, `enter`, `leave`, `for` and `if` stands in {what}");
        let help = |word: &Ident| match keywords().iter().any(|keyword| word == keyword.word) {
            true => "declare it around the block".to_owned(),
            false => format!("a memory is given a value by `set {word} = …;`"),
        };
        self.block_of((content, indices), example, (clocks::is_set, &others, &help), &mut inner)?;
        let set = |item: Item| match item.kind {
            ItemKind::Set(set) => Some(set),
            _ => None,
        };
        Ok(inner.into_iter().filter_map(set).collect())
    }

    /// A block of some statements alone.
    fn block_of(
        &mut self,
        (content, indices): (ParseStream<'_>, &Indices),
        example: &str,
        (is_statement, others, help): Statements<'_>,
        items: &mut Vec<Item>,
    ) -> Result<()> {
        block(content, example)?;
        let body: Group = content.parse()?;
        if let Some(word) = clocks::other_than(is_statement, body.stream()) {
            return Err(helped(word.span(), others, help(&word)));
        }
        self.inner(&body, indices, items)
    }
}

/// The head of a block, with the values of indices.
fn head<T>(content: ParseStream<'_>, indices: &Indices, read: fn(ParseStream<'_>) -> Result<T>) -> Result<T> {
    let head: TokenStream = before_block(content.fork());
    match indices.resolve(head.clone()) {
        None => read(content),
        Some(resolved) => {
            let at = content.span();
            take(content, head)?;
            // what ends too early has no place among tokens
            read.parse2(resolved).map_err(|error| Error::new(at, error))
        }
    }
}
