//! A reader of XML that takes what the programs write whose files are imported.
//!
//! It is more lenient than the standard: comments may contain `--`, attributes need no blank between them,
//! and prefixes no declaration; they are a part of the name. Entities that a document declares are not
//! expanded. Time and memory are proportional to the text, up to sorting the attributes of an element.

use std::borrow::Cow;

use super::{Refusal, shown};

/// Elements are nested at most so deep.
const DEEPEST: usize = 1000;

/// Characters that XML has names for, which stand between `&` and `;`.
const ENTITIES: [(&str, char); 5] = [("lt", '<'), ("gt", '>'), ("amp", '&'), ("quot", '"'), ("apos", '\'')];

/// A reference to a letter is at most so long: `&#x10FFFF;`.
const LONGEST_REFERENCE: usize = 10;

/// The elements of a text, in its order; the first one is the root.
#[derive(Debug)]
pub(super) struct Document<'t> {
    elements: Vec<Element<'t>>,
    attributes: Vec<(&'t str, Cow<'t, str>)>,
}

#[derive(Debug)]
struct Element<'t> {
    name: &'t str,
    line: usize,
    /// Where its attributes begin and end.
    attributes: [usize; 2],
    text: Cow<'t, str>,
    first: Option<usize>,
    next: Option<usize>,
}

/// An element of a document.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<'a> {
    document: &'a Document<'a>,
    /// Its place among the elements of the document.
    pub at: usize,
}

impl<'t> Document<'t> {
    /// Reads the elements of a text.
    ///
    /// # Errors
    /// The fault of a text that is no complete XML, with its line.
    pub fn parse(text: &'t str) -> Result<Self, Refusal> {
        let document = Self { elements: Vec::new(), attributes: Vec::new() };
        let mut reader = Reader { rest: text, line: 1, document, open: Vec::new() };
        match reader.document() {
            Ok(()) => Ok(reader.document),
            Err(what) => Err(Refusal(format!("it is no complete XML: line {}: {what}", reader.line))),
        }
    }

    /// The outermost element. The reader makes no document without one.
    pub fn root(&self) -> Node<'_> {
        Node { document: self, at: 0 }
    }

    /// All elements in the order of the text.
    pub fn all(&self) -> impl Iterator<Item = Node<'_>> {
        (0..self.elements.len()).map(|at| Node { document: self, at })
    }
}

impl<'a> Node<'a> {
    fn element(self) -> Option<&'a Element<'a>> {
        self.document.elements.get(self.at)
    }

    /// Its name with its prefix.
    pub fn name(self) -> &'a str {
        self.element().map_or("", |element| element.name)
    }

    /// The line in which it begins.
    pub fn line(self) -> usize {
        self.element().map_or(0, |element| element.line)
    }

    pub fn attributes(self) -> impl Iterator<Item = (&'a str, &'a str)> {
        let [from, to] = self.element().map_or([0; 2], |element| element.attributes);
        let attributes = self.document.attributes.get(from..to).unwrap_or_default();
        attributes.iter().map(|(name, value)| (*name, value.as_ref()))
    }

    pub fn attribute(self, name: &str) -> Option<&'a str> {
        self.attributes().find(|(own, _)| *own == name).map(|(_, value)| value)
    }

    /// The texts between its elements, one after the other.
    pub fn text(self) -> Option<&'a str> {
        self.element().map(|element| element.text.as_ref()).filter(|text| !text.is_empty())
    }

    /// The elements in it.
    pub fn elements(self) -> impl Iterator<Item = Self> {
        let next = move |at: Option<usize>| at.map(|at| Self { at, ..self });
        let first = next(self.element().and_then(|element| element.first));
        std::iter::successors(first, move |node| next(node.element().and_then(|element| element.next)))
    }

    pub fn elements_named(self, name: &'static str) -> impl Iterator<Item = Self> {
        self.elements().filter(move |node| node.name() == name)
    }

    /// It in messages: what it is, its name if it has one, and its line.
    pub fn described(self, what: &str) -> String {
        let line = self.line();
        match self.attribute("name").filter(|name| !name.is_empty()) {
            Some(name) => format!("the {what} {} (line {line})", shown(name)),
            None => format!("the {what} in line {line}"),
        }
    }
}

struct Reader<'t> {
    /// The text that was not read yet.
    rest: &'t str,
    /// The line in which `rest` begins.
    line: usize,
    document: Document<'t>,
    /// The elements that have not ended, each with the last one in it.
    open: Vec<(usize, Option<usize>)>,
}

impl<'t> Reader<'t> {
    fn document(&mut self) -> Result<(), String> {
        loop {
            let text = self.take(self.rest.find('<').unwrap_or(self.rest.len()));
            let text = decoded(text)?;
            self.text(text)?;
            if self.rest.is_empty() {
                break;
            } else if self.skip("<!--") {
                self.until("-->", "the comment")?;
            } else if self.skip("<![CDATA[") {
                let text = self.until("]]>", "the text (CDATA)")?;
                self.text(Cow::Borrowed(text))?;
            } else if self.skip("<?") {
                self.until("?>", "the instruction")?;
            } else if self.skip("<!") {
                self.declaration()?;
            } else if self.skip("</") {
                self.end()?;
            } else {
                self.element()?;
            }
        }
        match self.open.last() {
            Some((at, _)) => {
                let node = Node { document: &self.document, at: *at };
                Err(format!("{} does not end", node.described(node.name())))
            }
            None if self.document.elements.is_empty() => Err("it has no element".into()),
            None => Ok(()),
        }
    }

    /// The next letters, which are read then.
    fn take(&mut self, length: usize) -> &'t str {
        let (taken, rest) = self.rest.split_at_checked(length).unwrap_or((self.rest, ""));
        self.line += taken.bytes().filter(|byte| *byte == b'\n').count();
        self.rest = rest;
        taken
    }

    fn take_while(&mut self, is_wanted: impl Fn(char) -> bool) -> &'t str {
        self.take(self.rest.find(|letter| !is_wanted(letter)).unwrap_or(self.rest.len()))
    }

    /// Passes over `start` if the rest begins with it. Reports whether it did.
    fn skip(&mut self, start: &str) -> bool {
        self.rest.starts_with(start) && !self.take(start.len()).is_empty()
    }

    fn until(&mut self, end: &str, what: &str) -> Result<&'t str, String> {
        let at = self.rest.find(end).ok_or_else(|| format!("{what} does not end"))?;
        let inside = self.take(at);
        self.take(end.len());
        Ok(inside)
    }

    /// A name, up to what cannot be in one.
    fn name(&mut self) -> &'t str {
        self.take_while(|letter| !letter.is_whitespace() && !"=/<>\"'".contains(letter))
    }

    fn blanks(&mut self) {
        self.take_while(char::is_whitespace);
    }

    fn text(&mut self, text: Cow<'t, str>) -> Result<(), String> {
        let open = self.open.last().and_then(|(at, _)| self.document.elements.get_mut(*at));
        match open {
            _ if text.trim().is_empty() => {}
            None => return Err("there is text outside of its root".into()),
            Some(element) if element.text.is_empty() => element.text = text,
            Some(element) => element.text.to_mut().push_str(&text),
        }
        Ok(())
    }

    /// Passes a declaration, as of a document type, with others in it.
    fn declaration(&mut self) -> Result<(), String> {
        let (mut depth, mut quote) = (1, None);
        let end = self.rest.char_indices().find(|(_, letter)| {
            match (quote, letter) {
                (Some(mark), letter) if mark == *letter => quote = None,
                (None, '"' | '\'') => quote = Some(*letter),
                (None, '<') => depth += 1,
                (None, '>') => depth -= 1,
                _ => {}
            }
            depth == 0
        });
        let (end, _) = end.ok_or("the declaration does not end")?;
        self.take(end + 1);
        Ok(())
    }

    fn element(&mut self) -> Result<(), String> {
        let line = self.line;
        self.take(1);
        let name = self.name();
        if name.is_empty() {
            return Err("`<` begins no element; in a text it is written `&lt;`".into());
        }
        if self.open.len() >= DEEPEST {
            return Err(format!("elements are nested more than {DEEPEST} deep"));
        }
        let (at, from) = (self.document.elements.len(), self.document.attributes.len());
        match self.open.last_mut() {
            None if at > 0 => return Err(format!("{} is a second root", shown(name))),
            None => {}
            Some((parent, last)) => {
                let before = last.replace(at);
                let link = match before {
                    Some(before) => self.document.elements.get_mut(before).map(|before| &mut before.next),
                    None => self.document.elements.get_mut(*parent).map(|parent| &mut parent.first),
                };
                if let Some(link) = link {
                    *link = Some(at);
                }
            }
        }
        let is_empty = self.attributes(name)?;
        let attributes = [from, self.document.attributes.len()];
        let (text, first, next) = (Cow::Borrowed(""), None, None);
        self.document.elements.push(Element { name, line, attributes, text, first, next });
        if !is_empty {
            self.open.push((at, None));
        }
        Ok(())
    }

    /// The attributes of an element, and whether it ends behind them.
    fn attributes(&mut self, of: &str) -> Result<bool, String> {
        let from = self.document.attributes.len();
        let is_empty = loop {
            self.blanks();
            if self.skip(">") {
                break false;
            }
            if self.skip("/>") {
                break true;
            }
            let name = self.name();
            self.blanks();
            let has_value = !name.is_empty() && self.skip("=");
            self.blanks();
            let quote = self.rest.chars().next().filter(|letter| has_value && "\"'".contains(*letter));
            let Some(quote) = quote else {
                return Err(match name {
                    "" => format!("the element {} does not end with `>`", shown(of)),
                    _ => format!("the attribute {} of {} has no value in quotes", shown(name), shown(of)),
                });
            };
            self.take(1);
            let end = self.rest.find([quote, '<']).filter(|end| self.rest[*end..].starts_with(quote));
            let end = end.ok_or_else(|| format!("the value of {} does not end", shown(name)))?;
            let value = decoded(self.take(end))?;
            self.take(1);
            self.document.attributes.push((name, value));
        };
        let own = self.document.attributes.get(from..).unwrap_or_default();
        let mut names: Vec<&str> = own.iter().map(|(name, _)| *name).collect();
        names.sort_unstable();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(format!("{} has the attribute {} twice", shown(of), shown(pair[0]))),
            None => Ok(is_empty),
        }
    }

    fn end(&mut self) -> Result<(), String> {
        let name = self.name();
        self.blanks();
        if !self.skip(">") {
            return Err(format!("the end of {} has no `>`", shown(name)));
        }
        let (at, _) = self.open.pop().ok_or_else(|| format!("{} ends and did not begin", shown(name)))?;
        let node = Node { document: &self.document, at };
        if node.name() != name {
            let open = node.described(node.name());
            return Err(format!("{} ends before {open}", shown(name)));
        }
        Ok(())
    }
}

/// A text with the letters that its entities stand for. A `&` that begins none stands for itself.
fn decoded(text: &str) -> Result<Cow<'_, str>, String> {
    let Some((before, mut rest)) = text.split_once('&') else { return Ok(Cow::Borrowed(text)) };
    let mut decoded = before.to_owned();
    loop {
        let end = rest.char_indices().take(LONGEST_REFERENCE).find(|(_, letter)| *letter == ';');
        let reference = end.and_then(|(end, _)| rest.get(..end)).filter(|name| !name.contains(['&', ' ']));
        match reference {
            None => decoded.push('&'),
            Some(name) => {
                let unknown = || {
                    let name = shown(&format!("&{name};"));
                    format!("{name} stands for nothing here; what a document declares itself is not expanded")
                };
                decoded.push(letter(name).ok_or_else(unknown)?);
                rest = rest.get(name.len() + 1..).unwrap_or_default();
            }
        }
        let Some((next, behind)) = rest.split_once('&') else { break };
        decoded.push_str(next);
        rest = behind;
    }
    decoded.push_str(rest);
    Ok(Cow::Owned(decoded))
}

/// The letter that an entity stands for.
fn letter(name: &str) -> Option<char> {
    let named = ENTITIES.iter().find(|(known, _)| *known == name).map(|(_, letter)| *letter);
    let code = || match name.strip_prefix("#x").or(name.strip_prefix("#X")) {
        Some(hex) => u32::from_str_radix(hex, 16).ok(),
        None => name.strip_prefix('#')?.parse().ok(),
    };
    named.or_else(|| code().filter(|code| *code > 0).and_then(char::from_u32))
}

#[cfg(test)]
mod tests;
